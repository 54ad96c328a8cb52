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
#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_incircle_vectors.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_linear_solver.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/hyperbolic_triangle.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Vector_of.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_angle_sums.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <CGAL/number_type_config.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

  Hyperbolic_incircle_form<NT> triangle() const { return Hyperbolic_incircle_form<NT>(x, y, m); }
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
  Delaunay_flipper<NT>& flipper() { return *flipper_; }

  // Of the angle sums to relative errors of x, by vertex. Linear time.
  std::vector<double> sensitivities() const
  {
    std::vector<double> result(t_.number_of_vertices(), 0.);
    for(Index f = 0; f < t_.number_of_faces(); ++f)
    {
      const Hyperbolic_sides<double> sides = sides_of(f);
      const Hyperbolic_incircle_form<double> triangle = sides.triangle();
      if(triangle.is_broken())
        continue;
      const std::array<double, 3> w = hyperbolic_weights(sides.x, triangle);
      for(int k = 0; k < 3; ++k)
        result[t_.apex(3 * f + Index(k))] += 1 + 2 * (std::abs(w[(k + 1) % 3]) + std::abs(w[(k + 2) % 3]));
    }
    return result;
  }

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

  // Vectors of any width give the same bits, if the program is not compiled for fused multiplications.
  bool find_angles()
  {
    angle_sum_.assign(t_.number_of_vertices(), 0.);
    weight_.assign(t_.number_of_edges(), 0.);
    broken_.clear();
    without_circle_.clear();
    return has_avx2() ? add_faces_by_vectors<32>() : add_faces_by_vectors<16>();
  }

  // Of some thousand faces at a time angles and weights are computed, and then added. Returns whether all lengths are positive and finite.
  template <int bytes>
  bool add_faces_by_vectors()
  {
    typedef Hyperbolic_incircle_vectors<bytes> Faces;
    const Index all = t_.number_of_faces() / Faces::lanes, many = 2048 / Faces::lanes;
    std::vector<Faces> faces((std::min)(all, many));
    bool is_finite = true;
    for(Index first = 0; first < all; first += many)
    {
      const Index n = (std::min)(many, all - first);
      compute(first, first + n, faces.data());
      for(Index b = 0; b < n; ++b)
        for(int i = 0; i < Faces::lanes; ++i)
          is_finite = add_face((first + b) * Faces::lanes + Index(i), i, faces[b]) && is_finite;
    }
    for(Index f = all * Faces::lanes; f < t_.number_of_faces(); ++f)
      is_finite = add_face(f) && is_finite;
    return is_finite;
  }

  // The blocks of faces from `first` on, as many as there are lanes in each.
  void compute(Index first, Index last, Hyperbolic_incircle_vectors<16>* faces) const { compute_blocks(first, last, faces); }
  CGAL_CONFORMAL_EQUIVALENCE_AVX2 void compute(Index first, Index last, Hyperbolic_incircle_vectors<32>* faces) const
  {
    compute_blocks(first, last, faces);
  }

  template <typename Faces>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void compute_blocks(Index first, Index last, Faces* faces) const
  {
    double entries[Faces::lanes];
    for(Index b = first; b < last; ++b)
    {
      typename Faces::Vector x[3];
      for(Index k = 0; k < 3; ++k)
      {
        for(int i = 0; i < Faces::lanes; ++i)
          entries[i] = scaled_length(3 * (b * Faces::lanes + Index(i)) + k);
        std::memcpy(&x[k], entries, sizeof(entries));
      }
      faces[b - first].compute(x);
    }
  }

  // The scaled x of a halfedge, the same for both sides of an edge.
  double scaled_length(Index h) const { return x_[t_.edge(h)] * (scale_[t_.origin(h)] * scale_[t_.target(h)]); }

  // Adds lane i, which is f. Returns whether the lengths of the face are positive and finite.
  template <typename Faces>
  bool add_face(Index f, int i, const Faces& faces)
  {
    if(faces.is_plain[i] == 0)
      return add_face(f);
    for(Index k = 0; k < 3; ++k)
    {
      angle_sum_[t_.apex(3 * f + k)] += faces.angle[k][i];
      weight_[t_.edge(3 * f + k)] += faces.weight[k][i];
    }
    return true;
  }

  Hyperbolic_sides<double> sides_of(Index f) const
  {
    return Hyperbolic_sides<double>(scaled_length(3 * f), scaled_length(3 * f + 1), scaled_length(3 * f + 2));
  }

  // The same for any face.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool add_face(Index f)
  {
    const Index h = 3 * f;
    const Hyperbolic_sides<double> sides = sides_of(f);
    const std::array<double, 3>& x = sides.x;
    if(!(excess(x[0], x[1], x[2]) > 0 && excess(x[1], x[2], x[0]) > 0 && excess(x[2], x[0], x[1]) > 0))
      without_circle_.push_back(f);
    const Hyperbolic_incircle_form<double> triangle = sides.triangle();
    if(!triangle.is_broken())
    {
      const std::array<double, 3> w = hyperbolic_weights(x, triangle);
      for(int k = 0; k < 3; ++k)
      {
        angle_sum_[t_.apex(h + Index(k))] += 2 * std::atan2(triangle.r, triangle.tangent[k]);
        weight_[t_.edge(h + Index(k))] += w[k];
      }
    }
    else
    {
      broken_.push_back(f);
      angle_sum_[t_.apex(h + Index(longest_side(x[0], x[1], x[2])))] += CGAL_PI;
    }
    return x[0] > 0 && x[1] > 0 && x[2] > 0 && std::isfinite(triangle.s);
  }

  Triangulation& t_;
  const Triangulation given_;
  std::unique_ptr<Delaunay_flipper<NT> > flipper_;
  std::vector<double> x_, scale_, angle_sum_, weight_;
  std::vector<Index> broken_, without_circle_, flips_;
  std::size_t changes_ = 0;
  bool has_flipped_ = false; // in the last evaluation
  bool is_worn_ = false; // some length is known less well than to rounding
};

// Hyperbolic triangles, as `Wide_corner_vectors` finds them from the numbers of their sides.
struct Hyperbolic_triangles
{
  static constexpr int numbers_per_side = numbers_per_hyperbolic_side;
  template <int bytes> using Vectors = Wide_hyperbolic_incircle_vectors<bytes>;

  template <typename Wide>
  static Hyperbolic_incircle_form<Wide> triangle(const Wide* a, const Wide* b, const Wide* c)
  {
    return Hyperbolic_incircle_form<Wide>({{a[0], b[0], c[0]}}, {{a[1], b[1], c[1]}}, {{a[2], b[2], c[2]}});
  }
};

// Adds all corners, by the numbers of the sides.
template <typename NT, typename Wide>
void add_hyperbolic_angles(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& sides, std::vector<Wide_angle_sum<Wide> >& sum)
{
  const auto side_of = [&](std::uint32_t h) { return &sides[numbers_per_hyperbolic_side * std::size_t(t.edge(h))]; };
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    add_corners(t, f, Hyperbolic_triangles::triangle(side_of(3 * f), side_of(3 * f + 1), side_of(3 * f + 2)), sum);
}

inline void add_hyperbolic_angles(const Intrinsic_triangulation<double>& t, const std::vector<Double_double>& sides,
                                  std::vector<Wide_angle_sum<Double_double> >& sum)
{
  if(has_avx2())
    add_wide_corners_by<Wide_vectors_with_avx2<Hyperbolic_triangles> >(t, sides, sum, Concurrency());
  else
    add_wide_corners_by<Wide_vectors<16, Hyperbolic_triangles> >(t, sides, sum, Concurrency());
}

// The angle sums, by vertex, at the factors s = e^{u/2} of a wide type.
template <typename NT, typename Wide>
std::vector<Wide_angle_sum<Wide> > hyperbolic_angle_sums(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s)
{
  std::vector<Wide_angle_sum<Wide> > result(t.number_of_vertices());
  add_hyperbolic_angles(t, hyperbolic_sides(wide_lengths(t, s)), result);
  return result;
}

// Theta~ - Theta^ where the angle sum is prescribed, 0 elsewhere.
template <typename NT, typename Wide>
Scaled_vector hyperbolic_residual(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, const Conformal_conditions<NT>& conditions)
{
  return differences_from_targets(t, hyperbolic_angle_sums(t, s), conditions);
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
