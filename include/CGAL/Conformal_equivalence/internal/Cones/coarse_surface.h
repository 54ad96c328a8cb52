// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A surface of fewer vertices on which cones are searched for first. Where they go is a matter of the shape of the surface, not of how finely it is
// divided; and what a search costs grows with the number of vertices.
//
// Some vertices, the *seeds*, are chosen such that each vertex is within some edges of one, and no two of them are. The others join the seed
// that is nearest along edges. Seeds bear the curvature of those that have joined them. Between two seeds at the distance d the weight is that of
// finite volumes: the sum of w l / d over the edges, of weight w and length l, that lead from the cell of the one to that of the other. Weights that
// are too large or too tiny throughout scale u, which changes neither places nor angles.
//
// Near a cone of the curvature k u is -k log(r) / (2 pi) at the distance r, and so it is larger at the cone itself the closer the next vertices
// are: for a cell of m vertices by about k log(m) / (4 pi). That is added there, where the largest |u| matters; in means a cell counts more than
// its seed.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_COARSE_SURFACE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_COARSE_SURFACE_H

#include <CGAL/Conformal_equivalence/internal/Cones/Cone_surface.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Coarse_surface
{
  typedef Cone_surface::Index Index;
  typedef Cone_surface::Kind Kind;

public:
  // No two seeds are within so many edges. `are_peaks_seen`: whether u at cones is to be as large as on the surface given, of which a reference is
  // kept. Takes linear time, for a radius of a few edges.
  Coarse_surface(const Cone_surface& fine, std::size_t radius, bool are_peaks_seen) : fine_(fine), are_peaks_seen_(are_peaks_seen)
  {
    choose_seeds(radius);
    make_cells();
    make_vertices();
    make_edges();
  }

  const Cone_surface& surface() const { return coarse_; }
  Index vertex(Index coarse) const { return seeds_[coarse]; } // of the surface given
  Index coarse_vertex(Index v) const { return cell_[v]; }

  // The sums over the cells
  Eigen::VectorXd sums(const Eigen::VectorXd& x) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(seeds_.size()));
    for(std::size_t v = 0; v < cell_.size(); ++v)
      if(cell_[v] != none)
        result[cell_[v]] += x[Eigen::Index(v)];
    return result;
  }

private:
  static constexpr Index none = Intrinsic_triangulation<>::null_index;

  // First on the border, so that nothing beyond it is a cell inside.
  void choose_seeds(std::size_t radius)
  {
    std::vector<char> is_covered(fine_.number_of_vertices(), 0);
    last_visit_.assign(fine_.number_of_vertices(), none);
    for(const Kind kind : {Kind::BORDER, Kind::INNER})
      for(Index v = 0; v < fine_.number_of_vertices(); ++v)
        if(fine_.kind[v] == kind && !is_covered[v])
        {
          cover(v, radius, is_covered);
          seeds_.push_back(v);
        }
  }

  void cover(Index seed, std::size_t radius, std::vector<char>& is_covered)
  {
    ball_.assign(1, seed);
    last_visit_[seed] = seed;
    std::size_t begin = 0;
    for(std::size_t d = 0; d < radius; ++d)
      for(const std::size_t end = ball_.size(); begin < end; ++begin)
        fine_.for_each_neighbour(ball_[begin], [&](Index w, double)
        {
          if(last_visit_[w] == seed)
            return;
          last_visit_[w] = seed;
          ball_.push_back(w);
        });
    for(Index v : ball_)
      is_covered[v] = 1;
  }

  // Sweeps over the edges make distances shorter; few are needed as seeds are not far away, and cells need not be exact.
  void make_cells()
  {
    cell_.assign(fine_.number_of_vertices(), none);
    distance_.assign(fine_.number_of_vertices(), std::numeric_limits<double>::infinity());
    for(std::size_t s = 0; s < seeds_.size(); ++s)
    {
      cell_[seeds_[s]] = Index(s);
      distance_[seeds_[s]] = 0;
    }
    std::vector<Index> changed = seeds_, next;
    for(; !changed.empty(); changed.swap(next), next.clear())
      for(Index v : changed)
        fine_.for_each_neighbour(v, [&](Index w, double length)
        {
          if(!(distance_[v] + length < distance_[w]))
            return;
          distance_[w] = distance_[v] + length;
          cell_[w] = cell_[v];
          next.push_back(w);
        });
  }

  void make_vertices()
  {
    coarse_.u.assign(seeds_.size(), 0.);
    coarse_.ground = 0;
    coarse_.curvature.assign(seeds_.size(), 0.);
    std::vector<double> size(seeds_.size(), 0.);
    for(Index seed : seeds_)
    {
      coarse_.kind.push_back(fine_.kind[seed]);
      coarse_.degree.push_back(fine_.degree[seed]);
      coarse_.own_curvature.push_back(fine_.curvature[seed]);
    }
    for(std::size_t v = 0; v < cell_.size(); ++v)
    {
      if(cell_[v] == none)
        continue;
      size[cell_[v]] += 1;
      if(coarse_.is_inner_vertex(cell_[v]))
        coarse_.curvature[cell_[v]] += fine_.curvature[v];
    }
    for(double x : size)
      coarse_.blur.push_back(are_peaks_seen_ ? std::log(x) / (4 * Number_constants<double>::pi()) : 0.);
  }

  struct Link { Index from, to; double flux, distance; };

  // One edge between cells that are next to each other.
  void make_edges()
  {
    std::vector<Link> links = all_links();
    std::sort(links.begin(), links.end(), [](const Link& x, const Link& y) { return std::make_pair(x.from, x.to) < std::make_pair(y.from, y.to); });
    std::vector<double> lengths;
    for(std::size_t i = 0; i < links.size(); )
    {
      Link all = links[i++];
      for(; i < links.size() && links[i].from == all.from && links[i].to == all.to; ++i)
      {
        all.flux += links[i].flux;
        all.distance = (std::min)(all.distance, links[i].distance);
      }
      coarse_.ends.emplace_back(all.from, all.to);
      coarse_.weights.push_back(all.flux / all.distance);
      lengths.push_back(all.distance);
    }
    make_neighbours(lengths);
  }

  std::vector<Link> all_links() const
  {
    std::vector<Link> result;
    for(std::size_t e = 0; e < fine_.ends.size(); ++e)
    {
      const Index v = fine_.ends[e].first, w = fine_.ends[e].second, a = cell_[v], b = cell_[w];
      if(a == b)
        continue;
      const double length = fine_.lengths[e], distance = distance_[v] + length + distance_[w];
      result.push_back({(std::min)(a, b), (std::max)(a, b), (std::max)(fine_.weights[e], 0.) * length, distance});
    }
    return result;
  }

  void make_neighbours(const std::vector<double>& lengths)
  {
    std::vector<std::size_t> end(seeds_.size() + 1, 0);
    for(const auto& ends : coarse_.ends)
    {
      ++end[ends.first];
      ++end[ends.second];
    }
    coarse_.first_neighbour.assign(1, 0);
    for(std::size_t v = 0; v < seeds_.size(); ++v)
      coarse_.first_neighbour.push_back(coarse_.first_neighbour.back() + end[v]);
    coarse_.neighbours.resize(coarse_.first_neighbour.back());
    std::vector<std::size_t> next(coarse_.first_neighbour.begin(), coarse_.first_neighbour.end() - 1);
    for(std::size_t e = 0; e < coarse_.ends.size(); ++e)
    {
      coarse_.neighbours[next[coarse_.ends[e].first]++] = {coarse_.ends[e].second, lengths[e]};
      coarse_.neighbours[next[coarse_.ends[e].second]++] = {coarse_.ends[e].first, lengths[e]};
    }
    coarse_.lengths = lengths;
  }

  const Cone_surface& fine_;
  const bool are_peaks_seen_;
  Cone_surface coarse_;
  std::vector<Index> seeds_;       // by vertex of the coarse surface
  std::vector<Index> cell_;        // by vertex of the fine one: its seed's
  std::vector<double> distance_;   // from that seed
  std::vector<Index> last_visit_, ball_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_COARSE_SURFACE_H
