// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The overlay of input and flipped triangulation: combinatorics, places of the crossings, the projective maps of the faces.

#define BOOST_TEST_MODULE test_common_refinement
#include "include/boost_test.h"
#include "include/flattened_meshes.h"
#include "include/flipped_metrics.h"

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/compute_common_refinement.h>
#include <CGAL/Conformal_equivalence/make_refined_mesh.h>
#include <CGAL/Conformal_equivalence/Refinement_locator.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/flatten.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polyhedron_3.h>

#include <boost/multiprecision/mpfr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Retriangulation;
using CE::Status;

namespace {

typedef CE::Common_refinement<double>     Refinement;
typedef long double                       Real;
typedef std::array<Real, 3>               Vector;
typedef std::array<Vector, 3>             Matrix; // of columns

const Index null_index = Refinement::null_index;

Real determinant(const Matrix& m)
{
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
       - m[1][0] * (m[0][1] * m[2][2] - m[0][2] * m[2][1])
       + m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]);
}

// x with m x = b
Vector solution(const Matrix& m, const Vector& b)
{
  Vector x;
  for(int k = 0; k < 3; ++k)
  {
    Matrix n = m;
    n[k] = b;
    x[k] = determinant(n) / determinant(m);
  }
  return x;
}

// The neighbouring corners of corner c of the face f.
std::size_t next_corner(const Refinement& r, Index f, std::size_t c) { return c + 1 == r.first_corner[f + 1] ? r.first_corner[f] : c + 1; }
std::size_t previous_corner(const Refinement& r, Index f, std::size_t c) { return c == r.first_corner[f] ? r.first_corner[f + 1] - 1 : c - 1; }

// Barycentric coordinates of a corner in the input face of f, all from which input edges it touches.
Vector barycentric(const Triangulation& t, const Refinement& r, Index f, std::size_t c)
{
  const Index after = r.corner_halfedge[c], before = r.corner_halfedge[previous_corner(r, f, c)];
  Vector b = {{0, 0, 0}};
  if(r.corner_vertex[c] < r.number_of_input_vertices)
  {
    const Index k = after != null_index ? after % 3 : before != null_index ? (before + 1) % 3
                                                    : (r.corner_halfedge[next_corner(r, f, c)] + 2) % 3;
    BOOST_TEST(t.origin(3 * r.input_face[f] + k) == r.corner_vertex[c]);
    b[k] = 1;
    return b;
  }
  const auto& x = r.crossings[r.corner_vertex[c] - r.number_of_input_vertices];
  BOOST_TEST_REQUIRE(((after == null_index) != (before == null_index)));
  const Index h = after != null_index ? after : before;
  BOOST_TEST(t.edge(h) == x.input_edge);
  BOOST_TEST((x.input_parameter > 0 && x.input_parameter < 1));
  BOOST_TEST((x.flat_parameter > 0 && x.flat_parameter < 1));
  const Real s = h == t.edge_halfedge(x.input_edge) ? Real(x.input_parameter) : 1 - Real(x.input_parameter);
  b[h % 3] = 1 - s;
  b[(h + 1) % 3] = s;
  return b;
}

struct Figures
{
  std::size_t crossings = 0, rounded = 0, circles = 0;
  double projective_error = 0, circle_error = 0, angle_error = 0;

  void add(const Figures& other)
  {
    crossings += other.crossings;
    rounded += other.rounded;
    circles += other.circles;
    projective_error = (std::max)(projective_error, other.projective_error);
    circle_error = (std::max)(circle_error, other.circle_error);
    angle_error = (std::max)(angle_error, other.angle_error);
  }
};

// Points drawn at random in the input faces: to the layout and back.
void check_queries(const Triangulation& t, const Refinement& r, unsigned seed)
{
  const CE::Refinement_locator<double> locate(t, r);
  Random random(seed);
  const double size = diameter(r.corner_uv);
  for(int i = 0; i < 200; ++i)
  {
    const Index f = random.below(t.number_of_faces());
    std::array<double, 3> b = {{random(0, 1), random(0, 1), random(0, 1)}};
    const double sum = b[0] + b[1] + b[2];
    for(double& x : b)
      x /= sum;
    const auto there = locate.layout_point(f, b);
    BOOST_TEST(r.input_face[there.face] == f);
    // back: among the points found, unless rounding has moved the point out of a face on the border
    const auto found = locate.surface_points(there.uv);
    const auto same = std::find_if(found.begin(), found.end(), [&](const auto& p) { return p.face == there.face; });
    if(same == found.end() && *std::min_element(b.begin(), b.end()) < 1e-10)
      continue;
    BOOST_TEST_REQUIRE((same != found.end()));
    BOOST_TEST(same->input_face == f);
    const auto again = locate.layout_point(f, same->barycentric);
    BOOST_TEST(std::abs(complex(again.uv) - complex(there.uv)) <= rounded_layout * size);
  }
  for(Index f = 0; f < r.number_of_faces(); f += 5) // corners are where they are
    if(!std::binary_search(r.rounded_faces.begin(), r.rounded_faces.end(), f))
    {
      const auto found = locate.surface_points(r.corner_uv[r.first_corner[f]]);
      BOOST_TEST(std::any_of(found.begin(), found.end(), [&](const auto& p) { return p.face == f; }));
    }
  BOOST_TEST(locate.surface_points({{10 * size, 0}}).empty());
  BOOST_TEST(locate.surface_points({{std::nan(""), 0}}).empty());
  BOOST_TEST(r.input_face[locate.layout_point(0, {{0, 0, 0}}).face] == 0u);
}

// The faces are glued as a surface of the same topology; each input face is the union of its parts.
void check_combinatorics(const Triangulation& t, const Refinement& r)
{
  std::vector<Real> area(t.number_of_faces(), 0);
  std::size_t sides = 0, border_sides = 0, used = 0;
  std::vector<int> is_used(r.number_of_vertices(), 0);
  BOOST_TEST_REQUIRE(r.first_corner.size() == r.number_of_faces() + 1u);
  BOOST_TEST(r.corner_uv.size() == r.corner_vertex.size());
  BOOST_TEST(r.weights.size() == r.number_of_vertices());
  for(Index f = 0; f < r.number_of_faces(); ++f)
  {
    const std::size_t n = r.first_corner[f + 1] - r.first_corner[f];
    BOOST_TEST_REQUIRE((n >= 3 && n <= 6));
    std::vector<Vector> b;
    for(std::size_t c = r.first_corner[f]; c < r.first_corner[f + 1]; ++c)
    {
      b.push_back(barycentric(t, r, f, c));
      for(std::size_t k = 0; k < 3; ++k)
        BOOST_TEST(std::abs(b.back()[k] - Real(CE::input_barycentric(t, r, f, c)[k])) <= unit_roundoff);
      used += is_used[r.corner_vertex[c]]++ == 0;
      const Index h = r.corner_halfedge[c];
      ++sides;
      if(h != null_index)
        BOOST_TEST(t.face(h) == r.input_face[f]);
      border_sides += h != null_index && t.is_border(h);
      BOOST_TEST((r.weights[r.corner_vertex[c]] > 0));
    }
    for(std::size_t i = 1; i + 1 < n; ++i)
    {
      const Real part = determinant({{b[0], b[i], b[i + 1]}});
      BOOST_TEST(part >= -few_roundings);
      area[r.input_face[f]] += part;
    }
  }
  for(Real a : area)
    BOOST_TEST(std::abs(a - 1) <= 100 * few_roundings); // of up to a hundred parts
  for(std::size_t c = 0; c < r.crossings.size(); ++c) // four faces around a crossing, or two
    BOOST_TEST(is_used[r.number_of_input_vertices + c] == (t.is_border_edge(r.crossings[c].input_edge) ? 2 : 4));
  std::size_t isolated = 0;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    isolated += t.is_isolated_vertex(v);
  BOOST_TEST(used == r.number_of_vertices() - isolated);
  BOOST_TEST((sides + border_sides) % 2 == 0u);
  BOOST_TEST(std::ptrdiff_t(used) - std::ptrdiff_t((sides + border_sides) / 2) + std::ptrdiff_t(r.number_of_faces())
             == std::ptrdiff_t(t.number_of_vertices() - isolated) - std::ptrdiff_t(t.number_of_edges()) + std::ptrdiff_t(t.number_of_faces()));
}

// The two sides of every segment of an uncut edge, of both triangulations, are the same, bit by bit; across cuts they differ by the motions.
void check_continuity(const Triangulation& t, const CE::Cut_graph& cut, const CE::Layout<double>& layout, const Refinement& r)
{
  typedef std::array<std::array<double, 2>, 2> Segment;
  typedef std::array<Index, 3> Key; // vertices, and the input edge: in a Delta-complex vertices are not enough
  std::map<Key, std::vector<std::pair<Segment, Index> > > sides;
  for(Index f = 0; f < r.number_of_faces(); ++f)
    for(std::size_t c = r.first_corner[f]; c < r.first_corner[f + 1]; ++c)
    {
      const std::size_t d = next_corner(r, f, c);
      const Index h = r.corner_halfedge[c];
      sides[{{r.corner_vertex[c], r.corner_vertex[d], h == null_index ? null_index : t.edge(h)}}]
        .push_back({{{r.corner_uv[c], r.corner_uv[d]}}, h});
      if(r.corner_vertex[c] < r.number_of_input_vertices) // and vertices lie where compute_layout() puts them
      {
        const Vector b = barycentric(t, r, f, c);
        const Index k = Index(std::max_element(b.begin(), b.end()) - b.begin());
        BOOST_TEST((r.corner_uv[c] == layout.corner[3 * r.input_face[f] + (k + 2) % 3]));
      }
    }
  std::map<Index, std::pair<Complex, Complex> > motion;
  for(const auto& m : layout.transitions)
    motion[m.halfedge] = { complex(m.rotation), complex(m.translation) };
  const double unit = std::ldexp(diameter(layout.corner), -53);
  for(const auto& entry : sides)
    for(const auto& side : entry.second)
    {
      const Index h = side.second;
      if(h != null_index && t.is_border(h))
        continue;
      const auto others = sides.find({{entry.first[1], entry.first[0], entry.first[2]}});
      BOOST_TEST_REQUIRE((others != sides.end()));
      const Segment reversed = {{side.first[1], side.first[0]}};
      if(h == null_index || !cut[t.edge(h)])
        BOOST_TEST(std::count_if(others->second.begin(), others->second.end(),
                                 [&](const auto& other) { return other.first == reversed; }) == 1);
      else if(motion.count(h) != 0)
      {
        const auto& m = motion[h];
        bool found = false;
        for(const auto& other : others->second)
          found = found || (std::abs(m.first * complex(reversed[0]) + m.second - complex(other.first[0])) <= 16 * unit
                            && std::abs(m.first * complex(reversed[1]) + m.second - complex(other.first[1])) <= 16 * unit);
        BOOST_TEST(found);
      }
    }
}

// All corners of a face belong to one projective map. If `preserves_circles`, that takes the circumcircle of the input face to a circle.
Figures check_maps(const Triangulation& t, const Refinement& r, bool preserves_circles)
{
  Figures figures;
  const double unit = std::ldexp(diameter(r.corner_uv), -53);
  for(Index f = 0; f < r.number_of_faces(); ++f)
  {
    const std::size_t first = r.first_corner[f], n = r.first_corner[f + 1] - first;
    std::vector<Vector> b, z; // z: w (x, y, 1), relative to the first corner
    double longest = 0;
    for(std::size_t i = 0; i < n; ++i)
    {
      const std::size_t c = first + i;
      const Real w = r.weights[r.corner_vertex[c]];
      const Real x = Real(r.corner_uv[c][0]) - r.corner_uv[first][0], y = Real(r.corner_uv[c][1]) - r.corner_uv[first][1];
      b.push_back(barycentric(t, r, f, c));
      z.push_back({{w * x, w * y, w}});
      longest = (std::max)(longest, double(std::hypot(x, y)));
    }
    // three corners that span well
    std::array<std::size_t, 3> base = {{0, 1, 2}};
    Real largest = 0;
    for(std::size_t i = 0; i < n; ++i)
      for(std::size_t j = i + 1; j < n; ++j)
        for(std::size_t k = j + 1; k < n; ++k)
        {
          const Real size = determinant({{b[i], b[j], b[k]}});
          if(size > largest)
          {
            largest = size;
            base = {{i, j, k}};
          }
        }
    if(!(largest > 1e-6L))
      continue;
    const Matrix from = {{b[base[0]], b[base[1]], b[base[2]]}}, to = {{z[base[0]], z[base[1]], z[base[2]]}};
    const double noise = unit / longest + 1e-15;
    for(std::size_t i = 0; i < n; ++i)
    {
      const Vector x = solution(from, b[i]);
      Vector image = {{0, 0, 0}};
      Real weight = 0;
      for(int k = 0; k < 3; ++k)
      {
        for(int m = 0; m < 3; ++m)
          image[k] += to[m][k] * x[m];
        weight += std::abs(x[k]) * to[k][2];
      }
      for(int k = 0; k < 3; ++k)
      {
        const double error = double(std::abs(image[k] - z[i][k]) / (weight * (k < 2 ? longest : 1)));
        figures.projective_error = (std::max)(figures.projective_error, error / (noise / double(largest)));
        BOOST_TEST(error <= 4 * noise / double(largest));
      }
    }
    if(!preserves_circles || !(largest > 1e-2L))
      continue;
    // the circumcircle in barycentric coordinates is sum l_ij^2 b_i b_j = 0; its image has the matrix N with N(z, z) = C(b, b)
    Matrix inverse;
    for(int k = 0; k < 3; ++k)
    {
      Vector e = {{0, 0, 0}};
      e[k] = k < 2 ? longest : 1;
      const Vector x = solution(to, e);
      for(int m = 0; m < 3; ++m)
        inverse[k][m] = from[0][m] * x[0] + from[1][m] * x[1] + from[2][m] * x[2];
    }
    const auto product = [&](int i, int j)
    {
      Real sum = 0;
      for(Index k = 0; k < 3; ++k)
      {
        const Real l = t.halfedge_length(3 * r.input_face[f] + k);
        const int p = int(k), q = (int(k) + 1) % 3;
        sum += l * l * (inverse[i][p] * inverse[j][q] + inverse[i][q] * inverse[j][p]);
      }
      return sum;
    };
    const Real xx = product(0, 0), yy = product(1, 1), xy = product(0, 1), size = std::abs(xx) + std::abs(yy);
    Real condition = 0;
    for(int i = 0; i < 3; ++i)
      for(int m = 0; m < 3; ++m)
        for(Index k = 0; k < 3; ++k)
        {
          const Real l = t.halfedge_length(3 * r.input_face[f] + k);
          condition = (std::max)(condition, l * l * inverse[i][m] * inverse[i][m]);
        }
    const double error = double((std::abs(xx - yy) + std::abs(xy)) / size);
    if(condition > 1e5L * size)
      continue;
    ++figures.circles;
    figures.circle_error = (std::max)(figures.circle_error, error);
    BOOST_TEST(error <= 1e3 * noise * double(condition / size) / double(largest) + 1e-12);
  }
  return figures;
}

// Corners lie on the input where they did before the faces were cut into triangles, those between two diagonals, too.
void check_places(const Triangulation& t, const Refinement& r, const Refinement& fine)
{
  typedef std::array<double, 3> Place;
  std::map<std::pair<Index, Index>, std::set<Place> > places; // by input face and vertex: several where the face is glued to itself
  for(Index f = 0; f < r.number_of_faces(); ++f)
    for(std::size_t c = r.first_corner[f]; c < r.first_corner[f + 1]; ++c)
      places[std::make_pair(r.input_face[f], r.corner_vertex[c])].insert(CE::input_barycentric(t, r, f, c));
  std::size_t wrong = 0;
  for(Index f = 0; f < fine.number_of_faces(); ++f)
    for(std::size_t c = fine.first_corner[f]; c < fine.first_corner[f + 1]; ++c)
      wrong += places[std::make_pair(fine.input_face[f], fine.corner_vertex[c])].count(CE::input_barycentric(t, fine, f, c)) == 1 ? 0 : 1;
  BOOST_TEST(wrong == 0u);
}

Figures check_refinement(const Triangulation& t, const Metric& metric, const CE::Cut_graph& cut, const Conditions& conditions,
                         const Refinement& r, bool preserves_circles)
{
  BOOST_TEST_REQUIRE(bool(r));
  check_combinatorics(t, r);
  check_continuity(t, cut, CE::compute_layout(t, metric, cut), r);
  Figures figures = check_maps(t, r, preserves_circles);
  BOOST_TEST(r.flipped_faces.empty());
  figures.crossings = r.crossings.size();
  figures.rounded = r.rounded_faces.size();
  figures.angle_error = CE::angle_sum_error(t, r, conditions);
  BOOST_TEST(figures.angle_error <= 10 * layout_angle); // edges are cut to pieces
  if(!metric.is_retriangulated())
    BOOST_TEST(r.crossings.empty());

  check_queries(t, r, 1);
  std::size_t triangles = 0;
  for(Index f = 0; f < r.number_of_faces(); ++f)
    triangles += r.first_corner[f + 1] - r.first_corner[f] - 2;
  const Refinement fine = CE::triangulate_refinement(r);
  BOOST_TEST(fine.number_of_faces() == triangles);
  BOOST_TEST(fine.flipped_faces.empty());
  BOOST_TEST(fine.rounded_faces.empty() >= r.rounded_faces.empty());
  std::vector<char> is_rounded(fine.number_of_faces(), 0);
  for(Index f : fine.rounded_faces)
    is_rounded[f] = 1;
  for(Index f = 0; f < fine.number_of_faces(); ++f)
  {
    BOOST_TEST_REQUIRE(fine.first_corner[f + 1] == 3 * (f + std::size_t(1)));
    const Complex p = complex(fine.corner_uv[3 * f]), q = complex(fine.corner_uv[3 * f + 1]), s = complex(fine.corner_uv[3 * f + 2]);
    const std::complex<Real> a(std::complex<Real>(q) - std::complex<Real>(p)), b(std::complex<Real>(s) - std::complex<Real>(p));
    const Real area = a.real() * b.imag() - a.imag() * b.real(); // exact but for the last digits of long double
    if(!is_rounded[f])
      BOOST_TEST(area > -std::ldexp(Real(16), -64) * std::abs(a) * std::abs(b)); // some roundings of long double
  }
  check_places(t, r, fine);
  return figures;
}

// Solved, cut, refined, and all of it checked.
Figures refine(const Triangulation& t, const Conditions& conditions, const std::vector<Index>& cones, Retriangulation mode)
{
  const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
  BOOST_TEST_REQUIRE(bool(metric), CE::message(metric.status) << ", residual " << metric.statistics.residual << ", " << metric.flips.size()
                                                               << " flips");
  const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
  BOOST_TEST_REQUIRE(bool(cut));
  const Refinement r = CE::compute_common_refinement(t, metric, cut);
  return check_refinement(t, metric, cut, conditions, r,
                                                 mode != Retriangulation::ALWAYS && metric.statistics.number_of_resolving_flips == 0);
}

void tell(const char* what, const Figures& f)
{
  BOOST_TEST_MESSAGE(what << ": " << f.crossings << " crossings, " << f.rounded << " faces lost by rounding, angle sums off by "
                     << f.angle_error << ", projective maps by " << f.projective_error << " times their noise, "
                     << f.circles << " circles by " << f.circle_error);
}

} // namespace

// --- crossings whose places are known -----------------------------------------------------------

BOOST_AUTO_TEST_CASE(one_flipped_quad)
{
  // two triangles that share the edge from 0 to 2
  const std::vector<std::array<Index, 3> > triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  Triangulation t(4, {0, 1, 2, 0, 2, 3}, CE::glue_triangles(triangles));
  Index diagonal = 0;
  const auto set = [&](Index i, Index j, double l)
  {
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
      if((t.origin(h) == i && t.target(h) == j) || (t.origin(h) == j && t.target(h) == i))
      {
        t.set_length(t.edge(h), l);
        if(i == 0 && j == 2)
          diagonal = t.edge(h);
      }
  };
  set(0, 1, 1);
  set(1, 2, 2);
  set(2, 3, 3);
  set(3, 0, 2.5);
  set(0, 2, 2.5);
  // light-cone vectors x e1 + y e2 + z (1, 0, 0 in the middle): B(a, b) = a0 b2 + a2 b0 - 2 a1 b1, isotropic vectors (p^2, p q, q^2)
  const auto B = [](const Vector& a, const Vector& b) { return a[0] * b[2] + a[2] * b[0] - 2 * a[1] * b[1]; };
  const Real l01 = 1, l12 = 2, l02 = 2.5L, l23 = 3, l03 = 2.5L;
  const auto isotropic = [](Real p, Real q) { return Vector{{p * p, p * q, q * q}}; }; // B is the squared determinant of the pairs
  const Vector v0 = isotropic(1, 0), v2 = isotropic(0, l02), v1 = isotropic(l12 / l02, -l01), v3 = isotropic(l23 / l02, l03);
  const Real rounding = 1e-17L; // of long double, where it has 64 bits, relative to 9: about 2^-60
  BOOST_TEST(std::abs(B(v0, v1) - l01 * l01) <= rounding);
  BOOST_TEST(std::abs(B(v1, v2) - l12 * l12) <= rounding);
  BOOST_TEST(std::abs(B(v2, v3) - l23 * l23) <= rounding);
  BOOST_TEST(std::abs(B(v3, v0) - l03 * l03) <= rounding);
  // a v0 + b v2 - c v1 - d v3 = 0 with a = 1
  const Vector x = solution({{v2, v1, v3}}, v0); // v0 = x0 v2 + x1 v1 + x2 v3
  const Real parameter = -x[0] / (1 - x[0]);     // of v2 in v0 - x0 v2
  const Real across = x[2] / (x[1] + x[2]);      // of v3 in x1 v1 + x2 v3

  const Metric metric = flipped_metric(t, {diagonal}, {.3, -.2, .1, .4});
  const Refinement r = CE::compute_common_refinement(t, metric, CE::Cut_graph());
  BOOST_TEST_REQUIRE(bool(r));
  BOOST_TEST_REQUIRE(r.crossings.size() == 1u);
  BOOST_TEST(r.number_of_faces() == 4u);
  const Refinement::Crossing& c = r.crossings[0];
  BOOST_TEST(c.input_edge == diagonal);
  BOOST_TEST(c.flat_edge == diagonal);
  const bool is_forward = t.origin(t.edge_halfedge(diagonal)) == 0;
  BOOST_TEST(std::abs((is_forward ? Real(c.input_parameter) : 1 - Real(c.input_parameter)) - parameter) <= few_roundings);
  const bool flat_is_forward = metric.triangulation.origin(metric.triangulation.edge_halfedge(diagonal)) == 1;
  BOOST_TEST(std::abs((flat_is_forward ? Real(c.flat_parameter) : 1 - Real(c.flat_parameter)) - across) <= few_roundings);
  // (a v0 + b v2) with a + b = 1 is c v1 + d v3: the weight is c e^-u1 + d e^-u3, for a greatest weight of 1, that of vertex 1
  const Real weight = (x[1] * std::exp(Real(.2)) + x[2] * std::exp(Real(-.4))) / (1 - x[0]) / std::exp(Real(.2));
  BOOST_TEST(std::abs(r.weights[4] - weight) <= few_roundings);
  check_combinatorics(t, r);
}

// Polygons inscribed in a circle: everything is known, whatever is flipped.
BOOST_AUTO_TEST_CASE(chords_of_a_circle)
{
  Random random(7);
  double largest = 0;
  std::size_t crossings = 0, rounded = 0;
  for(Index n = 4; n <= 24; n += 2)
    for(int repeat = 0; repeat < 4; ++repeat)
    {
      const Ideal_polygon p(n, random);
      Triangulation t = p.triangulation;
      std::vector<Index> flips;
      for(Index k = 0; k < 30 * n; ++k)
      {
        const Index e = random.below(t.number_of_edges());
        if(t.is_flippable(e))
        {
          flip(t, e);
          flips.push_back(e);
          if(flips.size() % 8 == 0) // rounding of repeated flips is not the matter here
            for(Index d = 0; d < t.number_of_edges(); ++d)
            {
              const Index h = t.edge_halfedge(d), i = t.origin(h), j = t.target(h);
              t.set_length(d, std::sqrt(p.height[i] * p.height[j]) * std::abs(p.place[i] - p.place[j]));
            }
        }
      }
      Metric metric = flipped_metric(p.triangulation, {}, p.u);
      metric.triangulation = t;
      metric.flips = flips;
      const Refinement r = CE::compute_common_refinement(p.triangulation, metric, CE::Cut_graph(), CE::default_maximum_number_of_crossings,
        params::layout_frame(CE::Pinned_frame<Index>{0, {{p.place[0].real(), p.place[0].imag()}}, n / 2,
                                                     {{p.place[n / 2].real(), p.place[n / 2].imag()}}}));
      BOOST_TEST_REQUIRE(bool(r));
      check_combinatorics(p.triangulation, r);
      crossings += r.crossings.size();
      BOOST_TEST(r.flipped_faces.empty());
      rounded += r.rounded_faces.size();
      std::vector<char> seen(r.number_of_vertices(), 0);
      for(std::size_t c = 0; c < r.corner_vertex.size(); ++c)
      {
        const Index v = r.corner_vertex[c];
        Complex expected = p.place[v < n ? v : 0];
        if(v >= n)
        {
          // where the chords meet
          const Refinement::Crossing& x = r.crossings[v - n];
          const Index h = p.triangulation.edge_halfedge(x.input_edge), g = t.edge_halfedge(x.flat_edge);
          const Index i = p.triangulation.origin(h), j = p.triangulation.target(h), k = t.origin(g), l = t.target(g);
          const auto cross = [](Complex a, Complex b) { return a.real() * b.imag() - a.imag() * b.real(); };
          const Complex a = p.place[j] - p.place[i], b = p.place[l] - p.place[k];
          const double s = cross(p.place[k] - p.place[i], b) / cross(a, b), along = cross(p.place[k] - p.place[i], a) / cross(a, b);
          expected = p.place[i] + s * a;
          const double ratio = s / (1 - s) * p.height[i] / p.height[j], flat_ratio = along / (1 - along) * p.height[k] / p.height[l];
          const double flatness = 1 / std::abs(cross(a, b));
          BOOST_TEST(std::abs(x.input_parameter - ratio / (1 + ratio)) <= 10 * few_roundings * flatness);
          BOOST_TEST(std::abs(x.flat_parameter - flat_ratio / (1 + flat_ratio)) <= 10 * few_roundings * flatness);
          // a v_i + b v_j = (1 - s) * (..) in homogeneous coordinates: the weight of a point of the plane is 1 / its last coordinate
          const double third = (1 - x.input_parameter) * p.height[i] + x.input_parameter * p.height[j];
          const double most = *std::max_element(p.height.begin(), p.height.end());
          BOOST_TEST(std::abs(r.weights[v] - third / most) <= rounded_layout);
        }
        largest = (std::max)(largest, std::abs(complex(r.corner_uv[c]) - expected));
        BOOST_TEST(std::abs(complex(r.corner_uv[c]) - expected) <= 100 * rounded_layout); // where edges cross each other at small angles
      }
    }
  BOOST_TEST(crossings > 1000u);
  BOOST_TEST_MESSAGE(crossings << " crossings of chords; largest distance " << largest << "; " << rounded << " faces lost by rounding");
}

// Lengths of any size, and crossings near the ends of edges.
BOOST_AUTO_TEST_CASE(small_and_large_lengths)
{
  Random random(3);
  for(int repeat = 0; repeat < 5; ++repeat)
  {
    const Ideal_polygon p(14, random);
    Triangulation t = p.triangulation;
    std::vector<Index> flips;
    for(int k = 0; k < 60; ++k)
    {
      const Index e = random.below(t.number_of_edges());
      if(t.is_flippable(e))
      {
        flip(t, e);
        flips.push_back(e);
      }
    }
    std::vector<Refinement> refinements;
    for(int exponent : { 0, 490, -490 })
    {
      const auto scaled = [&](const Triangulation& given)
      {
        std::vector<double> lengths = given.lengths();
        for(double& l : lengths)
          l = std::ldexp(l, exponent);
        return given.with_lengths(lengths);
      };
      Metric metric = flipped_metric(p.triangulation, {}, p.u);
      metric.triangulation = scaled(t);
      metric.flips = flips;
      refinements.push_back(CE::compute_common_refinement(scaled(p.triangulation), metric, CE::Cut_graph()));
      const Refinement& r = refinements.back();
      BOOST_TEST_REQUIRE(bool(r));
      BOOST_TEST(r.is_positive());
      BOOST_TEST_REQUIRE(r.crossings.size() == refinements[0].crossings.size());
      for(std::size_t c = 0; c < r.crossings.size(); ++c)
      {
        BOOST_TEST(std::abs(r.crossings[c].input_parameter - refinements[0].crossings[c].input_parameter) <= few_roundings);
        BOOST_TEST(std::abs(r.crossings[c].flat_parameter - refinements[0].crossings[c].flat_parameter) <= few_roundings);
        BOOST_TEST(std::abs(r.weights[14 + c] - refinements[0].weights[14 + c]) <= few_roundings);
      }
      for(std::size_t c = 0; c < r.corner_uv.size(); ++c)
        BOOST_TEST(std::abs(std::ldexp(1., -exponent) * complex(r.corner_uv[c]) - complex(refinements[0].corner_uv[c])) <= rounded_layout);
    }
  }
}

// Triangles of sizes from 1 to 1e-42 along a spiral: too many for pairs of doubles to tell their corners apart.
BOOST_AUTO_TEST_CASE(more_digits)
{
  typedef boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<100>, boost::multiprecision::et_off> Real_100;
  const Index n = 15;
  std::vector<Complex> place;
  std::vector<std::array<Index, 3> > triangles;
  for(Index i = 0; i < n; ++i)
    place.push_back(std::polar(std::pow(10., -3. * i), double(i)));
  for(Index i = 0; i + 2 < n; ++i)
    triangles.push_back(i % 2 == 0 ? std::array<Index, 3>{{i, i + 1, i + 2}} : std::array<Index, 3>{{i, i + 2, i + 1}});
  std::vector<Index> origin;
  for(const auto& triangle : triangles)
    origin.insert(origin.end(), triangle.begin(), triangle.end());
  Triangulation t(n, origin, CE::glue_triangles(triangles));
  for(Index e = 0; e < t.number_of_edges(); ++e)
    t.set_length(e, std::abs(place[t.origin(t.edge_halfedge(e))] - place[t.target(t.edge_halfedge(e))]));
  Random random(9);
  std::vector<Index> flips;
  for(Index k = 0; k < 10 * n; ++k)
  {
    const Index e = random.below(t.number_of_edges());
    if(!t.is_flippable(e))
      continue;
    flip(t, e);
    flips.push_back(e);
  }
  std::reverse(flips.begin(), flips.end());
  const Metric metric = flipped_metric(t, flips, std::vector<double>(n, 0));
  const Refinement coarse = CE::compute_common_refinement(t, metric, CE::Cut_graph());
  BOOST_TEST_REQUIRE(coarse.crossings.size() > 10u);
  BOOST_TEST(!coarse.is_positive());

  const auto wide_input = t.with_lengths(std::vector<Real_100>(t.lengths().begin(), t.lengths().end()));
  const auto wide_metric = CE::convert_metric<Real_100>(metric);
  const CE::Common_refinement<Real_100> fine = CE::compute_common_refinement(wide_input, wide_metric, CE::Cut_graph());
  BOOST_TEST_REQUIRE(bool(fine));
  BOOST_TEST(fine.is_positive());
  BOOST_TEST(fine.corner_vertex == coarse.corner_vertex);
  for(std::size_t c = 0; c < fine.corner_uv.size(); ++c)
    for(int k = 0; k < 2; ++k)
      BOOST_TEST(std::abs(double(fine.corner_uv[c][k]) - coarse.corner_uv[c][k]) <= rounded_layout);
  for(std::size_t c = 0; c < fine.crossings.size(); ++c)
    BOOST_TEST(std::abs(double(fine.crossings[c].input_parameter) / coarse.crossings[c].input_parameter - 1) <= 10 * few_roundings);
  BOOST_TEST(CE::triangulate_refinement(fine).is_positive());
}

BOOST_AUTO_TEST_CASE(converted_metrics_lose_nothing)
{
  typedef boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<100>, boost::multiprecision::et_off> Real_100;
  const Triangulation t = triangulation<double>(hill(3, .5));
  Metric metric = flipped_metric(t, {}, std::vector<double>(t.number_of_vertices(), -.25));
  metric.is_doubled = true;
  metric.lost_border_edges = {1, 3};
  metric.active_bounds = {2, 5};
  metric.vertices = {0};
  metric.edges = {4};
  metric.faces = {1};
  metric.amount = .5;
  metric.status = Status::ITERATIONS_EXHAUSTED;
  const auto wide = CE::convert_metric<Real_100>(metric);
  BOOST_TEST(wide.is_doubled);
  BOOST_TEST(wide.lost_border_edges == metric.lost_border_edges);
  BOOST_TEST(wide.active_bounds == metric.active_bounds);
  BOOST_TEST(wide.vertices == metric.vertices);
  BOOST_TEST(wide.edges == metric.edges);
  BOOST_TEST(wide.faces == metric.faces);
  BOOST_TEST(wide.amount == metric.amount);
  BOOST_TEST((wide.status == metric.status));
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    BOOST_TEST(double(wide.log_scale_factors[v]) == metric.log_scale_factors[v]);
    BOOST_TEST((wide.scale_factors[v] == Real_100(metric.scale_factors[v].hi) + Real_100(metric.scale_factors[v].lo)));
  }
}

// --- the verdict --------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(convex_polygons)
{
  typedef std::vector<std::array<double, 2> > Polygon;
  const auto is_convex = [](const Polygon& p)
  {
    std::vector<std::array<CE::internal::Double_double, 2> > wide;
    for(const auto& q : p)
      wide.push_back({{q[0], q[1]}});
    const bool result = CE::internal::is_convex_polygon(p);
    BOOST_TEST(CE::internal::is_convex_polygon(wide) == result);
    return result;
  };
  BOOST_TEST(is_convex({ {{0, 0}}, {{1, 0}}, {{0, 1}} }));
  BOOST_TEST(is_convex({ {{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}} }));
  BOOST_TEST(is_convex({ {{0, 0}}, {{1, -1e-300}}, {{2, 0}}, {{1, 1e-300}} }));
  BOOST_TEST(!is_convex({ {{0, 0}}, {{0, 1}}, {{1, 0}} }));                       // clockwise
  BOOST_TEST(!is_convex({ {{0, 0}}, {{1, 0}}, {{2, 0}} }));                       // flat
  BOOST_TEST(!is_convex({ {{0, 0}}, {{1, 0}}, {{2, 0}}, {{1, 1}} }));             // a straight angle
  BOOST_TEST(!is_convex({ {{0, 0}}, {{2, 0}}, {{.5, .5}}, {{0, 2}} }));           // a dent
  BOOST_TEST(!is_convex({ {{0, 0}}, {{1, 0}}, {{0, 1}}, {{1, 1}} }));             // crossing itself
  BOOST_TEST(!is_convex({ {{0, 0}}, {{1, 0}}, {{0, std::nan("")}} }));
  BOOST_TEST(!is_convex({ {{0, 0}}, {{HUGE_VAL, 0}}, {{0, 1}} }));
  Polygon star; // left turns only, but two turns in all
  for(int i = 0; i < 5; ++i)
    star.push_back({{std::cos(4 * pi * i / 5), std::sin(4 * pi * i / 5)}});
  BOOST_TEST(!is_convex(star));
  // beyond the digits of double
  typedef CE::internal::Double_double Wide;
  const std::vector<std::array<Wide, 2> > thin = { {{Wide(0), Wide(0)}}, {{Wide(1), Wide(1)}}, {{Wide(2), Wide(2, 1e-30)}} };
  BOOST_TEST(CE::internal::is_convex_polygon(thin));
  BOOST_TEST(!is_convex({ {{0, 0}}, {{1, 1}}, {{2, 2 + 1e-30}} }));
}

BOOST_AUTO_TEST_CASE(wrong_angles_are_seen)
{
  const Triangulation t = triangulation(hill(5, .4));
  Conditions conditions(t);
  const Metric metric = CE::compute_conformal_metric(t, conditions);
  BOOST_TEST_REQUIRE(bool(metric));
  const Refinement r = CE::compute_common_refinement(t, metric, CE::Cut_graph());
  // six angles between edges as long as a tenth of the layout, whose corners are rounded in its unit: 6 * 10 * 2^-53, and a few times that
  const double turning_error = 1e-12;
  BOOST_TEST(CE::angle_sum_error(t, r, conditions) <= turning_error);
  conditions.prescribe_angle_sum(14, 2 * pi + 1e-6);
  BOOST_TEST(std::abs(CE::angle_sum_error(t, r, conditions) - 1e-6) <= turning_error);

  // A metric that is not flat is noticed where the layout does not close. Each vertex has one place in the plane, so that positive triangles turn
  // once around it, whatever the metric is; but then they cannot have the metric's lengths: around a vertex of curvature K, their angles
  // differ from the metric's by K in all, and the lengths by as much, up to a factor that depends on the shape of the triangles.
  const Metric given = flipped_metric(t, {}, std::vector<double>(t.number_of_vertices(), 0));
  const Refinement open = CE::compute_common_refinement(t, given, CE::Cut_graph());
  BOOST_TEST(open.is_positive());
  BOOST_TEST(CE::angle_sum_error(t, open, Conditions(t)) <= turning_error);
  double curvature = 0;
  const std::vector<double> sums = CE::angle_sums(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_border_vertex(v))
      curvature = (std::max)(curvature, std::abs(2 * pi - sums[v]));
  BOOST_TEST(curvature > .5);
  BOOST_TEST(CE::compute_layout(t, given, CE::Cut_graph()).length_error > curvature / 6); // the triangles at a vertex share it
}

// --- random flips -------------------------------------------------------------------------------

// Combinatorics do not depend on the metric: any flips, also on Delta-complexes, with many crossings of one edge.
BOOST_AUTO_TEST_CASE(random_flips)
{
  std::size_t crossings = 0;
  const std::vector<Triangulation> surfaces = { triangulation(icosahedron()), triangulation(torus(5, 4)), triangulation(hill(4, .5)),
                                                triangulation(together({annulus(2, 7, .3), icosahedron()}, true)),
                                                one_vertex_torus(1., 1.1, .9) };
  for(const Triangulation& t : surfaces)
    for(unsigned seed = 0; seed < 6; ++seed)
    {
      Random random(seed);
      Triangulation current = t;
      std::vector<Index> flips;
      for(Index k = 0; k < (seed + 1) * t.number_of_edges() / 4; ++k)
      {
        const Index e = random.below(t.number_of_edges());
        if(current.is_flippable(e))
        {
          flip(current, e);
          flips.push_back(e);
        }
      }
      const Metric metric = flipped_metric(t, flips, std::vector<double>(t.number_of_vertices(), 0));
      const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
      const Refinement r = CE::compute_common_refinement(t, metric, cut);
      BOOST_TEST_REQUIRE(bool(r));
      check_combinatorics(t, r);
      crossings += r.crossings.size();

      // beyond a limit nothing is made
      if(r.crossings.empty())
        continue;
      BOOST_TEST((CE::compute_common_refinement(t, metric, cut, r.crossings.size()).status == Status::OK));
      const Refinement refused = CE::compute_common_refinement(t, metric, cut, r.crossings.size() - 1);
      BOOST_TEST((refused.status == Status::TOO_MANY_CROSSINGS));
      BOOST_TEST(refused.amount == double(r.crossings.size()));
      BOOST_TEST((!bool(refused) && refused.number_of_faces() == 0 && refused.crossings.empty()));
    }
  BOOST_TEST(crossings > 1000u);
  BOOST_TEST_MESSAGE(crossings << " crossings");
}

// --- metrics ------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(without_flips_it_is_the_mesh)
{
  for(const Soup& soup : { hill(6, .4), annulus(3, 12, .3) })
  {
    const Triangulation t = triangulation(soup);
    const Conditions conditions(t);
    const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(Retriangulation::NEVER));
    const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
    const Refinement r = CE::compute_common_refinement(t, metric, cut);
    check_refinement(t, metric, cut, conditions, r, true);
    BOOST_TEST_REQUIRE(r.number_of_faces() == t.number_of_faces());
    BOOST_TEST(r.is_positive());
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
    {
      BOOST_TEST(r.corner_vertex[h] == t.origin(h));
      BOOST_TEST(r.corner_halfedge[h] == h);
      BOOST_TEST(r.input_face[h / 3] == h / 3);
    }
  }
  const Triangulation nothing;
  BOOST_TEST((CE::compute_common_refinement(nothing, Metric(), CE::Cut_graph()).status == Status::EMPTY_MESH));
}

BOOST_AUTO_TEST_CASE(random_curvatures)
{
  Soup noisy = icosphere(2);
  add_noise(noisy, .05, 3);
  const std::vector<Triangulation> surfaces = { triangulation(icosahedron()), triangulation(noisy), triangulation(torus(9, 6)) };
  for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    Figures figures;
    for(const Triangulation& t : surfaces)
      for(unsigned seed = 0; int(seed) < testing::number_of_cases(3); ++seed)
        for(double spread : { .2, 1., 2. })
          figures.add(refine(t, random_angles(t, spread, seed), all_vertices(t), mode));
    BOOST_TEST(figures.crossings > 100u);
    tell(mode == Retriangulation::ALWAYS ? "random curvatures, always" : "random curvatures, when needed", figures);
  }
}

// Cones of up to 20 pi, and closed surfaces of genus 1 and 2.
BOOST_AUTO_TEST_CASE(cones_and_handles)
{
  const Triangulation ring = triangulation(torus(10, 7));
  for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    Figures figures;
    for(int extra : { 0, 1, 4, 9 })
    {
      Conditions conditions(ring);
      std::vector<Index> cones;
      if(extra > 0)
      {
        conditions.prescribe_angle_sum(3, Angle::pi_times(2 + 2 * extra));
        cones.push_back(3);
      }
      for(Index v = 7; cones.size() < std::size_t(2 * extra) + (extra > 0); v += 3)
      {
        conditions.prescribe_angle_sum(v, Angle::pi_times(1));
        cones.push_back(v);
      }
      figures.add(refine(ring, conditions, cones, mode));
    }
    tell("cones on a torus", figures);
  }

  // lengths drawn at random
  Triangulation t = two_tori();
  BOOST_TEST_REQUIRE(CE::connected_components(t).components[0].genus() == 2u);
  Random random(11);
  for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    Figures figures;
    for(int repeat = 0; repeat < 4; ++repeat)
    {
      for(Index e = 0; e < t.number_of_edges(); ++e)
        t.set_length(e, random(.7, 1.3));
      Conditions conditions(t);
      conditions.prescribe_angle_sum(Index(5 + repeat), Angle::pi_times(6)); // all of 4 pi in one cone
      figures.add(refine(t, conditions, {Index(5 + repeat)}, mode));
    }
    BOOST_TEST(figures.crossings > 0u);
    tell("one cone on a surface of genus 2", figures);
  }
}

// A Delta-complex for input: a torus with one vertex.
BOOST_AUTO_TEST_CASE(torus_with_one_vertex)
{
  Random random(5);
  Figures figures;
  for(int i = 0; i < 10; ++i)
  {
    const double c = random(.8, 1.2), b = random(.8, 1.2), a = random(.8, 1.2); // one after the other, whatever the compiler
    Triangulation t = one_vertex_torus(a, b, c);
    for(int flips = 0; flips < 5; ++flips)
      flip(t, random.below(3));
    figures.add(refine(t, Conditions(t), {}, Retriangulation::WHEN_NEEDED));
  }
  BOOST_TEST(figures.crossings > 0u);
  tell("torus with one vertex", figures);
}

// Metrics of the double: the refinement is that of the surface itself, and border edges are crossed, too.
BOOST_AUTO_TEST_CASE(borders_that_need_the_double)
{
  Soup soup = cone(5, .1);
  Figures figures;
  std::size_t doubled = 0, on_border = 0;
  for(double slope : { .05, .3, 1., 3., 9. })
    for(bool is_straight : { false, true })
      for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
      {
        soup.points[0] = {{.9, 0, slope}};
        const Triangulation t = triangulation(soup);
        Conditions conditions(t);
        if(is_straight)
          for(Index v = 1; v <= 5; ++v)
            conditions.prescribe_angle_sum(v, v == 1 ? Angle::pi_times(1, 30) : v == 2 ? Angle::pi_times(29, 30) : Angle::pi_times(2, 3));
        figures.add(refine(t, conditions, {}, mode));
        const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
        const Refinement r = CE::compute_common_refinement(t, metric, CE::Cut_graph());
        doubled += metric.is_doubled;
        for(const Refinement::Crossing& x : r.crossings)
          on_border += t.is_border_edge(x.input_edge);
      }
  BOOST_TEST(doubled > 0u);
  BOOST_TEST(on_border > 0u);
  tell("metrics of the double", figures);
}

// --- meshes -------------------------------------------------------------------------------------

namespace {

// A mesh refined: positions on the surface, texture coordinates, origins.
template <typename RefinedMesh>
void check_mesh(const Mesh& sm, const CE::Imported_mesh<Mesh>& mesh, const CE::Cut_graph& cut, const Refinement& r, RefinedMesh& out,
                const char* name)
{
  typedef typename boost::graph_traits<RefinedMesh>::halfedge_descriptor halfedge_descriptor;
  std::map<halfedge_descriptor, Point_2> uv;
  std::map<typename boost::graph_traits<RefinedMesh>::vertex_descriptor, double> weight;
  std::map<typename boost::graph_traits<RefinedMesh>::edge_descriptor, bool> seam;
  const auto made = CE::make_refined_mesh(mesh, r, out, boost::make_assoc_property_map(uv), params::vertex_point_map(sm.points()),
                                          params::projective_weight_map(boost::make_assoc_property_map(weight))
                                            .edge_is_seam_map(boost::make_assoc_property_map(seam)));
  BOOST_TEST_REQUIRE(made.faces.size() == r.number_of_faces());
  BOOST_TEST(made.vertices.size() == r.number_of_vertices());
  BOOST_TEST(num_vertices(out) == r.number_of_vertices());
  BOOST_TEST(CGAL::is_valid_polygon_mesh(out));
  BOOST_TEST(num_faces(out) == r.number_of_faces());
  for(Index f = 0; f < r.number_of_faces(); ++f)
    for(std::size_t c = r.first_corner[f]; c < r.first_corner[f + 1]; ++c)
    {
      const halfedge_descriptor h = made.halfedges[c];
      BOOST_TEST((face(h, out) == made.faces[f]));
      BOOST_TEST((target(h, out) == made.vertices[r.corner_vertex[c]]));
      BOOST_TEST((uv.at(h) == Point_2(r.corner_uv[c][0], r.corner_uv[c][1])));
      if(CGAL::is_border(opposite(h, out), out))
        BOOST_TEST((uv.at(opposite(h, out)) == uv.at(prev(h, out))));
    }
  for(Index v = 0; v < r.number_of_vertices(); ++v)
    BOOST_TEST(weight.at(made.vertices[v]) == r.weights[v]);
  for(Index v = 0; v < r.number_of_input_vertices; ++v)
    BOOST_TEST((get(get(CGAL::vertex_point, out), made.vertices[v]) == sm.point(mesh.vertex(v))));
  for(std::size_t c = 0; c < r.crossings.size(); ++c) // on their input edges
  {
    const Edge e = mesh.edge(r.crossings[c].input_edge);
    const Point_3 &p = sm.point(source(halfedge(e, sm), sm)), &q = sm.point(target(halfedge(e, sm), sm)),
                  &x = get(get(CGAL::vertex_point, out), made.vertices[r.number_of_input_vertices + c]);
    BOOST_TEST(std::sqrt(CGAL::squared_distance(p, x)) + std::sqrt(CGAL::squared_distance(x, q))
               <= std::sqrt(CGAL::squared_distance(p, q)) * (1 + few_roundings) + few_roundings * std::sqrt((p - CGAL::ORIGIN).squared_length()));
  }
  for(Index f = 0; f < r.number_of_faces(); ++f) // the seam is made of cut edges
    for(std::size_t c = r.first_corner[f]; c < r.first_corner[f + 1]; ++c)
    {
      const Index h = r.corner_halfedge[c];
      const bool is_cut = h != null_index && !mesh.triangulation.is_border(h) && cut[mesh.triangulation.edge(h)];
      BOOST_TEST(seam.at(edge(made.halfedges[next_corner(r, f, c)], out)) == is_cut);
    }
  BOOST_TEST_MESSAGE(name << ": " << num_vertices(out) << " vertices, " << num_faces(out) << " faces");
}

} // namespace

// A closed mesh with cones and a seam.
BOOST_AUTO_TEST_CASE(closed_mesh)
{
  const Mesh sm = surface_mesh<Mesh>(icosphere(2));
  const CE::Imported_mesh<Mesh> mesh = CE::import_mesh(sm);
  Conditions conditions(mesh.triangulation);
  const std::vector<Index> cones = { 0, 40, 110, 111 };
  conditions.prescribe_angle_sum(0, Angle::pi_times(1, 5));
  for(Index v : { 40, 110, 111 })
    conditions.prescribe_angle_sum(v, Angle::pi_times(19, 15));
  for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    const Metric metric = CE::compute_conformal_metric(mesh.triangulation, conditions, params::retriangulation(mode));
    BOOST_TEST_REQUIRE(bool(metric));
    const CE::Cut_graph cut = CE::compute_cut_graph(mesh.triangulation, cones);
    const Refinement r = CE::compute_common_refinement(mesh.triangulation, metric, cut);
    tell("closed mesh", check_refinement(mesh.triangulation, metric, cut, conditions, r, mode != Retriangulation::ALWAYS));
    Mesh polygons;
    check_mesh(sm, mesh, cut, r, polygons, "closed mesh");
  }
}

// The disks that the fixed triangulation cannot do.
BOOST_AUTO_TEST_CASE(disks_that_need_flips, * needs_mesh("cylinder_locally_refined.off"))
{
  for(const char* name : testing::cases<const char*>(
        { "blob.off", "degtri_sliding.off", "corner_tris_with_hole.off", "mannequin-devil.off", "cylinder_locally_refined.off" }))
    for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
      BOOST_TEST_CONTEXT(name)
      {
        const Mesh sm = read_mesh(name);
        const CE::Imported_mesh<Mesh> mesh = CE::import_mesh(sm);
        BOOST_TEST_REQUIRE((mesh.status == Status::OK));
        std::vector<Index> missing;
        const Conditions conditions = CE::read_conditions(mesh, missing);
        const Triangulation& t = mesh.triangulation;
        const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
        BOOST_TEST_REQUIRE(bool(metric), CE::message(metric.status));
        const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
        const CE::internal::Stopwatch stopwatch;
        const Refinement r = CE::compute_common_refinement(t, metric, cut);
        const double seconds = stopwatch.seconds();
        const Figures figures = check_refinement(t, metric, cut, conditions, r,
                                                 mode != Retriangulation::ALWAYS && metric.statistics.number_of_resolving_flips == 0);
        tell(name, figures);
        BOOST_TEST_MESSAGE("  " << metric.flips.size() << " flips of " << t.number_of_edges() << " edges, solve "
                           << metric.statistics.seconds.solve << " s, refinement " << seconds << " s, doubled " << metric.is_doubled);
        if(mode != Retriangulation::WHEN_NEEDED)
          continue;
        BOOST_TEST(figures.crossings > 0u);
        Mesh polygons, triangles;
        check_mesh(sm, mesh, cut, r, polygons, name);
        check_mesh(sm, mesh, cut, CE::triangulate_refinement(r), triangles, name);
        BOOST_TEST(CGAL::is_triangle_mesh(triangles));
        const double area = CGAL::Polygon_mesh_processing::area(sm);
        // as if all parts were as large
        BOOST_TEST(std::abs(CGAL::Polygon_mesh_processing::area(triangles) - area) <= 10 * few_roundings * double(num_faces(triangles)) * area);
        if(t.number_of_faces() < 20000)
        {
          CGAL::Polyhedron_3<Kernel> polyhedron;
          check_mesh(sm, mesh, cut, r, polyhedron, name);
        }
      }
}
