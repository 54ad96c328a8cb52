// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The convex energy of hyperbolic metrics within a conformal class (Bobenko, Pinkall and Springborn, 2015, section 6; Gu, Guo, Luo, Sun and Wu, "A
// discrete uniformization theorem for polyhedral surfaces II", 2018). The triangulation holds the numbers x = sinh(l/2) in the place of lengths,
// which scale factors multiply: sinh(l~/2) = e^{(u_i + u_j)/2} sinh(l/2). At each u it is flipped until it is Delaunay there, by Ptolemy's relation,
// which holds for the x as it does for lengths.
//
//   dE/du_i = (Theta^_i - Theta~_i) / 2
//   d.(Hess E) d = 1/2 sum over edges ij of w_ij ( (d_i - d_j)^2 + tanh^2(l_ij/2) (d_i + d_j)^2 )
//
// The Hessian is positive definite: nothing need be fixed.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_ENERGY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_ENERGY_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_linear_solver.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/hyperbolic_triangle.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Angle_sum.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The scaled x of the sides of a face, their hyperbolic cosines, and these less 1.
template <typename NT>
struct Hyperbolic_sides
{
  std::array<NT, 3> x, y, m;

  Hyperbolic_sides(const NT& x0, const NT& x1, const NT& x2)
    : x{{x0, x1, x2}}, y{{hyperbolic_cosine(x0), hyperbolic_cosine(x1), hyperbolic_cosine(x2)}},
      m{{hyperbolic_cosine_minus_one(x[0], y[0]), hyperbolic_cosine_minus_one(x[1], y[1]), hyperbolic_cosine_minus_one(x[2], y[2])}}
  {}

  Hyperbolic_sides(const std::array<NT, 3>& sines, const std::array<NT, 3>& cosines, const std::array<NT, 3>& cosines_minus_one)
    : x(sines), y(cosines), m(cosines_minus_one)
  {}

  Hyperbolic_incircle_form<NT> triangle() const { return Hyperbolic_incircle_form<NT>(x, y, m); }
};

// The same of all edges, each of which has two faces.
template <typename NT>
class Hyperbolic_edges
{
public:
  // `x` by edge, scaled
  explicit Hyperbolic_edges(std::vector<NT> x) : x_(std::move(x))
  {
    y_.reserve(x_.size());
    m_.reserve(x_.size());
    for(const NT& sine : x_)
    {
      y_.push_back(hyperbolic_cosine(sine));
      m_.push_back(hyperbolic_cosine_minus_one(sine, y_.back()));
    }
  }

  template <typename Length>
  Hyperbolic_sides<NT> sides_of_face(const Intrinsic_triangulation<Length>& t, std::uint32_t f) const
  {
    const std::uint32_t a = t.edge(3 * f), b = t.edge(3 * f + 1), c = t.edge(3 * f + 2);
    return Hyperbolic_sides<NT>({{x_[a], x_[b], x_[c]}}, {{y_[a], y_[b], y_[c]}}, {{m_[a], m_[b], m_[c]}});
  }

private:
  std::vector<NT> x_, y_, m_;
};

template <typename NT, typename Wide>
Hyperbolic_sides<Wide> scaled_sides(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, std::uint32_t f)
{
  return Hyperbolic_sides<Wide>(wide_length(t, s, 3 * f), wide_length(t, s, 3 * f + 1), wide_length(t, s, 3 * f + 2));
}

template <typename NT>
class Hyperbolic_energy
{
public:
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef std::uint32_t Index;

  // Keeps a reference to `t`, which it flips and which nobody else may change.
  explicit Hyperbolic_energy(Triangulation& t)
    : t_(t), given_(t), flipper_(std::make_unique<Delaunay_flipper<NT> >(t)), x_(t.number_of_edges()), scale_(t.number_of_vertices(), 1.)
  {
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      x_[e] = static_cast<double>(t_.length(e));
  }

  // moves to u, on the triangulation that is Delaunay there: computes angle sums and weights. Returns false if a length overflows, underflows
  // or is no number.
  bool evaluate(const Vertex_vector& u)
  {
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      scale_[v] = std::exp(u[v] / 2);
    bool is_finite = flip_here();
    if(is_finite && is_worn_)
    {
      begin_anew();
      is_finite = flip_here();
    }
    return is_finite;
  }

  const std::vector<double>& angle_sums() const { return angle_sum_; }      // by vertex
  const std::vector<double>& weights() const { return weight_; }            // w, by edge
  const std::vector<Index>& broken_faces() const { return broken_; }        // that violate the triangle inequality
  const std::vector<Index>& flips() const { return flips_; }                // in order
  std::size_t number_of_changes() const { return changes_; }                // of the triangulation; it never falls
  const std::vector<double>& sensitivities() const { return sensitivity_; } // of the angle sums to relative errors of x, by vertex
  Delaunay_flipper<NT>& flipper() { return *flipper_; }

  // Minus the derivative of the angle sums.
  Coupled_vertices hessian() const
  {
    Coupled_vertices result;
    result.coupling.resize(t_.number_of_edges());
    result.own.assign(t_.number_of_vertices(), 0.);
    for(Index e = 0; e < t_.number_of_edges(); ++e)
    {
      const Index i = t_.origin(t_.edge_halfedge(e)), j = t_.target(t_.edge_halfedge(e));
      const double x = scale_[i] * x_[e] * scale_[j], cosine_square = 1 + x * x; // 1 - tanh^2 = 1 / cosh^2
      result.coupling[e] = 2 * weight_[e] / cosine_square;
      const double own = 2 * weight_[e] * (x / cosine_square * x);
      result.own[i] += own;
      result.own[j] += own;
    }
    return result;
  }

  // Its lower half, for the free vertices.
  Eigen::SparseMatrix<double> hessian(Edge_graph& graph) const
  {
    graph.set_edges(t_);
    const Coupled_vertices whole = hessian();
    return assemble_lower(graph, whole.coupling, whole.own);
  }

  // Flips what is not Delaunay at the factors s of a wider type, beyond the errors of the lengths. Returns whether there was anything to flip.
  template <typename Scale>
  bool make_delaunay(const std::vector<Scale>& s)
  {
    return flip(s, all_edges(t_));
  }

private:
  bool flip_here()
  {
    const int most_rounds = 100; // each flips to the end, as far as rounding lets it see
    const std::size_t before = changes_;
    if(has_flipped_ && std::all_of(scale_.begin(), scale_.end(), [](double s) { return s > 1e-100 && s < 1e100; }))
      flip(scale_, all_edges(t_)); // as there will be more: angles that nobody asks for are not found
    bool is_finite = find_angles();
    for(int round = 0; is_finite && round < most_rounds; ++round)
    {
      std::vector<Index> candidates = suspects();
      if(candidates.empty() || !flip(scale_, std::move(candidates)))
        break;
      is_finite = find_angles();
    }
    has_flipped_ = changes_ != before;
    return is_finite;
  }

  // Edges with a negative weight, beyond rounding, and those of faces without a circumscribed circle.
  std::vector<Index> suspects() const
  {
    std::vector<Index> result;
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      if(weight_[e] < -1e-12 && t_.is_flippable(e))
        result.push_back(e);
    for(const Index f : without_circle_)
      for(Index h = 3 * f; h < 3 * f + 3; ++h)
        if(t_.is_flippable(t_.edge(h)))
          result.push_back(t_.edge(h));
    return result;
  }

  template <typename Scale>
  bool flip(const std::vector<Scale>& s, std::vector<Index> candidates)
  {
    const std::size_t before = flips_.size();
    flipper_->flip_to_delaunay(s, std::move(candidates), Flip_rule::PTOLEMY, [&](Index e) { flips_.push_back(e); });
    for(std::size_t n = before; n < flips_.size(); ++n)
    {
      ++changes_;
      x_[flips_[n]] = static_cast<double>(t_.length(flips_[n]));
      is_worn_ = is_worn_ || flipper_->length_error(flips_[n]) > 1e-13;
    }
    return flips_.size() > before;
  }

  // On long ways the bounds of the errors of lengths grow. The triangulation at u does not depend on the way.
  void begin_anew()
  {
    t_ = given_;
    flipper_ = std::make_unique<Delaunay_flipper<NT> >(t_);
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      x_[e] = static_cast<double>(t_.length(e));
    flips_.clear();
    ++changes_;
    is_worn_ = false;
  }

  bool find_angles()
  {
    std::vector<Angle_sum<double> > sum(t_.number_of_vertices());
    weight_.assign(t_.number_of_edges(), 0.);
    sensitivity_.assign(t_.number_of_vertices(), 0.);
    broken_.clear();
    without_circle_.clear();
    std::vector<double> scaled(x_);
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      scaled[e] *= scale_[t_.origin(t_.edge_halfedge(e))] * scale_[t_.target(t_.edge_halfedge(e))];
    const Hyperbolic_edges<double> edges(std::move(scaled));
    bool is_finite = true;
    for(Index f = 0; f < t_.number_of_faces(); ++f)
      is_finite = add_face(f, edges.sides_of_face(t_, f), sum) && is_finite;
    angle_sum_.resize(t_.number_of_vertices());
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      angle_sum_[v] = sum[v].radians();
    return is_finite;
  }

  // Returns whether the lengths of the face are positive and finite.
  bool add_face(Index f, const Hyperbolic_sides<double>& sides, std::vector<Angle_sum<double> >& sum)
  {
    const Index h = 3 * f;
    const std::array<double, 3>& x = sides.x;
    if(!(excess(x[0], x[1], x[2]) > 0 && excess(x[1], x[2], x[0]) > 0 && excess(x[2], x[0], x[1]) > 0))
      without_circle_.push_back(f);
    const Hyperbolic_incircle_form<double> triangle = sides.triangle();
    if(!triangle.is_broken())
    {
      const std::array<double, 3> w = hyperbolic_weights(x, triangle);
      const double unit = 1 / triangle.s;
      for(int k = 0; k < 3; ++k)
      {
        sum[t_.apex(h + Index(k))].add(triangle.tangent[k] * unit, triangle.r * unit);
        weight_[t_.edge(h + Index(k))] += w[k];
        sensitivity_[t_.apex(h + Index(k))] += 1 + 2 * (std::abs(w[(k + 1) % 3]) + std::abs(w[(k + 2) % 3]));
      }
    }
    else
    {
      broken_.push_back(f);
      sum[t_.apex(h + Index(longest_side(x[0], x[1], x[2])))].add_straight();
    }
    return x[0] > 0 && x[1] > 0 && x[2] > 0 && std::isfinite(triangle.s);
  }

  Triangulation& t_;
  const Triangulation given_;
  std::unique_ptr<Delaunay_flipper<NT> > flipper_;
  std::vector<double> x_, scale_, angle_sum_, weight_, sensitivity_;
  std::vector<Index> broken_, without_circle_, flips_;
  std::size_t changes_ = 0;
  bool has_flipped_ = false; // in the last evaluation
  bool is_worn_ = false; // some length is known less well than to rounding
};

// Theta~ - Theta^ where the angle sum is prescribed, 0 elsewhere, at the factors s = e^{u/2} of a wide type.
template <typename NT, typename Wide>
Scaled_vector hyperbolic_residual(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, const Conformal_conditions<NT>& conditions)
{
  std::vector<Wide_angle_sum<Wide> > sum(t.number_of_vertices());
  std::vector<Wide> x(t.number_of_edges());
  set_wide_lengths(t, s, 0, t.number_of_edges(), x);
  const Hyperbolic_edges<Wide> edges(std::move(x));
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    add_corners(t, f, edges.sides_of_face(t, f).triangle(), sum);
  return differences_from_targets(t, sum, conditions);
}

// The area of a face: with y = cosh(l/2),  sin(A/2) = sinh(s) r / (2 y_a y_b y_c),  cos(A/2) = (2 + x_a^2 + x_b^2 + x_c^2) / (2 y_a y_b y_c).
template <typename NT>
double hyperbolic_area(const Hyperbolic_sides<NT>& sides)
{
  const Hyperbolic_incircle_form<NT> triangle = sides.triangle();
  const NT cosine = 2 + sides.x[0] * sides.x[0] + sides.x[1] * sides.x[1] + sides.x[2] * sides.x[2];
  return 2 * std::atan2(static_cast<double>(NT(triangle.s * triangle.r)), static_cast<double>(cosine));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_ENERGY_H
