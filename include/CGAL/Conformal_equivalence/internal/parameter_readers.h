// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How named parameters are read: whether one was given, and what is written through a
// parameter. (The visitor is in Any_visitor.h, the linear solver in solver_traits_of.h.)

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_PARAMETER_READERS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_PARAMETER_READERS_H

#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/use.h>

#include <functional>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The type of a parameter as the pack holds it, `Param_not_found` if it was not given.
template <typename Tag, typename NamedParameters>
using Given_parameter =
  typename CGAL::internal_np::Lookup_named_param_def<Tag, NamedParameters, CGAL::internal_np::Param_not_found>::type;

template <typename Tag, typename NamedParameters>
inline constexpr bool is_given = !std::is_same<Given_parameter<Tag, NamedParameters>, CGAL::internal_np::Param_not_found>::value;

// What was given by `std::ref`, and whether it can be written to.
template <typename T> struct Reference_parameter : public std::false_type {};
template <typename T> struct Reference_parameter<std::reference_wrapper<T> > : public std::true_type { typedef T type; };
template <typename T> struct Reference_parameter<std::reference_wrapper<const T> > : public std::false_type {};

// Assigns `value` to the object that was given by `std::ref`, if there is one.
template <typename Tag, typename NamedParameters, typename Value>
void write_if_given(const NamedParameters& np, Tag tag, Value&& value)
{
  CGAL_USE(np);
  CGAL_USE(tag);
  CGAL_USE(value);
  if constexpr(is_given<Tag, NamedParameters>)
    CGAL::parameters::get_parameter(np, tag).get() = std::forward<Value>(value);
}

// Writes `value` at `key` to the property map that was given, if there is one.
template <typename Tag, typename NamedParameters, typename Key, typename Value>
void put_if_given(const NamedParameters& np, Tag tag, const Key& key, const Value& value)
{
  CGAL_USE(np);
  CGAL_USE(tag);
  CGAL_USE(key);
  CGAL_USE(value);
  if constexpr(is_given<Tag, NamedParameters>)
    put(CGAL::parameters::get_parameter(np, tag), key, value);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_PARAMETER_READERS_H
