// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The energy E on a triangulation that stays as it is, which can also be minimized on small patches of it, while u is held everywhere else.
// Where a triangle is about to break, or has just broken, its angles change like the square root of what u changes by: there Newton's method
// for the whole surface crawls on, long after all the rest has converged. A patch of a few vertices is solved for by itself, in as many
// steps as it takes, at no cost; the steps for the whole surface then see the surface without its kinks (nonlinear elimination,
// Cai and Keyes, 2002).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_PATCHWISE_ENERGY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_PATCHWISE_ENERGY_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Wide_factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/line_search.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Vertices where u is unknown, each connected with the others by edges between them, and the triangles at them.
struct Vertex_patch
{
  typedef std::uint32_t Index;

  std::vector<Index> vertices;
  std::vector<Index> faces;                   // sorted
  std::vector<std::array<Index, 3> > corners; // of the faces: the number in `vertices` of the corner opposite to each side, or null_index
};

// The lower half of what a patch has of the matrix A, by numbers in the patch; entries of equal positions add up.
struct Patch_matrix
{
  std::vector<Matrix_position> lower;
  std::vector<double> values;
};

template <typename Length>
class Patchwise_energy : public Conformal_energy<double, Length>
{
  typedef Conformal_energy<double, Length> Base;

public:
  typedef typename Base::Triangulation Triangulation;
  typedef typename Base::Index Index;

  // As for `Conformal_energy`.
  explicit Patchwise_energy(const Triangulation& t, bool normalize = false)
    : Base(t, normalize), t_(t), patch_of_(t.number_of_vertices(), Index(Triangulation::null_index))
  {}

  // Minimizes E on the patches that the vertices in `seeds` and their neighbors make up, as far as they are unknowns. u changes
  // there; what is known of angle sums and weights is out of date until the next evaluation.
  // \pre the factors are those of u
  void minimize_around(const std::vector<Index>& seeds, const Edge_graph& graph, const Vertex_vector& target, Vertex_vector& u)
  {
    // The neighborhood of a few broken triangles has some twenty vertices. What is much larger is no outlier but the problem itself.
    const std::size_t most_vertices = 400;
    for(const Vertex_patch& patch : patches_around(seeds, graph))
      if(patch.vertices.size() <= most_vertices)
        minimize(patch, target, u);
  }

private:
  // ---- Which vertices

  // The time is linear in the number of triangles at the patches.
  std::vector<Vertex_patch> patches_around(const std::vector<Index>& seeds, const Edge_graph& graph)
  {
    const Index unvisited = Triangulation::null_index - 1;
    std::vector<Index> members;
    const auto add = [&](Index v)
    {
      if(!graph.is_free(v) || graph.is_held(v) || patch_of_[v] == unvisited)
        return;
      patch_of_[v] = unvisited;
      members.push_back(v);
    };
    for(const Index v : seeds)
    {
      add(v);
      for_each_neighbor(v, add);
    }
    std::vector<Vertex_patch> result;
    for(const Index v : members)
      if(patch_of_[v] == unvisited)
        result.push_back(patch_with(v, Index(result.size()), unvisited));
    for(const Index v : members)
      patch_of_[v] = Triangulation::null_index;
    return result;
  }

  template <typename Action>
  void for_each_neighbor(Index v, const Action& action) const
  {
    t_.for_each_outgoing(v, [&](Index h)
    {
      action(t_.target(h));
      action(t_.apex(h)); // at a border the last edge has no halfedge that leaves v
    });
  }

  // All that is unvisited and connected with `start`.
  Vertex_patch patch_with(Index start, Index number, Index unvisited)
  {
    Vertex_patch result;
    const auto add = [&](Index v)
    {
      if(patch_of_[v] != unvisited)
        return;
      patch_of_[v] = number;
      result.vertices.push_back(v);
    };
    add(start);
    for(std::size_t i = 0; i < result.vertices.size(); ++i)
      for_each_neighbor(Index(result.vertices[i]), add);
    std::sort(result.vertices.begin(), result.vertices.end());
    find_faces(result);
    return result;
  }

  void find_faces(Vertex_patch& patch) const
  {
    for(const Index v : patch.vertices)
      t_.for_each_outgoing(v, [&](Index h) { patch.faces.push_back(Triangulation::face(h)); });
    std::sort(patch.faces.begin(), patch.faces.end());
    patch.faces.erase(std::unique(patch.faces.begin(), patch.faces.end()), patch.faces.end());
    for(const Index f : patch.faces)
      patch.corners.push_back({{number_of(t_.apex(3 * f), patch), number_of(t_.apex(3 * f + 1), patch), number_of(t_.apex(3 * f + 2), patch)}});
  }

  static Index number_of(Index v, const Vertex_patch& patch)
  {
    const auto found = std::lower_bound(patch.vertices.begin(), patch.vertices.end(), v);
    return found != patch.vertices.end() && *found == v ? Index(found - patch.vertices.begin()) : Index(Triangulation::null_index);
  }

  // ---- Newton's method on one patch

  void minimize(const Vertex_patch& patch, const Vertex_vector& target, Vertex_vector& u)
  {
    const int most_steps = 40;    // where E is smooth it takes five; more where triangles break and mend on the way
    const double close = 1e-9;    // in radians: less than what the next step for the whole surface leaves
    Vertex_vector x;
    for(const Index v : patch.vertices)
      x.push_back(u[v]);
    move_to(patch, x);
    Vertex_vector r = residual_on(patch, target);
    for(int step = 0; step < most_steps && largest_entry(r) > close && move_downhill(patch, target, r, x); ++step)
      continue;
    for(std::size_t i = 0; i < x.size(); ++i)
      u[patch.vertices[i]] = x[i];
  }

  void move_to(const Vertex_patch& patch, const Vertex_vector& x)
  {
    for(std::size_t i = 0; i < x.size(); ++i)
      this->set_log_scale(patch.vertices[i], x[i]);
  }

  Vertex_vector residual_on(const Vertex_patch& patch, const Vertex_vector& target) const
  {
    Vertex_vector result;
    for(const Index v : patch.vertices)
      result.push_back(-target[v]);
    for(std::size_t i = 0; i < patch.faces.size(); ++i)
    {
      const std::array<double, 3> l = this->sides_of(patch.faces[i]);
      const Incircle_form<double> triangle(l[0], l[1], l[2]);
      const bool is_broken = triangle.is_broken();
      for(int k = 0; k < 3; ++k)
        if(patch.corners[i][k] != Triangulation::null_index)
          result[patch.corners[i][k]] += !is_broken ? angle(triangle, k) : k == longest_side(l[0], l[1], l[2]) ? CGAL_PI : 0;
    }
    return result;
  }

  Patch_matrix matrix_on(const Vertex_patch& patch) const
  {
    Patch_matrix result;
    for(std::size_t i = 0; i < patch.faces.size(); ++i)
    {
      const std::array<double, 3> l = this->sides_of(patch.faces[i]);
      const Incircle_form<double> triangle(l[0], l[1], l[2]);
      if(triangle.is_broken())
        continue; // its cotangents count as 0
      for(int k = 0; k < 3; ++k)
        add_weight(patch.corners[i][(k + 1) % 3], patch.corners[i][(k + 2) % 3], cotangent(triangle, k) / 2, result);
    }
    return result;
  }

  static void add_weight(Index i, Index j, double half, Patch_matrix& a)
  {
    const auto add = [&](Index row, Index column, double value)
    {
      if(row == Triangulation::null_index || column == Triangulation::null_index)
        return;
      a.lower.emplace_back((std::max)(row, column), (std::min)(row, column));
      a.values.push_back(value);
    };
    if(i == j)
      return; // a loop: it does not change the angle sum
    add(i, i, half);
    add(j, j, half);
    add(i, j, -half);
  }

  // One step of Newton's method, as far as E does not rise. Returns whether there was one; then r is the residual there.
  bool move_downhill(const Vertex_patch& patch, const Vertex_vector& target, Vertex_vector& r, Vertex_vector& x)
  {
    const double longest = 2;     // in u: far away triangles break that would not have to
    const int most_attempts = 30; // each at most 0.7 times as far as the last
    const Vertex_vector d = newton_step(matrix_on(patch), r);
    const double slope = dot(r, d);
    double t = (std::min)(1., longest / largest_entry(d));
    for(int attempt = 0; attempt < most_attempts && slope > 0 && t > 0; ++attempt)
    {
      Vertex_vector trial(x);
      for(std::size_t i = 0; i < x.size(); ++i)
        trial[i] += t * d[i];
      move_to(patch, trial);
      Vertex_vector r_there = residual_on(patch, target);
      const double slope_there = dot(r_there, d);
      if(slope_there >= -0.5 * slope)
      {
        x.swap(trial);
        r.swap(r_there);
        return true;
      }
      t = shorter_step(t, slope, slope_there);
    }
    move_to(patch, x);
    return false;
  }

  // A^-1 r; r itself where A is singular, as triangles that are broken have no cotangents.
  static Vertex_vector newton_step(Patch_matrix a, const Vertex_vector& r)
  {
    const std::size_t n = r.size();
    Vertex_vector diagonal(n, 0.);
    for(std::size_t i = 0; i < a.lower.size(); ++i)
      if(a.lower[i].first == a.lower[i].second)
        diagonal[a.lower[i].first] += a.values[i];
    const double largest = largest_entry(diagonal);
    for(Index i = 0; i < n; ++i)
    {
      a.lower.emplace_back(i, i);
      a.values.push_back(1e-12 * largest + (diagonal[i] < 1e-6 * largest || largest == 0 ? 1e-3 : 0));
    }
    const Wide_factorization<double> factor(Index(n), a.lower, a.values);
    if(!factor.is_regular())
      return r;
    const Vertex_vector d = factor.solve(r);
    return largest_entry(d) < (std::numeric_limits<double>::max)() && dot(r, d) > 0 ? d : r;
  }

  const Triangulation& t_;
  std::vector<Index> patch_of_; // by vertex, while patches are made; null_index otherwise
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_PATCHWISE_ENERGY_H
