// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The energy E on all of Penner's cell decomposition: at each u the triangulation is
// flipped, by Ptolemy's relation, until it is ideal Delaunay for the lengths there. So
// continued, E is twice continuously differentiable and convex, and no triangle that can be helped by
// flips violates the triangle inequality (Gu, Luo, Sun and Wu, 2018; Springborn, 2020). Ptolemy's relation
// commutes with the scaling of lengths, so the flips are made on the lengths at u = 0.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IDEAL_DELAUNAY_ENERGY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IDEAL_DELAUNAY_ENERGY_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/delaunay.h>
#include <CGAL/Conformal_equivalence/internal/energy.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The observer is told of every flip: before_flip(t, e), and after_flip(t, e) when the edge has other ends; and
// by begin_anew(t) that all flips since the construction of the energy are taken back.
template <typename Length, typename Observer>
class Ideal_delaunay_energy : public Conformal_energy<double, Length>
{
  typedef Conformal_energy<double, Length> Base;

public:
  typedef typename Base::Triangulation Triangulation;
  typedef typename Base::Index Index;

  // Keeps references to `t`, which it flips and which nobody else may change, and to the observer.
  Ideal_delaunay_energy(Triangulation& t, Observer& observer)
    : Base(t, true), t_(t), given_(t), flipper_(std::make_unique<Delaunay_flipper<Length> >(t)), observer_(observer)
  {}

  // what was decided, and how, and whether the triangulation is Delaunay
  Delaunay_flipper<Length>& flipper() { return *flipper_; }

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

private:
  bool flip_at(const std::vector<double>& u)
  {
    bool is_finite = Base::evaluate(u);
    for(int round = 0; is_finite && round < 100; ++round)
    {
      std::vector<Index> candidates = suspects();
      if(candidates.empty() || !flip(std::move(candidates)))
        break;
      is_finite = Base::evaluate(u);
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
      for(Index h = 3 * f; h < 3 * f + 3; ++h)
        if(t_.is_flippable(t_.edge(h)))
          result.push_back(t_.edge(h));
    return result;
  }

  // Returns whether anything was flipped.
  bool flip(std::vector<Index> candidates)
  {
    std::vector<Index> flipped;
    flipper_->flip_to_delaunay(this->scales(), std::move(candidates), Flip_rule::PTOLEMY, [&](Index e)
    {
      observer_.before_flip(t_, e);
      flipped.push_back(e);
    });
    for(Index e : flipped)
    {
      this->update_length(e);
      observer_.after_flip(t_, e);
      is_worn_ = is_worn_ || flipper_->length_error(e) > 1e-13;
    }
    return !flipped.empty();
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

  Triangulation& t_;
  const Triangulation given_;
  std::unique_ptr<Delaunay_flipper<Length> > flipper_;
  Observer& observer_;
  bool is_worn_ = false; // some length is known less well than to rounding
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IDEAL_DELAUNAY_ENERGY_H
