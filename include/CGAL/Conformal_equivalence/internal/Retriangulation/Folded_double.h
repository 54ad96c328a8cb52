// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The double of a surface with border, folded: what is sought on the double is symmetric, so u at a vertex and at its mirror
// image is one unknown. With P, which gives both the same u, and the energy E of the double, it is half of E(P u) that is
// minimized: its gradient is half the sum over vertex and image, its Hessian half of P^T A P. As long as no edge is flipped,
// these are those of the surface itself, natural border included: targets, residuals, and the matrix of the linear
// systems mean the same on both. Energies, and flips, see the triangulation of the double, which need not be symmetric: where its
// circles are, any diagonal is right.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_FOLDED_DOUBLE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_FOLDED_DOUBLE_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/ideal_delaunay_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The vertices are those of the surface. The edges are links: an edge and its mirror image are one until either is
// flipped; then each is one by itself. (Between a vertex and its image there is a link that is a loop, which has no effect.)
// The faces and their halfedges are those of the double, with the vertices of the surface.
template <typename NT>
class Folded_double
{
public:
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;

  // Keeps references to `twofold`, the double of `t`, and `flipped`, which begins as its triangulation.
  Folded_double(const Triangulation& t, const Surface_double<NT>& twofold, const Triangulation& flipped)
    : twofold_(twofold), t_(flipped), image_(t.number_of_vertices()), original_(flipped.number_of_vertices()),
      number_of_surface_edges_(t.number_of_edges()), mirror_(flipped.number_of_edges()), link_(flipped.number_of_edges())
  {
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      image_[v] = original_[v] = v;
    const Triangulation& d = twofold.triangulation;
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
    {
      const Index g = twofold.image(h); // runs backwards
      image_[t.target(h)] = d.origin(g);
      original_[d.origin(g)] = t.target(h);
      mirror_[d.edge(h)] = d.edge(g);
      mirror_[d.edge(g)] = d.edge(h);
    }
    join();
  }

  // ---- vertices

  Index number_of_vertices() const { return Index(image_.size()); }
  Index number_of_faces() const { return t_.number_of_faces(); }
  Index origin(Index h) const { return original_[t_.origin(h)]; }
  Index target(Index h) const { return original_[t_.target(h)]; }
  const NT& halfedge_length(Index h) const { return t_.halfedge_length(h); }

  Index image(Index v) const { return image_[v]; }
  bool is_on_axis(Index v) const { return image_[v] == v; }

  // P x
  template <typename Number>
  std::vector<Number> spread(const std::vector<Number>& x) const
  {
    std::vector<Number> result;
    if(x.empty())
      return result;
    result.reserve(original_.size());
    for(Index v : original_)
      result.push_back(x[v]);
    return result;
  }

  // P^T x / 2
  std::vector<double> fold(const std::vector<double>& x) const
  {
    std::vector<double> result(image_.size());
    for(Index v = 0; v < result.size(); ++v)
      result[v] = is_on_axis(v) ? x[v] / 2 : (x[v] + x[image_[v]]) / 2;
    return result;
  }

  Conformal_conditions<NT> conditions(const Conformal_conditions<NT>& given) const { return twofold_.conditions(given); }
  const Triangulation& triangulation() const { return t_; }

  // ---- edges

  Index number_of_edges() const { return Index(edge_.size()); }             // links
  Index edge_halfedge(Index link) const { return t_.edge_halfedge(edge_[link]); }
  Index link(Index e) const { return link_[e]; }                            // of the edge e of the double
  Index mirror(Index e) const { return mirror_[e]; }                        // what was its mirror image at the beginning

  // Half of the sum over the edges of each link.
  template <typename Number>
  std::vector<Number> fold_weights(const std::vector<Number>& w) const
  {
    std::vector<Number> result(edge_.size(), Number(0));
    for(Index e = 0; e < w.size(); ++e)
      result[link_[e]] += w[e] / 2;
    return result;
  }

  // All edges are as they were at the beginning.
  void join()
  {
    edge_.clear();
    for(Index e = 0; e < number_of_surface_edges_; ++e)
    {
      edge_.push_back(e);
      link_[e] = link_[mirror_[e]] = e;
    }
  }

  // The edge, or its mirror image, is flipped.
  void part(Index e)
  {
    if(mirror_[e] == e || link_[mirror_[e]] != link_[e])
      return;
    const Index of_image = (std::max)(e, mirror_[e]);
    link_[of_image] = number_of_edges();
    edge_.push_back(of_image);
  }

private:
  const Surface_double<NT>& twofold_;
  const Triangulation& t_;
  std::vector<Index> image_;    // by vertex of the surface: one of the double
  std::vector<Index> original_; // by vertex of the double: the one of the surface
  Index number_of_surface_edges_;
  std::vector<Index> mirror_;   // by edge of the double
  std::vector<Index> link_;     // by edge of the double
  std::vector<Index> edge_;     // by link: one of its edges
};

// ---- what the solver asks of a surface ------------------------------------------------------------------------------

// P^T / 2 of the residual on the double.
template <typename NT, typename Wide>
Scaled_vector scaled_wide_residual(const Folded_double<NT>& t, const std::vector<Wide>& s, const Conformal_conditions<NT>& conditions,
                                   const Concurrency& concurrency = Concurrency())
{
  Scaled_vector result = scaled_wide_residual(t.triangulation(), t.spread(s), t.conditions(conditions), concurrency);
  result.entries = t.fold(result.entries);
  return result;
}

// The largest residual, as an angle of the surface, at a vertex or at its image, for factors `s` by vertex of the double.
// (Both have the same, but for the rounding of the lengths of edges that have no mirror image.)
template <typename NT, typename Wide>
double largest_residual(const Folded_double<NT>& t, const std::vector<Wide>& s, const Conformal_conditions<NT>& conditions)
{
  const std::vector<double> residual = wide_residual(t.triangulation(), s, t.conditions(conditions));
  double result = 0;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    result = t.is_on_axis(v) ? (std::max)(result, std::abs(residual[v]) / 2)
                             : (std::max)({result, std::abs(residual[v]), std::abs(residual[t.image(v)])});
  return result;
}

template <typename Number = double, typename NT, typename Wide>
std::vector<Number> wide_weights(const Folded_double<NT>& t, const std::vector<Wide>& s)
{
  return t.fold_weights(wide_weights<Number>(t.triangulation(), t.spread(s)));
}

// Tells the record of flips, and the links of the linear systems, of every flip on the double.
template <typename NT>
class Folded_flip_observer final : public Flip_observer<NT>
{
public:
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;

  Folded_flip_observer(std::vector<Index>& flips, Laplacian_solver& linear, Folded_double<NT>& folded)
    : flips_(flips), linear_(linear), folded_(folded), number_of_lasting_flips_(flips.size())
  {}

  void before_flip(const Triangulation&, Index e) override { flips_.push_back(e); }

  void after_flip(const Triangulation&, Index e) override
  {
    folded_.part(e);
    for(Index f : {e, folded_.mirror(e)})
      linear_.change_edge(folded_, folded_.link(f));
  }

  void begin_anew(const Triangulation&) override
  {
    flips_.resize(number_of_lasting_flips_);
    folded_.join();
    for(Index e : flips_)
      folded_.part(e);
    linear_.change_edges(folded_);
  }

  void keep_flips() override { number_of_lasting_flips_ = flips_.size(); }

private:
  std::vector<Index>& flips_;
  Laplacian_solver& linear_;
  Folded_double<NT>& folded_;
  std::size_t number_of_lasting_flips_;
};

// Half of the energy of the double, as a function of u on the surface, as the solver takes it.
template <typename NT>
class Folded_energy final : public Energy_on_surface<NT, Folded_double<NT> >
{
  typedef Energy_on_surface<NT, Folded_double<NT> > Base;

public:
  typedef std::uint32_t Index;
  typedef typename Base::Factors Factors;

  // Keeps references to `t`, the double, which it flips, to its folding, and to the observer.
  Folded_energy(Intrinsic_triangulation<NT>& t, const Folded_double<NT>& folded, Flip_observer<NT>& observer)
    : Base(folded), energy_(t, observer)
  {}

  Ideal_delaunay_energy<NT>& ideal() { return energy_; }

  void set_concurrency(const Concurrency& concurrency) override
  {
    Base::set_concurrency(concurrency);
    energy_.set_concurrency(concurrency);
  }

  bool evaluate(const Vertex_vector& u) override
  {
    const bool is_finite = energy_.evaluate(this->surface().spread(u));
    fold();
    return is_finite;
  }

  const std::vector<double>& angle_sums() const override { return angle_sum_; } // by vertex of the surface
  const std::vector<double>& weights() const override { return weight_; }       // by link
  const std::vector<Index>& broken_faces() const override { return energy_.broken_faces(); }
  std::vector<double> sensitivities() const override { return this->surface().fold(energy_.sensitivities()); }
  bool has_flips() const override { return true; }
  bool ranges_far() const override { return energy_.ranges_far(); }
  std::size_t number_of_probes() const override { return energy_.number_of_probes(); }

  // The vertex and its image are moved one after the other, which is the same as both at once unless they are neighbors.
  double relax(Index v, double target, double x, double most, double close) override
  {
    if(this->surface().is_on_axis(v))
      return energy_.relax(v, 2 * target, x, most, close);
    const double result = energy_.relax(v, target, x, most, close);
    energy_.relax(this->surface().image(v), target, result, 0, close); // moves it there
    return result;
  }

  bool make_delaunay(const Factors& s, const Vertex_vector& u) override
  {
    const bool is_changed = energy_.make_delaunay(this->surface().spread(s), this->surface().spread(u));
    fold();
    return is_changed;
  }

  void take_flips_back() override { energy_.begin_anew(); }

private:
  void fold()
  {
    angle_sum_ = this->surface().fold(energy_.angle_sums());
    weight_ = this->surface().fold_weights(energy_.weights());
  }

  Ideal_delaunay_energy<NT> energy_;
  std::vector<double> angle_sum_, weight_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_FOLDED_DOUBLE_H
