// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The engine of `realize_exactly()`: rational generators with the relation exactly, rational points, and the certificate.
//
// Every triangle is counterclockwise by an exact predicate. Around each vertex the triangles then turn k times, k >= 1, as the labels of a face
// have the product 1 in the group. Gauss-Bonnet makes the sum of all areas 2 pi (2g - 2 - sum of (k - 1)): of which multiple it is, numbers
// rounded to `double` tell.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_REALIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_REALIZATION_H

#include <CGAL/Conformal_equivalence/Hyperbolic_uniformization.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Exact_isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/exact_group.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/words.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Number_constants.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <sstream>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Exact_realization : public Outcome
{
public:
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<double> Triangulation;
  typedef Hyperbolic_uniformization::Wide_number Wide;

  Exact_realization() = default;

  Exact_realization(const Hyperbolic_uniformization& u, double tolerance) : label_(u.labels)
  {
    status = Status::WRONG_TOPOLOGY;
    if(!u.has_group())
      return;
    const double hopeless = 1e-3; // nothing near to such generators satisfies the relation
    // two `double` have about a hundred bits; where they do not do, less would not, either
    const std::vector<int> usual = {24, 32, 48, 64, 80, 96}, many = {128, 192, 256, 384, 512};
    for(const int bits : u.precise_generators.empty() ? usual : many)
    {
      if(u.relation_error < hopeless)
        try_with(u, bits);
      if(status == Status::OK && largest_length_difference_ <= tolerance)
        break;
    }
    find_canonical_generators(u);
    if(status == Status::OK && largest_length_difference_ <= tolerance)
      return;
    if(generator_.empty())
    {
      status = Status::ITERATIONS_EXHAUSTED;
      amount = u.relation_error;
    }
    else if(status == Status::OK)
    {
      status = Status::BOUND_NOT_MET;
      amount = largest_length_difference_;
    }
  }

  const Exact_disk_point& vertex_point(Index v) const { return point_[v]; }

  // Where the target of h is lifted to if its origin is to the chosen lift.
  Exact_disk_point target_point(const Triangulation& t, Index h) const
  {
    return label_[h].empty() ? point_[t.target(h)] : (*deck_)(label_[h])(point_[t.target(h)]);
  }

  // The apex of the face of h, lifted with the origin of h.
  Exact_disk_point apex_point(const Triangulation& t, Index h) const
  {
    const Index last = t.previous(h);
    return label_[last].empty() ? point_[t.origin(last)] : (*deck_)(inverse(label_[last]))(point_[t.origin(last)]);
  }

  const std::vector<Exact_isometry>& canonical_generators() const { return canonical_; }
  const std::vector<Exact_isometry>& generators() const { return generator_; }
  int precision() const { return bits_; }
  double largest_length_difference() const { return largest_length_difference_; }

  std::size_t number_of_digits() const
  {
    std::size_t result = 0;
    for(const Exact_isometry& m : generator_)
      for(const Rational_numerator* x : {&m.p, &m.q, &m.r, &m.s})
      {
        std::ostringstream text;
        text << CGAL::abs(*x);
        result = (std::max)(result, text.str().size());
      }
    return result;
  }

private:
  void try_with(const Hyperbolic_uniformization& u, int bits)
  {
    bits_ = bits;
    faces.clear();
    amount = 0;
    status = Status::NOT_INJECTIVE;
    find_group(u);
    if(generator_.empty())
      return;
    find_points(u);
    certify(u.metric.triangulation, u.genus);
    if(status == Status::OK)
      measure(u);
  }

  void find_group(const Hyperbolic_uniformization& u)
  {
    generator_ = u.precise_generators.empty() ? exact_generators(u.wide_generators, u.wide_generators, u.relation, bits_)
                                              : exact_generators(u.wide_generators, u.precise_generators, u.relation, bits_);
    if(generator_.empty())
      return;
    deck_ = std::make_shared<Word_values<Exact_isometry> >(generator_, Exact_isometry::identity());
  }

  void find_canonical_generators(const Hyperbolic_uniformization& u)
  {
    for(std::size_t n = 0; n < u.canonical_words.size() && !generator_.empty(); ++n)
      canonical_.push_back((*deck_)(u.canonical_words[n]));
  }

  // Points near the border of the disk get more digits: what is d in the middle is about d (1 - |z|^2) there.
  void find_points(const Hyperbolic_uniformization& u)
  {
    point_.clear();
    for(const Isometry<Wide>& frame : u.wide_frames)
    {
      const Complex_number<Wide> z = frame.center();
      int exponent; // |a|^2 = 1 / (1 - |z|^2)
      (void) std::frexp(static_cast<double>(square_norm(frame.a)), &exponent);
      const int bits = bits_ + exponent;
      Rational_numerator d(1);
      for(int n = 0; n < bits; ++n)
        d = d + d;
      point_.push_back({{scaled_integer(z.re, bits), scaled_integer(z.im, bits)}, d});
    }
  }

  void certify(const Triangulation& t, std::size_t genus)
  {
    double area = 0;
    for(Index h = 0; h < t.number_of_halfedges(); h += 3)
    {
      // the last corner from the first one, against the last side
      const Exact_disk_point &p = point_[t.origin(h)], q = target_point(t, h), r = apex_point(t, h);
      const Gaussian_integer half_area = half_area_vector(p, q, r);
      if(half_area.im > 0 && p.depth() > 0 && q.depth() > 0 && r.depth() > 0)
        area += 2 * std::atan2(rounded_quotient(half_area.im, Rational_numerator(CGAL::abs(half_area.re) + half_area.im)),
                               rounded_quotient(half_area.re, Rational_numerator(CGAL::abs(half_area.re) + half_area.im)));
      else
        faces.push_back(t.face(h));
    }
    const double expected = 4 * Number_constants<double>::pi() * (double(genus) - 1), less_than_a_turn = 1;
    if(faces.empty() && std::abs(area - expected) < less_than_a_turn)
      status = Status::OK;
  }

  void measure(const Hyperbolic_uniformization& u)
  {
    const Triangulation& t = u.metric.triangulation;
    largest_length_difference_ = 0;
    for(Index e = 0; e < t.number_of_edges(); ++e)
    {
      const Index h = t.edge_halfedge(e);
      const double length = 2 * std::asinh(half_sinh_of_distance(point_[t.origin(h)], target_point(t, h)));
      largest_length_difference_ = (std::max)(largest_length_difference_, std::abs(length - u.metric.length(h)));
    }
  }

  std::vector<Word> label_;                 // by halfedge
  std::vector<Exact_isometry> canonical_, generator_;
  std::shared_ptr<Word_values<Exact_isometry> > deck_; // which remembers what it was asked for
  std::vector<Exact_disk_point> point_;     // by vertex
  int bits_ = 0;
  double largest_length_difference_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_REALIZATION_H
