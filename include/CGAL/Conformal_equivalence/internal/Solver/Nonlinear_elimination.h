// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What keeps a step of Newton's method from its goal is often a few vertices only, where E is all but not differentiable. After each step
// they are made to fit by themselves, before the step is judged (nonlinear elimination, Cai and Keyes, 2002): one at a time where edges are
// flipped on the way, patch by patch on a triangulation that stays as it is.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_NONLINEAR_ELIMINATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_NONLINEAR_ELIMINATION_H

#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Abstract_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The residual r = Theta~ - Theta^ of an energy, on the free vertices.
class Angle_residual
{
public:
  // Keeps references.
  Angle_residual(Abstract_energy& energy, const Edge_graph& graph, const Vertex_vector& target, Statistics& statistics)
    : energy_(energy), graph_(graph), target_(target), statistics_(statistics)
  {}

  // r at u; false if u is out of the range of double.
  bool evaluate(const Vertex_vector& u, Vertex_vector& r)
  {
    ++statistics_.number_of_evaluations;
    const bool is_finite = energy_.evaluate(u);
    get(r);
    return is_finite;
  }

  // r where the energy is.
  void get(Vertex_vector& r) const
  {
    r.resize(target_.size());
    for(std::size_t v = 0; v < r.size(); ++v)
      r[v] = graph_.is_free(std::uint32_t(v)) ? energy_.angle_sums()[v] - target_[v] : 0;
  }

  Abstract_energy& energy() { return energy_; }
  const Abstract_energy& energy() const { return energy_; }
  const Edge_graph& graph() const { return graph_; }
  const Vertex_vector& target() const { return target_; }

private:
  Abstract_energy& energy_;
  const Edge_graph& graph_;
  const Vertex_vector& target_;
  Statistics& statistics_;
};

class Nonlinear_elimination
{
public:
  typedef std::uint32_t Index;

  // Keeps a reference. `number_of_iterations` is the most that Newton's method may take.
  Nonlinear_elimination(Angle_residual& residual, std::size_t number_of_iterations)
    : residual_(residual), number_of_iterations_(number_of_iterations)
  {}

  // At `trial`, where r is the residual: t times a step away from where it was `before`. Moves the outliers, and
  // returns whether there were any; then r is the residual again.
  bool operator()(double t, const Vertex_vector& before, Vertex_vector& trial, Vertex_vector& r)
  {
    return residual_.energy().has_flips() ? relax_one_by_one(t, before, trial, r) : minimize_patches(t, before, trial, r);
  }

  // Where there is a solution within reach, each vertex is as a rule evaluated by itself at most 30 times, and 3 times in a step;
  // among needles of which the minimum is not to be found, thousands of times.
  bool is_in_vain() const
  {
    const Abstract_energy& energy = residual_.energy();
    return energy.has_flips()
        && double(energy.number_of_probes()) > 1000 + 10. * double(number_of_iterations_) * double(residual_.target().size());
  }

private:
  // Vertices where much is left to do that the step should have done, the largest first.
  std::vector<Index> outliers(double t, const Vertex_vector& before, const Vertex_vector& r) const
  {
    const double tolerable = 0.3; // in radians
    std::vector<std::pair<double, Index> > found;
    for(Index v = 0; v < r.size(); ++v)
      if(std::abs(r[v]) > tolerable && std::abs(r[v] - (1 - t) * before[v]) > tolerable)
        found.emplace_back(-std::abs(r[v]), v);
    std::sort(found.begin(), found.end());
    std::vector<Index> result;
    for(const auto& outlier : found)
      result.push_back(outlier.second);
    return result;
  }

  // Needles appear where u varies much. The angle at the end of a needle goes from 0 to pi while u changes by as little as its
  // width divided by its length: there E is all but not differentiable, Newton's step is wrong but for a tiny part of it,
  // and each of such vertices would stop the line search. Each of them is moved by itself, with flips, to the minimum of E
  // along its u, by a few rounds of Gauss and Seidel's.
  bool relax_one_by_one(double t, const Vertex_vector& before, Vertex_vector& trial, Vertex_vector& r)
  {
    const int rounds = 2;
    const double most = 2; // in u
    // Less than what is left to do: or the next step, misled by the flat end of such a jump of the angle, would end at the same place again.
    const double close = (std::min)(0.01, 0.1 * largest_entry(before));
    bool is_moved = false;
    for(int round = 0; round < rounds; ++round)
    {
      const std::vector<Index> found = outliers(t, before, r);
      if(found.empty() || is_in_vain())
        break;
      for(const Index v : found)
        trial[v] = residual_.energy().relax(v, residual_.target()[v], trial[v], most, close);
      residual_.evaluate(trial, r);
      is_moved = true;
    }
    return is_moved;
  }

  // Around triangles that are broken, or were so before, and around outliers. A patch that is made to fit may break triangles beside
  // it: then once more, around these, too.
  bool minimize_patches(double t, const Vertex_vector& before, Vertex_vector& trial, Vertex_vector& r)
  {
    const int most_rounds = 3;
    bool is_moved = false, is_new = true;
    for(int round = 0; round < most_rounds && is_new; ++round)
    {
      const std::vector<Index> unfit = outliers(t, before, r);
      std::vector<Index> seeds = with_broken_corners(seeds_);
      seeds.insert(seeds.end(), unfit.begin(), unfit.end());
      sort_and_unite(seeds);
      if(seeds.empty())
        break;
      residual_.energy().minimize_around(seeds, residual_.graph(), residual_.target(), trial);
      residual_.evaluate(trial, r);
      is_moved = true;
      if(round == 0)
        seeds_ = seeds;
      is_new = with_broken_corners(seeds).size() > seeds.size();
    }
    return is_moved;
  }

  std::vector<Index> with_broken_corners(std::vector<Index> vertices) const
  {
    const std::vector<Index> corners = residual_.energy().broken_corners();
    vertices.insert(vertices.end(), corners.begin(), corners.end());
    sort_and_unite(vertices);
    return vertices;
  }

  static void sort_and_unite(std::vector<Index>& vertices)
  {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }

  Angle_residual& residual_;
  const std::size_t number_of_iterations_;
  std::vector<Index> seeds_; // of patches: once among them, a vertex remains there
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_NONLINEAR_ELIMINATION_H
