// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file named_parameters.h
/// The named parameters that this package adds to \cgal's.
///
/// \cgal's named parameters are members of one class, which cannot be extended from outside. The
/// class `Conformal_named_parameters` below therefore derives from it and knows both lists. A chain
/// takes the parameters of both lists, in any order, if it begins with a parameter of this package,
/// or with any one of the namespace `CGAL::Conformal_equivalence::named_parameters`, where those of
/// \cgal are repeated:
/// \code
/// CGAL::parameters::gradient_tolerance(1e-10).vertex_point_map(vpm).number_of_iterations(50)
/// CGAL::Conformal_equivalence::named_parameters::vertex_point_map(vpm).gradient_tolerance(1e-10)
/// \endcode
/// A chain that begins in `CGAL::parameters` with one of \cgal's can hold these only ("has no member
/// named ..." means that one of this package follows). Packs that exist already, of either kind, are
/// joined by `combine_named_parameters()`.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_NAMED_PARAMETERS_H
#define CGAL_CONFORMAL_EQUIVALENCE_NAMED_PARAMETERS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Named_function_parameters.h>

#include <functional>
#include <type_traits>

namespace CGAL {

// The tags, beside those of CGAL. Their names carry the prefix `conformal_`, so
// that a name added to CGAL's list breaks nothing here.
namespace internal_np {

/// \cond SKIP_IN_MANUAL
#define CGAL_add_named_parameter(X, Y, Z) enum X { Y };
#include <CGAL/Conformal_equivalence/internal/parameters_interface.h>
#undef CGAL_add_named_parameter
/// \endcond

} // namespace internal_np

namespace Conformal_equivalence {

/// \cond SKIP_IN_MANUAL

template <typename T, typename Tag, typename Base = CGAL::internal_np::No_property>
struct Conformal_named_parameters
  : public CGAL::Named_function_parameters<T, Tag, Base>
{
  typedef CGAL::Named_function_parameters<T, Tag, Base> Inherited;
  typedef Conformal_named_parameters<T, Tag, Base> self;

  Conformal_named_parameters(const T& v) : Inherited(v) {}
  Conformal_named_parameters(const T& v, const Base& b) : Inherited(v, b) {}

// The forms of CGAL's list: by value, and by (constant) reference only.
#define CGAL_add_named_parameter(X, Y, Z)                                           \
  template <typename K>                                                             \
  Conformal_named_parameters<K, CGAL::internal_np::X, self> Z(const K& k) const     \
  {                                                                                 \
    return Conformal_named_parameters<K, CGAL::internal_np::X, self>(k, *this);     \
  }
#define CGAL_add_named_parameter_with_compatibility(X, Y, Z) CGAL_add_named_parameter(X, Y, Z)
#define CGAL_add_extra_named_parameter_with_compatibility(X, Y, Z) CGAL_add_named_parameter(X, Y, Z)
#define CGAL_add_named_parameter_with_compatibility_cref_only(X, Y, Z)              \
  template <typename K>                                                             \
  Conformal_named_parameters<std::reference_wrapper<const K>, CGAL::internal_np::X, self> \
  Z(const K& k) const                                                               \
  {                                                                                 \
    return {std::cref(k), *this};                                                   \
  }
#define CGAL_add_named_parameter_with_compatibility_ref_only(X, Y, Z)               \
  template <typename K>                                                             \
  Conformal_named_parameters<std::reference_wrapper<K>, CGAL::internal_np::X, self> \
  Z(K& k) const                                                                     \
  {                                                                                 \
    return {std::ref(k), *this};                                                    \
  }
#include <CGAL/STL_Extension/internal/parameters_interface.h>
#include <CGAL/Conformal_equivalence/internal/parameters_interface.h>
#undef CGAL_add_named_parameter
#undef CGAL_add_named_parameter_with_compatibility
#undef CGAL_add_extra_named_parameter_with_compatibility
#undef CGAL_add_named_parameter_with_compatibility_cref_only
#undef CGAL_add_named_parameter_with_compatibility_ref_only
};

namespace internal {

// Appends the parameters of the pack `b`, innermost first, to the pack `a`.
template <typename NP, typename T, typename Tag>
auto append_named_parameters(const NP& a,
                             const CGAL::internal_np::Named_params_impl<T, Tag, CGAL::internal_np::No_property>& b)
{
  return Conformal_named_parameters<T, Tag, NP>(b.v, a);
}

template <typename NP, typename T, typename Tag, typename Base>
auto append_named_parameters(const NP& a,
                             const CGAL::internal_np::Named_params_impl<T, Tag, Base>& b)
{
  const auto joined = append_named_parameters(a, static_cast<const typename Base::base&>(b));
  return Conformal_named_parameters<T, Tag, std::decay_t<decltype(joined)> >(b.v, joined);
}

// A parameter that was given by value or by `std::ref`.
template <typename T> T& unwrap(T& t) { return t; }
template <typename T> T& unwrap(std::reference_wrapper<T>& r) { return r.get(); }

} // namespace internal

/// \endcond

/// \ingroup PkgConformalEquivalenceNamedParameters
///
/// returns the pack of the parameters of `a` and of `b`; where both hold the
/// same parameter, that of `b` counts. Works for packs of any length, begun by \cgal's parameters or by those of this
/// package, in every supported version of \cgal, and the result can be continued as a chain of both.
template <typename NamedParameters1, typename NamedParameters2>
auto combine_named_parameters(const NamedParameters1& a, const NamedParameters2& b)
{
  return internal::append_named_parameters(a, static_cast<const typename NamedParameters2::base&>(b));
}

/// \ingroup PkgConformalEquivalenceNamedParameters
///
/// returns the pack of the parameters of `a`, `b`, and all others; where several hold the same parameter, that of the last one counts.
template <typename NamedParameters1, typename NamedParameters2, typename NamedParameters3, typename... NamedParameters>
auto combine_named_parameters(const NamedParameters1& a, const NamedParameters2& b, const NamedParameters3& c, const NamedParameters&... others)
{
  return combine_named_parameters(combine_named_parameters(a, b), c, others...);
}

} // namespace Conformal_equivalence

/// \cond SKIP_IN_MANUAL

#define CGAL_add_named_parameter(X, Y, Z)                                                                \
  template <typename K>                                                                                  \
  Conformal_equivalence::Conformal_named_parameters<K, CGAL::internal_np::X> Z(const K& k) { return {k}; }

namespace parameters {
#include <CGAL/Conformal_equivalence/internal/parameters_interface.h>
} // namespace parameters

// The same functions again, and those of CGAL with them, that begin a chain of both.
namespace Conformal_equivalence {
namespace named_parameters {

using CGAL::parameters::default_values;
#define CGAL_add_named_parameter_with_compatibility(X, Y, Z) CGAL_add_named_parameter(X, Y, Z)
#define CGAL_add_extra_named_parameter_with_compatibility(X, Y, Z) CGAL_add_named_parameter(X, Y, Z)
#define CGAL_add_named_parameter_with_compatibility_cref_only(X, Y, Z)                                   \
  template <typename K>                                                                                  \
  Conformal_named_parameters<std::reference_wrapper<const K>, CGAL::internal_np::X> Z(const K& k) { return {std::cref(k)}; }
#define CGAL_add_named_parameter_with_compatibility_ref_only(X, Y, Z)                                    \
  template <typename K>                                                                                  \
  Conformal_named_parameters<std::reference_wrapper<K>, CGAL::internal_np::X> Z(K& k) { return {std::ref(k)}; }
#include <CGAL/STL_Extension/internal/parameters_interface.h>
#include <CGAL/Conformal_equivalence/internal/parameters_interface.h>
#undef CGAL_add_named_parameter_with_compatibility
#undef CGAL_add_extra_named_parameter_with_compatibility
#undef CGAL_add_named_parameter_with_compatibility_cref_only
#undef CGAL_add_named_parameter_with_compatibility_ref_only

} // namespace named_parameters
} // namespace Conformal_equivalence

#undef CGAL_add_named_parameter
/// \endcond

} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_NAMED_PARAMETERS_H
