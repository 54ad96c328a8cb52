// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A visitor of any type behind one type, so that what tells it of the progress need not be compiled for each type of visitor anew.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_ANY_VISITOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_ANY_VISITOR_H

#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename Visitor, typename = void> struct has_on_progress : std::false_type {};
template <typename Visitor>
struct has_on_progress<Visitor, std::void_t<decltype(std::declval<Visitor&>().on_progress(Stage(), std::size_t(), double()))> > : std::true_type {};

// Holds a copy of a visitor, or, of one that comes by `std::ref`, a reference to it. Copies of an `Any_visitor` share it.
class Any_visitor
{
public:
  // One that does nothing and never stops.
  Any_visitor() = default;

  template <typename Visitor>
  static Any_visitor of(Visitor visitor)
  {
    Any_visitor result;
    result.visitor_ = std::make_shared<Holder<Visitor> >(std::move(visitor));
    return result;
  }

  void on_stage(Stage stage) const { if(visitor_) visitor_->on_stage(stage); }
  void on_iteration(std::size_t iteration, double residual) const { if(visitor_) visitor_->on_iteration(iteration, residual); }
  void on_progress(Stage stage, std::size_t number, double measure) const { if(visitor_) visitor_->on_progress(stage, number, measure); }
  bool go_further() const { return !visitor_ || visitor_->go_further(); }

private:
  struct Interface
  {
    virtual ~Interface() = default;
    virtual void on_stage(Stage stage) = 0;
    virtual void on_iteration(std::size_t iteration, double residual) = 0;
    virtual void on_progress(Stage stage, std::size_t number, double measure) = 0;
    virtual bool go_further() = 0;
  };

  template <typename Visitor>
  struct Holder : public Interface
  {
    Visitor visitor;

    explicit Holder(Visitor v) : visitor(std::move(v)) {}
    void on_stage(Stage stage) override { unwrap(visitor).on_stage(stage); }
    void on_iteration(std::size_t iteration, double residual) override { unwrap(visitor).on_iteration(iteration, residual); }
    void on_progress(Stage stage, std::size_t number, double measure) override
    {
      typedef std::remove_reference_t<decltype(unwrap(visitor))> Unwrapped;
      if constexpr(has_on_progress<Unwrapped>::value) // optional in the concept
        unwrap(visitor).on_progress(stage, number, measure);
    }
    bool go_further() override { return unwrap(visitor).go_further(); }
  };

  std::shared_ptr<Interface> visitor_;
};

// Asks another visitor whether to go on, and tells it nothing: of what is only a part of a search.
class Asking_visitor
{
public:
  explicit Asking_visitor(Any_visitor other) : other_(std::move(other)) {}

  void on_stage(Stage) {}
  void on_iteration(std::size_t, double) {}
  bool go_further() { return other_.go_further(); }

private:
  Any_visitor other_;
};

// The visitor among the named parameters; one that does nothing if there is none.
template <typename NamedParameters>
Any_visitor visitor_of(const NamedParameters& np)
{
  if constexpr(parameters::is_default_parameter<NamedParameters, internal_np::visitor_t>::value)
    return Any_visitor();
  else
    return Any_visitor::of(parameters::get_parameter(np, internal_np::visitor));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_ANY_VISITOR_H
