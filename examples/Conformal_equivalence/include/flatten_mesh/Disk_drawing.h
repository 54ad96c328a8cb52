// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A picture of a hyperbolic surface in Poincare's disk: the domain that is laid out, its triangles with sides along geodesics, which are
// arcs of circles orthogonal to the unit circle, and, if there is a group, the outlines of its copies around it.

#ifndef FLATTEN_MESH_DISK_DRAWING_H
#define FLATTEN_MESH_DISK_DRAWING_H

#include <CGAL/Conformal_equivalence/Hyperbolic_uniformization.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/words.h>
#include <CGAL/Conformal_equivalence/internal/IO/Text_buffer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace flattening {

class Disk_drawing
{
  typedef CGAL::Conformal_equivalence::Hyperbolic_uniformization     Uniformization;
  typedef CGAL::Conformal_equivalence::Intrinsic_triangulation<double> Triangulation;
  typedef CGAL::Conformal_equivalence::internal::Isometry<double>    Motion;
  typedef CGAL::Conformal_equivalence::internal::Text_buffer         Text_buffer;
  typedef CGAL::Conformal_equivalence::internal::Word                Word;
  typedef std::complex<double>                                       Point;

public:
  // `t` is the triangulation that was given, with the faces that `u.corner_points` are about
  Disk_drawing(const Triangulation& t, const Uniformization& u)
    : t_(t), u_(u), deck_(motions(u.generators), Motion::identity())
  {}

  bool write(std::ostream& out)
  {
    {
      Text_buffer buffer(out);
      buffer << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-1.02 -1.02 2.04 2.04\" width=\"1000\" height=\"1000\">\n"
             << "<rect x=\"-1.02\" y=\"-1.02\" width=\"2.04\" height=\"2.04\" fill=\"#ffffff\"/>\n"
             << "<g fill=\"none\" stroke-linejoin=\"round\">\n";
      if(u_.has_group())
        write_copies(buffer);
      write_domain(buffer);
      buffer << "<circle r=\"1\" stroke=\"#222222\" stroke-width=\"0.004\"/>\n</g></svg>\n";
    }
    out.flush();
    return out.good();
  }

private:
  static std::vector<Motion> motions(const std::vector<Uniformization::Motion>& given)
  {
    std::vector<Motion> result;
    for(const Uniformization::Motion& m : given)
      result.push_back({{m.a[0], m.a[1]}, {m.b[0], m.b[1]}});
    return result;
  }

  Point target(std::uint32_t h) const { return Point(u_.corner_points[h][0], u_.corner_points[h][1]); }
  Point origin(std::uint32_t h) const { return target(t_.previous(h)); }

  static Point moved(const Motion& m, const Point& z)
  {
    const auto w = m({z.real(), z.imag()});
    return Point(w.re, w.im);
  }

  // The y-axis of pictures points down.
  static void write_point(Text_buffer& out, const Point& z) { out << ' ' << rounded(z.real()) << ' ' << rounded(-z.imag()); }

  static double rounded(double x) { return std::round(x * 1e6) / 1e6; }

  // From z to w, after "M z" or something else that ends there.
  static void write_arc(Text_buffer& out, const Point& z, const Point& w)
  {
    // The circle about c with c.c = r^2 + 1 through both: 2 Re(conj(z) c) = 1 + |z|^2, and the same for w.
    const double determinant = z.real() * w.imag() - z.imag() * w.real(), p = (1 + std::norm(z)) / 2, q = (1 + std::norm(w)) / 2;
    const Point c((p * w.imag() - q * z.imag()) / determinant, (q * z.real() - p * w.real()) / determinant);
    const double radius = std::abs(c - z), invisible = 2e-4; // height of the arc
    const bool is_straight = !std::isfinite(radius) || std::norm(w - z) < 8 * radius * invisible;
    if(is_straight)
      out << 'L';
    else
      out << 'A' << rounded(radius) << ' ' << rounded(radius) << " 0 0 " << (determinant > 0 ? '0' : '1') << ' ';
    write_point(out, w);
  }

  void write_edge(Text_buffer& out, const Point& z, const Point& w) const
  {
    out << 'M';
    write_point(out, z);
    write_arc(out, z, w);
  }

  void write_domain(Text_buffer& out) const
  {
    const std::uint32_t most_faces_with_edges = 50000;
    out << "<path fill=\"#d7e3f1\" fill-opacity=\"0.9\" stroke=\"#7d97b5\" stroke-width=\""
        << (t_.number_of_faces() > most_faces_with_edges ? 0. : 0.0006) << "\" d=\"";
    for(std::uint32_t h = 0; h < t_.number_of_halfedges(); h += 3)
    {
      out << 'M';
      write_point(out, origin(h));
      for(std::uint32_t k = 0; k < 3; ++k)
        write_arc(out, origin(h + k), target(h + k));
      out << "Z\n";
    }
    out << "\"/>\n<path stroke=\"#b03a2e\" stroke-width=\"0.003\" d=\"";
    write_outline(out, Motion::identity());
    out << "\"/>\n";
  }

  void write_outline(Text_buffer& out, const Motion& m) const
  {
    for(std::uint32_t h = 0; h < t_.number_of_halfedges(); ++h)
      if(u_.is_seam[t_.edge(h)] || t_.is_border(h))
      {
        write_edge(out, moved(m, origin(h)), moved(m, target(h)));
        out << '\n';
      }
  }

  // Words of the copies beyond the sides of the domain.
  std::set<Word> neighbors() const
  {
    using CGAL::Conformal_equivalence::internal::inverse;
    using CGAL::Conformal_equivalence::internal::product;
    std::set<Word> result;
    for(std::uint32_t h = 0; h < t_.number_of_halfedges(); ++h)
      if(u_.is_seam[t_.edge(h)])
        result.insert(product(u_.corner_words[h], inverse(u_.corner_words[t_.previous(t_.twin(h))])));
    return result;
  }

  // The nearest copies first, as many as can be told apart, and as the file has room for.
  void write_copies(Text_buffer& out)
  {
    const std::size_t seams = static_cast<std::size_t>(std::count(u_.is_seam.begin(), u_.is_seam.end(), 1));
    const std::size_t most_copies = 400, most_edges = 60000;
    const double least_size = 0.01; // 1 - |z| of the center
    const std::set<Word> steps = neighbors();
    std::set<Word> seen = {Word()};
    std::vector<Word> ring = {Word()};
    std::size_t copies = 0;
    out << "<path stroke=\"#c9c9c9\" stroke-width=\"0.0015\" d=\"";
    while(!ring.empty())
    {
      std::vector<Word> next;
      for(const Word& w : ring)
        for(const Word& step : steps)
        {
          Word further = CGAL::Conformal_equivalence::internal::product(w, step);
          if(copies == most_copies || copies * 2 * seams > most_edges || !seen.insert(further).second)
            continue;
          const Motion& m = deck_(further);
          if(1 - size_of(m.center()) < least_size)
            continue;
          write_outline(out, m);
          ++copies;
          next.push_back(std::move(further));
        }
      ring.swap(next);
    }
    out << "\"/>\n";
  }

  const Triangulation& t_;
  const Uniformization& u_;
  CGAL::Conformal_equivalence::internal::Word_values<Motion> deck_;
};

} // namespace flattening

#endif // FLATTEN_MESH_DISK_DRAWING_H
