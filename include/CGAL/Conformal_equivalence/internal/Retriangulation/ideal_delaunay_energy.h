// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The energy E on all of Penner's cell decomposition: at each u the triangulation is
// flipped, by Ptolemy's relation, until it is ideal Delaunay for the lengths there. So
// continued, E is twice continuously differentiable and convex, and no triangle that can be helped by
// flips violates the triangle inequality (Gu, Luo, Sun and Wu, 2018; Springborn, 2020). Ptolemy's relation
// commutes with the scaling of lengths, so the flips are made on the lengths at u = 0.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_IDEAL_DELAUNAY_ENERGY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_IDEAL_DELAUNAY_ENERGY_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Fixed_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Is told of every flip.
template <typename NT>
class Flip_observer
{
public:
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;

  virtual ~Flip_observer() = default;
  virtual void before_flip(const Triangulation& t, Index e) = 0;
  virtual void after_flip(const Triangulation& t, Index e) = 0; // the edge has other ends now
  virtual void begin_anew(const Triangulation& t) = 0;          // all flips since the last call of keep_flips() are taken back
  virtual void keep_flips() {}                                  // they are not taken back any more
};

template <typename Length>
class Ideal_delaunay_energy : public Conformal_energy<double, Length>
{
  typedef Conformal_energy<double, Length> Base;

public:
  typedef typename Base::Triangulation Triangulation;
  typedef typename Base::Index Index;

  // Keeps references to `t`, which it flips and which nobody else may change, and to the observer.
  Ideal_delaunay_energy(Triangulation& t, Flip_observer<Length>& observer)
    : Base(t, true), t_(t), given_(t), flipper_(std::make_unique<Delaunay_flipper<Length> >(t)), observer_(observer)
  {}

  // It may stop the flips of an evaluation, whose numbers are then those of a triangulation on the way: whoever set it has to ask it as well.
  void set_visitor(const Any_visitor& visitor) { visitor_ = visitor; }

  // what was decided, and how, and whether the triangulation is Delaunay
  Delaunay_flipper<Length>& flipper() { return *flipper_; }

  // evaluations at one vertex, of all calls of relax()
  std::size_t number_of_probes() const { return number_of_probes_; }

  // spent on finding and flipping edges, and on evaluations because of that
  double seconds_of_flips() const { return seconds_; }

  // moves to u, on the triangulation that is ideal Delaunay there
  bool evaluate(const std::vector<double>& u)
  {
    bool is_finite = flip_at(u);
    if(is_finite && is_worn_)
    {
      begin_anew();
      is_finite = flip_at(u);
    }
    return is_finite;
  }

  // Moves u at v alone, from x, until the angle sum there is `target` up to `close`, or by as much as `most`: E
  // goes down. Returns the new u. What is known of other vertices is out of date until the next evaluation.
  double relax(Index v, double target, double x, double most, double close)
  {
    Probe here = probe(v, target, x), there = here;
    const double direction = here.residual > 0 ? 1 : -1, last = x + direction * most;
    double step = 0;
    for(bool is_bracketed = false; !is_bracketed; ) // `here` stays on this side of the zero, `there` comes to lie beyond
    {
      if(std::abs(here.residual) <= close || here.u == last)
        return here.u;
      step = (std::max)({1e-15, 4 * step, std::abs(here.residual) / (std::max)(here.slope, 1e-3)});
      there = probe(v, target, std::abs(last - here.u) > step ? here.u + direction * step : last);
      is_bracketed = there.residual * direction <= 0;
      if(!is_bracketed)
        here = there;
    }
    for(int i = 0; i < 80 && std::abs(there.residual) > close; ++i) // false position, and bisection
    {
      const double part = i % 3 == 2 ? 0.5 : here.residual / (here.residual - there.residual);
      const Probe between = probe(v, target, here.u + (part > 0.05 && part < 0.95 ? part : 0.5) * (there.u - here.u));
      if(between.u == here.u || between.u == there.u)
        break;
      (between.residual * direction > 0 ? here : there) = between;
      if(std::abs(here.residual) <= close)
        return here.u;
    }
    x = std::abs(there.residual) <= close ? there.u : here.u;
    probe(v, target, x);
    return x;
  }

  // Flips what is not Delaunay at the factors s, whichever number type they have, beyond the errors of the lengths. At a
  // solution these are edges that rounding has hidden. Returns whether there were any.
  template <typename Scale>
  bool make_delaunay(const std::vector<Scale>& s, const std::vector<double>& u)
  {
    const Timer timer(seconds_);
    if(!flip(s, all_edges(t_)))
      return false;
    move_to(u);
    return true;
  }

  // On long ways through many triangulations the bounds of the errors of lengths grow, until nothing can be decided any
  // more. The triangulation at u does not depend on the way: it is found again from the one given.
  void begin_anew()
  {
    t_ = given_;
    flipper_ = std::make_unique<Delaunay_flipper<Length> >(t_);
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      this->update_length(e);
    observer_.begin_anew(t_);
    is_worn_ = false;
  }

private:
  // Adds the time until its end.
  class Timer
  {
    double& sum_;
    Stopwatch stopwatch_;

  public:
    explicit Timer(double& sum) : sum_(sum) {}
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    ~Timer() { sum_ += stopwatch_.seconds(); }
  };

  // u at one vertex, and what the angle sum there is then
  struct Probe
  {
    double u, residual, slope;
  };

  Probe probe(Index v, double target, double u)
  {
    ++number_of_probes_;
    this->set_log_scale(v, u);
    if(!factors_.empty())
      factors_[v] = this->scale_with_exponent(v);
    std::vector<Index> candidates;
    t_.for_each_outgoing(v, [&](Index h)
    {
      for(Index e : {t_.edge(h), t_.edge(t_.next(h))})
        if(t_.is_flippable(e))
          candidates.push_back(e);
    });
    {
      const Timer timer(seconds_);
      flip_here(std::move(candidates));
    }
    const std::pair<double, double> sum = this->angle_sum_at(v);
    return {u, sum.first - target, sum.second};
  }

  bool flip_at(const std::vector<double>& u)
  {
    bool is_finite = move_to(u);
    const Timer timer(seconds_);
    for(int round = 0; is_finite && round < 100; ++round)
    {
      std::vector<Index> candidates = suspects();
      if(candidates.empty() || !flip_here(std::move(candidates), visitor_))
        break;
      is_finite = move_to(u);
    }
    return is_finite;
  }

  // Edges with a negative weight, beyond rounding, and those of triangles that violate the triangle inequality.
  std::vector<Index> suspects() const
  {
    std::vector<Index> result;
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      if(this->weights()[e] < -1e-12 && t_.is_flippable(e))
        result.push_back(e);
    for(Index f : this->broken_faces())
      for(const Index h : t_.halfedges(f))
        if(t_.is_flippable(t_.edge(h)))
          result.push_back(t_.edge(h));
    return result;
  }

  bool move_to(const std::vector<double>& u)
  {
    factors_.clear();
    return Base::evaluate(u);
  }

  // At the factors of now. Where they range far, those of all vertices are not made again for each that moves by itself.
  bool flip_here(std::vector<Index> candidates, const Any_visitor& visitor = Any_visitor())
  {
    if(!this->ranges_far())
      return flip(this->scales(), std::move(candidates), visitor);
    if(factors_.empty())
      factors_ = this->scales_with_exponents();
    return flip(factors_, std::move(candidates), visitor);
  }

  // Returns whether anything was flipped.
  template <typename Scale>
  bool flip(const std::vector<Scale>& s, std::vector<Index> candidates, const Any_visitor& visitor = Any_visitor())
  {
    std::vector<Index> flipped;
    flipper_->flip_to_delaunay(s, std::move(candidates), Flip_rule::PTOLEMY, [&](Index e)
    {
      observer_.before_flip(t_, e);
      flipped.push_back(e);
    }, visitor);
    for(Index e : flipped)
    {
      this->update_length(e);
      observer_.after_flip(t_, e);
      is_worn_ = is_worn_ || flipper_->length_error(e) > 1e-13;
    }
    return !flipped.empty();
  }

  Triangulation& t_;
  const Triangulation given_;
  std::unique_ptr<Delaunay_flipper<Length> > flipper_;
  Flip_observer<Length>& observer_;
  Any_visitor visitor_;
  std::vector<Scaled_number<double> > factors_; // those of now, with exponents apart, once they were needed
  double seconds_ = 0;
  std::size_t number_of_probes_ = 0;
  bool is_worn_ = false; // some length is known less well than to rounding
};

// The same as the solver takes it.
template <typename NT>
class Flipping_energy final : public Energy_on_surface<NT, Intrinsic_triangulation<NT> >
{
  typedef Energy_on_surface<NT, Intrinsic_triangulation<NT> > Base;

public:
  typedef typename Base::Factors Factors;

  // Keeps references to `t`, which it flips and which nobody else may change, and to the observer.
  Flipping_energy(Intrinsic_triangulation<NT>& t, Flip_observer<NT>& observer) : Base(t), energy_(t, observer) {}

  Ideal_delaunay_energy<NT>& ideal() { return energy_; }

  void set_concurrency(const Concurrency& concurrency) override
  {
    Base::set_concurrency(concurrency);
    energy_.set_concurrency(concurrency);
  }

  bool evaluate(const Vertex_vector& u) override { return energy_.evaluate(u); }
  const std::vector<double>& angle_sums() const override { return energy_.angle_sums(); }
  const std::vector<double>& weights() const override { return energy_.weights(); }
  const std::vector<std::uint32_t>& broken_faces() const override { return energy_.broken_faces(); }
  std::vector<double> sensitivities() const override { return energy_.sensitivities(); }
  bool has_flips() const override { return true; }
  bool ranges_far() const override { return energy_.ranges_far(); }
  bool stays_broken(const Vertex_vector& d, double most) const override { return energy_.stays_broken(d, most); }
  std::size_t number_of_probes() const override { return energy_.number_of_probes(); }
  double relax(std::uint32_t v, double target, double x, double most, double close) override { return energy_.relax(v, target, x, most, close); }
  bool make_delaunay(const Factors& s, const Vertex_vector& u) override { return energy_.make_delaunay(s, u); }
  void take_flips_back() override { energy_.begin_anew(); }

private:
  Ideal_delaunay_energy<NT> energy_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_IDEAL_DELAUNAY_ENERGY_H
