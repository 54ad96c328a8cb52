// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The meta-polygon of a layout (section 6 and Fig. 10 of Springborn, Schroeder and Pinkall, 2008): its sides are paths of the cut between
// special vertices, in pairs that a motion of the plane takes to each other, and pieces of the border.
//
//          a ______ b              Special vertices are the cones, inner vertices with another number of cut edges than
//          /        \              two, and border vertices with a cut edge. If all cones have multiples of 2 pi / n, the
//      p  /          \  p'         motion from p to p' is
//        /            \                z -> e^{2 pi i k / n} z + T
//      c ---- ... ---- d           with an integer k; T is what rectification changes.
//
// Once around a special vertex inside the surface the motions of the paths that are crossed make a rotation by minus its angle sum about it. So
// T at one path hangs on others, and on the positions of the cones: those are the `relations` of the polygon.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_META_POLYGON_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_META_POLYGON_H

#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Quantized_cone.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>

#include <CGAL/number_utils.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Meta_polygon
{
public:
  typedef std::uint32_t Index;
  typedef std::complex<double> Complex;

  // A pair of meta-edges.
  struct Path
  {
    std::vector<Index> halfedges;   // of one side, in order; their twins are the other side
    int quanta = 0;                 // k of the motion z -> e^{2 pi i k / n} z + T from this side to the other
    Complex translation = 0;        // T, as measured in the layout
  };

  // Goes to the other side of a path, or back.
  struct Crossing
  {
    Index path;
    bool is_forward;
  };

  // What takes the first corner of a vertex to another one: the crossings of `parent`, and one more. The motion 0 is the identity.
  struct Motion
  {
    Index parent;
    Crossing crossing;
  };

  // A motion with numbers.
  template <typename T>
  struct Values
  {
    int quanta = 0;
    Lattice_coordinates<T> translation = {{T(0), T(0)}};
  };

  // Once around: the crossings make a rotation by -`quanta` about the vertex; about any point if it is no cone.
  struct Relation
  {
    Index vertex;
    Index cone;                      // its number, or null_index
    std::vector<Crossing> crossings; // counterclockwise, beginning in the first corner
  };

  static constexpr Index null_index = Intrinsic_triangulation<>::null_index;

  Status status = Status::OK;    // NOT_SEAMLESS: the motion across `edges` turns by no multiple of 2 pi / n, but by `amount`
  double amount = 0;
  std::vector<Index> edges;

  std::vector<Path> paths;
  std::vector<Motion> motions;
  std::vector<Index> motion_of_corner;  // by halfedge h: which takes the first corner of target(h) to the one at h
  std::vector<Index> first_corner;      // by vertex: the halfedge that ends there, of the corner that stands for it
  std::vector<Relation> relations;

  template <typename NT>
  Meta_polygon(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut, const Layout<double>& layout,
               const std::vector<Quantized_cone>& cones, const Texture_lattice& lattice)
    : lattice_(lattice), crossing_of_halfedge_(t.number_of_halfedges(), null_index)
  {
    std::vector<Index> cone_at(t.number_of_vertices(), null_index);
    for(Index i = 0; i < cones.size(); ++i)
      cone_at[cones[i].vertex] = i;
    find_paths(t, cut, cone_at);
    for(Path& path : paths)
      measure(t, layout, path);
    if(status == Status::OK)
      go_around_vertices(t, cone_at, cones);
  }

  // The motions for given translations of the paths.
  template <typename T>
  std::vector<Values<T> > values(const std::vector<Lattice_coordinates<T> >& translations) const
  {
    std::vector<Values<T> > result(motions.size());
    for(std::size_t m = 1; m < motions.size(); ++m)
      result[m] = after(result[motions[m].parent], motions[m].crossing, translations);
    return result;
  }

  // The motion `m`, and a crossing after it.
  template <typename T>
  Values<T> after(Values<T> m, const Crossing& crossing, const std::vector<Lattice_coordinates<T> >& translations) const
  {
    const Path& path = paths[crossing.path];
    const Lattice_coordinates<T>& by = translations[crossing.path];
    Lattice_coordinates<T>& p = m.translation;
    if(crossing.is_forward)
    {
      p = lattice_.rotated(path.quanta, p);
      p = {{T(p[0] + by[0]), T(p[1] + by[1])}};
    }
    else
    {
      p = {{T(p[0] - by[0]), T(p[1] - by[1])}};
      p = lattice_.rotated(-path.quanta, p);
    }
    m.quanta = lattice_.reduced(m.quanta + quanta(crossing));
    return m;
  }

  template <typename T>
  Lattice_coordinates<T> apply(const Values<T>& m, const Lattice_coordinates<T>& p) const
  {
    const Lattice_coordinates<T> q = lattice_.rotated(m.quanta, p);
    return {{T(q[0] + m.translation[0]), T(q[1] + m.translation[1])}};
  }

  template <typename T>
  Lattice_coordinates<T> apply_inverse(const Values<T>& m, const Lattice_coordinates<T>& p) const
  {
    return lattice_.rotated(-m.quanta, Lattice_coordinates<T>{{T(p[0] - m.translation[0]), T(p[1] - m.translation[1])}});
  }

  int quanta(const Crossing& crossing) const
  {
    return crossing.is_forward ? paths[crossing.path].quanta : -paths[crossing.path].quanta;
  }

  // How the halfedge `h`, of a face, is crossed; `h` is cut.
  Crossing crossing(Index h) const
  {
    const Index c = crossing_of_halfedge_[h];
    return {c / 2, c % 2 == 0};
  }

private:
  // ---- Paths

  template <typename NT>
  void find_paths(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut, const std::vector<Index>& cone_at)
  {
    std::vector<Index> degree(t.number_of_vertices(), 0);
    const auto is_cut = [&](Index h) { return cut[t.edge(h)] && !t.is_border(h); };
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
      if(is_cut(h))
        ++degree[t.origin(h)];
    const auto is_special = [&](Index v) { return degree[v] != 2 || t.is_border_vertex(v) || cone_at[v] != null_index; };

    for(Index h = 0; h < t.number_of_halfedges(); ++h)
      if(is_cut(h) && is_special(t.origin(h)) && crossing_of_halfedge_[h] == null_index)
        follow(t, h, is_cut, is_special);
    for(Index h = 0; h < t.number_of_halfedges(); ++h) // closed ones
      if(is_cut(h) && crossing_of_halfedge_[h] == null_index)
        follow(t, h, is_cut, [&](Index v) { return is_special(v) || v == t.origin(h); });
  }

  template <typename NT, typename Is_cut, typename Is_special>
  void follow(const Intrinsic_triangulation<NT>& t, Index h, Is_cut is_cut, Is_special is_special)
  {
    const Index number = Index(paths.size());
    Path path;
    for(;;)
    {
      path.halfedges.push_back(h);
      crossing_of_halfedge_[h] = 2 * number;
      crossing_of_halfedge_[t.twin(h)] = 2 * number + 1;
      if(is_special(t.target(h)))
        break;
      Index g = t.twin(h); // begins where h ends
      do
        g = t.next_around_origin(g);
      while(!is_cut(g));
      h = g;
    }
    paths.push_back(std::move(path));
  }

  // The motion from one side to the other, by least squares.
  template <typename NT>
  void measure(const Intrinsic_triangulation<NT>& t, const Layout<double>& layout, Path& path)
  {
    const auto corner = [&](Index h) { return Complex(layout.corner[h][0], layout.corner[h][1]); };
    Complex turn = 0;
    for(Index h : path.halfedges)
    {
      const Complex side = corner(h) - corner(t.previous(h)), other = corner(t.previous(t.twin(h))) - corner(t.twin(h));
      const double size = std::abs(side) * std::abs(other);
      if(size > 0)
        turn += std::abs(side) * (other / std::abs(other)) * std::conj(side / std::abs(side));
    }
    const double quantum = 2 * CGAL_PI / lattice_.symmetry(), angle = std::arg(turn), k = std::round(angle / quantum);
    if(!(std::abs(angle - k * quantum) <= tolerance) && status == Status::OK)
      refuse(t, path, angle);
    path.quanta = lattice_.reduced(int(k));
    const Complex rotation = lattice_.rotation(path.quanta);
    for(Index h : path.halfedges)
      path.translation += corner(t.twin(h)) - rotation * corner(t.previous(h));
    path.translation /= double(path.halfedges.size());
  }

  template <typename NT>
  void refuse(const Intrinsic_triangulation<NT>& t, const Path& path, double angle)
  {
    status = Status::NOT_SEAMLESS;
    amount = angle;
    for(Index h : path.halfedges)
      edges.push_back(t.edge(h));
  }

  // ---- Corners

  template <typename NT>
  void go_around_vertices(const Intrinsic_triangulation<NT>& t, const std::vector<Index>& cone_at, const std::vector<Quantized_cone>& cones)
  {
    motions.assign(1, Motion{0, {null_index, true}});
    motion_of_corner.assign(t.number_of_halfedges(), 0);
    first_corner.assign(t.number_of_vertices(), null_index);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
    {
      if(t.is_isolated_vertex(v))
        continue;
      std::vector<Crossing> crossings;
      Index motion = 0;
      bool is_crossed = false;
      t.for_each_outgoing(v, [&](Index h)
      {
        const Index corner = t.previous(h); // it ends in v, and is crossed next
        if(first_corner[v] == null_index)
          first_corner[v] = corner;
        if(is_crossed)
          motion = number_of(Motion{motion, crossings.back()});
        motion_of_corner[corner] = motion;
        is_crossed = crossing_of_halfedge_[corner] != null_index;
        if(is_crossed)
          crossings.push_back(crossing(corner));
      });
      if(!t.is_border_vertex(v) && !crossings.empty())
        relate(t, v, cone_at[v], cone_at[v] == null_index ? lattice_.symmetry() : cones[cone_at[v]].quanta, std::move(crossings));
    }
  }

  // Along a path nearly all motions are the same.
  Index number_of(const Motion& m)
  {
    const Index key = 2 * m.crossing.path + (m.crossing.is_forward ? 0 : 1);
    if(m.parent == 0)
    {
      const auto known = first_motion_.find(key);
      if(known != first_motion_.end())
        return known->second;
      first_motion_[key] = Index(motions.size());
    }
    motions.push_back(m);
    return Index(motions.size() - 1);
  }

  // Ordinary vertices of a path say nothing: there and back.
  template <typename NT>
  void relate(const Intrinsic_triangulation<NT>& t, Index v, Index cone, long angle, std::vector<Crossing> crossings)
  {
    long sum = angle;
    for(const Crossing& c : crossings)
      sum += quanta(c);
    if(sum % lattice_.symmetry() != 0 && status == Status::OK)
      refuse(t, paths[crossings.front().path], 2 * CGAL_PI / lattice_.symmetry() * double(sum - angle));
    const bool is_there_and_back = crossings.size() == 2 && crossings[0].path == crossings[1].path
                                && crossings[0].is_forward != crossings[1].is_forward;
    if(cone != null_index || !is_there_and_back)
      relations.push_back({v, cone, std::move(crossings)});
  }

  // A rotation that differs by more (radians) from a multiple of 2 pi / n is none: far above the errors of angle sums, far below one that is meant.
  static constexpr double tolerance = 1e-6;

  Texture_lattice lattice_;
  std::vector<Index> crossing_of_halfedge_;  // 2 * path + (0: its side, 1: the other), or null_index
  std::map<Index, Index> first_motion_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_META_POLYGON_H
