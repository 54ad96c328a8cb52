// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file mollify.h
/// Intrinsic mollification (N. Sharp and K. Crane, "A Laplacian for Nonmanifold Triangle Meshes", 2020, section 4.5): the least
/// constant that, added to all edge lengths, makes a proper triangle of every face. So surfaces with coincident points or
/// triangles without area become discrete metrics in the strict sense (Definition 2.1 of Springborn, Schroeder and Pinkall,
/// 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MOLLIFY_H
#define CGAL_CONFORMAL_EQUIVALENCE_MOLLIFY_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Exact_number.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <CGAL/assertions.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceMetric
///
/// What `mollify()` returns. Its status is `OK`, or `INVALID_NUMBER`: some lengths, those of `edges`, are negative or not finite.
template <typename NT_ = double>
struct Mollified_metric : public Outcome
{
  typedef NT_ NT;                            ///< number type of the lengths

  Intrinsic_triangulation<NT> triangulation; ///< with the new lengths; as given if `status` is not `OK`
  std::vector<NT> added;                     ///< by component, in the order of `connected_components()`: what was added to its lengths
};

namespace internal {

// The lengths of one component.
template <typename NT>
class Mollification
{
  typedef std::uint32_t Index;

  Intrinsic_triangulation<NT>& t_;
  std::vector<Index> faces_, edges_;
  std::vector<NT> given_; // by edge of the component
  NT slack_;

public:
  Mollification(Intrinsic_triangulation<NT>& t, std::vector<Index> faces, double relative_slack)
    : t_(t), faces_(std::move(faces))
  {
    NT mean(0), count(0);
    for(const Index f : faces_)
      for(const Index h : t_.halfedges(f))
        if(t_.edge_halfedge(t_.edge(h)) == h)
        {
          edges_.push_back(t_.edge(h));
          given_.push_back(t_.length(t_.edge(h)));
          count += 1;
          mean += (given_.back() - mean) / count; // no sum to overflow
        }
    slack_ = NT(relative_slack) * mean;
  }

  // Adds the least constant, up to rounding, and returns it.
  NT operator()()
  {
    NT constant = missing_length();
    if(!(constant > NT(0)))
      return NT(0);
    for(NT more = constant * std::numeric_limits<NT>::epsilon(); ; more *= 2)
    {
      for(std::size_t n = 0; n < edges_.size(); ++n)
        t_.set_length(edges_[n], given_[n] + constant);
      if(!(missing_length() > NT(0)))
        return constant;
      constant += (std::max)(more, ulp_of_lengths()); // rounding of the sums
    }
  }

private:
  // By how much the worst triangle misses a + b >= c + slack: rounded, but positive iff it does.
  NT missing_length() const
  {
    NT result(0);
    for(const Index f : faces_)
      for(const Index h : t_.halfedges(f))
      {
        const NT &c = t_.halfedge_length(h), &a = t_.halfedge_length(t_.next(h)), &b = t_.halfedge_length(t_.previous(h));
        result = (std::max)(result, missing_length(a, b, c));
      }
    return result;
  }

  NT missing_length(const NT& a, const NT& b, const NT& c) const
  {
    const NT rounded = slack_ - excess(c, a, b);
    const NT bound = 8 * std::numeric_limits<NT>::epsilon() * ((std::max)((std::max)(a, b), c) + slack_);
    if(rounded > bound || rounded < -bound)
      return rounded;
    const Exact_number missing = exact_number(slack_) + exact_number(c) - exact_number(a) - exact_number(b);
    if(missing.sign() != POSITIVE)
      return NT(0);
    return rounded > NT(0) ? rounded : (std::numeric_limits<NT>::min)();
  }

  NT ulp_of_lengths() const
  {
    NT longest(0);
    for(const Index e : edges_)
      longest = (std::max)(longest, t_.length(e));
    return longest * std::numeric_limits<NT>::epsilon();
  }
};

} // namespace internal

/// \ingroup PkgConformalEquivalenceMetric
///
/// adds to all edge lengths of a component the least constant with which a + b >= c + d holds for the sides a, b, c of all of its
/// triangles, in any order (Sharp and Crane, 2020, section 4.5). The slack d is `relative_slack` times the mean edge length of
/// the component before. Nothing is added to a component where this holds already.
///
/// So edges of length zero get at least the length d, and triangles without area get one. The inequalities hold exactly for the
/// lengths as rounded; the constant is the least up to a few units in the last place of the longest edge.
///
/// \param t the surface; it may have lengths that are zero or violate the triangle inequality
/// \param relative_slack positive, such as `1e-5`: what is far below the rounding of lengths would be lost in it
///
/// \return the surface with the new lengths. Linear time.
///
/// \pre `relative_slack > 0`; no vertex is in `non_manifold_vertices(t)`
template <typename NT>
Mollified_metric<NT> mollify(Intrinsic_triangulation<NT> t, double relative_slack)
{
  CGAL_precondition(relative_slack > 0);
  Mollified_metric<NT> result;
  result.triangulation = std::move(t);
  Intrinsic_triangulation<NT>& surface = result.triangulation;
  for(std::uint32_t e = 0; e < surface.number_of_edges(); ++e)
    if(!(surface.length(e) >= NT(0)) || !(surface.length(e) - surface.length(e) == NT(0)))
      result.edges.push_back(e);
  if(!result.edges.empty())
  {
    result.status = Status::INVALID_NUMBER;
    return result;
  }
  const Surface_components pieces = connected_components(surface);
  std::vector<std::vector<std::uint32_t> > faces(pieces.components.size());
  for(std::uint32_t f = 0; f < surface.number_of_faces(); ++f)
    faces[pieces.component_of_vertex[surface.origin(surface.halfedge(f))]].push_back(f);
  for(std::vector<std::uint32_t>& piece : faces)
    result.added.push_back(internal::Mollification<NT>(surface, std::move(piece), relative_slack)());
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MOLLIFY_H
