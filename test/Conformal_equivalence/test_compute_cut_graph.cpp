// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The cut graph. What is cut open is judged from its numbers of vertices, edges, faces and borders
// alone; lengths of loops by a search in all homology classes.

#define BOOST_TEST_MODULE test_compute_cut_graph
#include "include/boost_test.h"
#include "include/test_meshes.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>

#include <CGAL/Curves_on_surface_topology.h>
#include <CGAL/Path_on_surface.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <boost/graph/graph_concepts.hpp>
#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

using testing::Index;
using testing::Random;

// Relative, of a sum of up to a hundred lengths.
constexpr double rounded_sum = 100 * testing::few_roundings;

typedef CE::Intrinsic_triangulation<double> Triangulation;
typedef CGAL::Simple_cartesian<double>      Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

const Index null_index = Triangulation::null_index;

// ---- Judging a cut

// A property map of edges, from a function of the index.
template <typename Function>
auto edge_map(Function f) { return boost::make_function_property_map<Index>(f); }

template <typename NT>
bool is_cone_on_border(const CE::Intrinsic_triangulation<NT>& t, const CE::Cut_graph& cut, Index v)
{
  bool result = t.is_isolated_vertex(v) || t.is_border_vertex(v);
  if(!result)
    t.for_each_outgoing(v, [&](Index h) { result = result || cut[t.edge(h)]; });
  return result;
}

// Every piece of the surface that is cut open has Euler characteristic 1 and one border, and no cone inside.
template <typename NT>
bool makes_disks(const CE::Intrinsic_triangulation<NT>& t, const CE::Cut_graph& cut, const std::vector<Index>& cones)
{
  const CE::Surface_components pieces = CE::connected_components(CE::internal::cut_open(t, cut));
  for(const auto& piece : pieces.components)
    if(piece.euler_characteristic() != 1 || piece.number_of_borders != 1)
      return false;
  return std::all_of(cones.begin(), cones.end(), [&](Index v) { return is_cone_on_border(t, cut, v); });
}

// The same, and no piece falls apart.
template <typename NT>
bool makes_components_disks(const CE::Intrinsic_triangulation<NT>& t, const CE::Cut_graph& cut, const std::vector<Index>& cones)
{
  return makes_disks(t, cut, cones)
      && CE::connected_components(CE::internal::cut_open(t, cut)).components.size() == CE::connected_components(t).components.size();
}

// By vertex: the number of ends of cut edges.
template <typename NT>
std::vector<int> cut_degrees(const CE::Intrinsic_triangulation<NT>& t, const CE::Cut_graph& cut)
{
  std::vector<int> degree(t.number_of_vertices(), 0);
  for(Index e = 0; e < t.number_of_edges(); ++e)
    if(cut[e])
    {
      ++degree[t.origin(t.edge_halfedge(e))];
      ++degree[t.target(t.edge_halfedge(e))];
    }
  return degree;
}

template <typename NT>
std::size_t number_of_dangling_ends(const CE::Intrinsic_triangulation<NT>& t, const CE::Cut_graph& cut, const std::vector<Index>& cones)
{
  const std::vector<int> degree = cut_degrees(t, cut);
  std::size_t result = 0;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(degree[v] == 1 && !t.is_border_vertex(v) && std::find(cones.begin(), cones.end(), v) == cones.end())
      ++result;
  return result;
}

// The paths of the cut between vertices where it branches or ends, cones and borders.
template <typename NT>
std::vector<std::vector<Index> > seam_paths(const CE::Intrinsic_triangulation<NT>& t, const CE::Cut_graph& cut, const std::vector<Index>& cones)
{
  std::vector<int> degree = cut_degrees(t, cut);
  for(Index v : cones)
    degree[v] = -1;
  CE::internal::Partition sets(t.number_of_edges());
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    if(degree[v] != 2 || t.is_border_vertex(v))
      continue;
    Index first = null_index;
    t.for_each_outgoing(v, [&](Index h)
    {
      if(cut[t.edge(h)] && first == null_index)
        first = t.edge(h);
      else if(cut[t.edge(h)])
        sets.unite(first, t.edge(h));
    });
  }
  std::vector<std::vector<Index> > by_edge(t.number_of_edges()), result;
  for(Index e = 0; e < t.number_of_edges(); ++e)
    if(cut[e])
      by_edge[sets.find(e)].push_back(e);
  for(std::vector<Index>& path : by_edge)
    if(!path.empty())
      result.push_back(std::move(path));
  return result;
}

// No path can be left out; of many paths, `limit` are tried.
template <typename NT>
std::size_t number_of_needless_paths(const CE::Intrinsic_triangulation<NT>& t, CE::Cut_graph cut, const std::vector<Index>& cones,
                                     std::size_t limit = 1000000)
{
  const auto paths = seam_paths(t, cut, cones);
  const std::size_t step = 1 + paths.size() / limit;
  std::size_t result = 0;
  for(std::size_t i = 0; i < paths.size(); i += step)
  {
    for(Index e : paths[i])
      cut.is_cut[e] = 0;
    if(makes_components_disks(t, cut, cones))
      ++result;
    for(Index e : paths[i])
      cut.is_cut[e] = 1;
  }
  return result;
}

template <typename NT>
void check_cut(const CE::Intrinsic_triangulation<NT>& t, const CE::Cut_graph& cut, const std::vector<Index>& cones,
               std::size_t limit = 1000000)
{
  BOOST_REQUIRE(cut.status == CE::Status::OK);
  BOOST_REQUIRE_EQUAL(cut.is_cut.size(), t.number_of_edges());
  for(Index e = 0; e < t.number_of_edges(); ++e)
    BOOST_REQUIRE(!(cut[e] && t.is_border_edge(e)));
  BOOST_TEST(makes_components_disks(t, cut, cones));
  BOOST_TEST(number_of_dangling_ends(t, cut, cones) == 0u);
  BOOST_TEST(number_of_needless_paths(t, cut, cones, limit) == 0u);
}

template <typename NT>
void check_failure(const CE::Cut_graph& cut, CE::Status status, const CE::Intrinsic_triangulation<NT>&)
{
  BOOST_TEST((cut.status == status));
  BOOST_TEST(!cut);
  BOOST_TEST(cut.is_cut.empty());
  BOOST_TEST(cut.loops.empty());
}

// ---- Surfaces

// A surface of genus g with two vertices: a polygon of 4g sides around its centre.
Triangulation polygon_surface(Index genus)
{
  const Index n = 4 * genus;
  std::vector<Index> origin, twin(3 * n);
  for(Index i = 0; i < n; ++i)
  {
    origin.insert(origin.end(), {0, 0, 1}); // the side, to the centre, from the centre
    twin[3 * i] = 3 * (i % 4 < 2 ? i + 2 : i - 2); // a b a^-1 b^-1
    twin[3 * i + 1] = 3 * ((i + 1) % n) + 2;
    twin[3 * i + 2] = 3 * ((i + n - 1) % n) + 1;
  }
  return Triangulation(2, origin, twin);
}

// Each triangle cut into four: three at its corners, and the middle one.
Triangulation subdivide(const Triangulation& t)
{
  const auto middle = [&](Index h) { return t.number_of_vertices() + t.edge(h); };
  const auto first_half = [](Index h) { return 12 * (h / 3) + 3 * (h % 3); };                   // from origin(h)
  const auto second_half = [&](Index h) { return first_half(Triangulation::next(h)) + 2; };     // to target(h)
  std::vector<Index> origin(4 * t.number_of_halfedges()), twin(origin.size(), null_index);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    const Index corner = first_half(h), inner = 12 * (h / 3) + 9 + h % 3; // from the middle of h to that of next(h)
    origin[corner] = t.origin(h);
    origin[corner + 1] = origin[inner] = middle(h);
    origin[corner + 2] = middle(t.previous(h));
    const Index inner_side = 12 * (h / 3) + 9 + t.previous(h) % 3; // from the middle of previous(h) to that of h
    twin[corner + 1] = inner_side;
    twin[inner_side] = corner + 1;
    if(!t.is_border(h))
    {
      twin[corner] = second_half(t.twin(h));
      twin[second_half(t.twin(h))] = corner;
    }
  }
  return Triangulation(t.number_of_vertices() + t.number_of_edges(), origin, twin);
}

// Without some faces that share no vertex.
Triangulation with_holes(const Triangulation& t, std::size_t number_of_holes, Random& random)
{
  std::vector<char> is_removed(t.number_of_faces(), 0), is_touched(t.number_of_vertices(), 0);
  for(int trial = 0; trial < 1000 && number_of_holes > 0; ++trial)
  {
    const Index f = random.below(t.number_of_faces());
    const std::set<Index> corners = {t.origin(3 * f), t.origin(3 * f + 1), t.origin(3 * f + 2)};
    if(corners.size() < 3 || std::any_of(corners.begin(), corners.end(), [&](Index v) { return is_touched[v] != 0; }))
      continue;
    for(Index v : corners)
      is_touched[v] = 1;
    is_removed[f] = 1;
    --number_of_holes;
  }
  std::vector<Index> new_face(t.number_of_faces(), null_index), origin, twin;
  Index n = 0;
  for(Index f = 0; f < t.number_of_faces(); ++f)
    if(!is_removed[f])
      new_face[f] = n++;
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    if(is_removed[h / 3])
      continue;
    origin.push_back(t.origin(h));
    const Index g = t.twin(h);
    twin.push_back(g == null_index || is_removed[g / 3] ? null_index : 3 * new_face[g / 3] + g % 3);
  }
  return Triangulation(t.number_of_vertices(), origin, twin);
}

void set_random_lengths(Triangulation& t, Random& random)
{
  for(Index e = 0; e < t.number_of_edges(); ++e)
    t.set_length(e, random(.1, 1));
}

Triangulation random_surface(Index genus, int levels, std::size_t holes, Random& random)
{
  Triangulation t = genus == 0 ? testing::triangulation(testing::icosahedron()) : polygon_surface(genus);
  for(; levels > 0; --levels)
    t = subdivide(t);
  t = with_holes(t, holes, random);
  set_random_lengths(t, random);
  return t;
}

std::vector<Index> random_cones(const Triangulation& t, std::size_t n, Random& random)
{
  std::vector<Index> result;
  for(int trial = 0; trial < 10000 && result.size() < n; ++trial)
  {
    const Index v = random.below(t.number_of_vertices());
    if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v) && std::find(result.begin(), result.end(), v) == result.end())
      result.push_back(v);
  }
  return result;
}

// ---- The shortest loops in all homology classes

// By edge: in which of the 2g dual circles of a basis of the homology modulo 2 it lies, as bits.
std::vector<unsigned> cocycles(const Triangulation& t)
{
  std::vector<Index> to_parent(t.number_of_faces(), null_index); // the halfedge out of the face, in the tree of the dual graph
  std::vector<char> seen(t.number_of_faces(), 0), is_in_dual_tree(t.number_of_edges(), 0);
  std::queue<Index> queue;
  queue.push(0);
  seen[0] = 1;
  for(; !queue.empty(); queue.pop())
    for(Index h = 3 * queue.front(); h < 3 * queue.front() + 3; ++h)
      if(!t.is_border(h) && !seen[t.twin(h) / 3])
      {
        seen[t.twin(h) / 3] = 1;
        to_parent[t.twin(h) / 3] = t.twin(h);
        is_in_dual_tree[t.edge(h)] = 1;
        queue.push(t.twin(h) / 3);
      }

  CE::internal::Partition vertices(t.number_of_vertices());
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    if(t.is_border(h))
      vertices.unite(t.origin(h), t.target(h));
  std::vector<unsigned> result(t.number_of_edges(), 0);
  unsigned bit = 1;
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index h = t.edge_halfedge(e);
    if(t.is_border_edge(e) || is_in_dual_tree[e] || vertices.unite(t.origin(h), t.target(h)))
      continue;
    result[e] ^= bit;
    for(Index side : {h, t.twin(h)})
      for(Index g = to_parent[side / 3]; g != null_index; g = to_parent[t.twin(g) / 3])
        result[t.edge(g)] ^= bit;
    bit *= 2;
  }
  return result;
}

// By class: the length of the shortest closed walk through the base.
std::vector<double> shortest_walks(const Triangulation& t, const std::vector<unsigned>& cocycle, unsigned number_of_classes, Index base)
{
  typedef std::pair<double, std::pair<Index, unsigned> > Entry;
  std::vector<double> distance(std::size_t(t.number_of_vertices()) * number_of_classes, std::numeric_limits<double>::infinity());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > queue;
  const auto reach = [&](double d, Index v, unsigned c)
  {
    double& old = distance[std::size_t(v) * number_of_classes + c];
    if(d >= old)
      return;
    old = d;
    queue.push({d, {v, c}});
  };
  const CE::internal::Triangulation_graph<double> graph(t);
  reach(0, base, 0);
  while(!queue.empty())
  {
    const Entry entry = queue.top();
    queue.pop();
    if(entry.first > distance[std::size_t(entry.second.first) * number_of_classes + entry.second.second])
      continue;
    const auto range = out_edges(entry.second.first, graph);
    for(auto it = range.first; it != range.second; ++it)
      reach(entry.first + (t.is_border_edge((*it).index) ? 0 : t.length((*it).index)), (*it).target,
            entry.second.second ^ cocycle[(*it).index]);
  }
  return std::vector<double>(distance.begin() + std::ptrdiff_t(base) * number_of_classes,
                             distance.begin() + std::ptrdiff_t(base + 1) * number_of_classes);
}

// The sum of the shortest walks whose classes are a basis: nothing that opens all handles is shorter.
double shortest_basis(const std::vector<double>& walks)
{
  std::vector<unsigned> order(walks.size() - 1), spanned = {0};
  std::iota(order.begin(), order.end(), 1u);
  std::sort(order.begin(), order.end(), [&](unsigned a, unsigned b) { return walks[a] < walks[b]; });
  double sum = 0;
  for(unsigned c : order)
  {
    if(std::find(spanned.begin(), spanned.end(), c) != spanned.end())
      continue;
    sum += walks[c];
    const std::vector<unsigned> old = spanned;
    for(unsigned s : old)
      spanned.push_back(s ^ c);
  }
  return sum;
}

double total_length(const Triangulation& t, const std::vector<std::vector<Index> >& loops)
{
  double sum = 0;
  for(const std::vector<Index>& loop : loops)
    for(Index h : loop)
      sum += t.halfedge_length(h);
  return sum;
}

// ---- The graph

BOOST_AUTO_TEST_CASE(graph_view)
{
  typedef CE::internal::Triangulation_graph<double> Graph;
  BOOST_CONCEPT_ASSERT((boost::IncidenceGraphConcept<Graph>));
  BOOST_CONCEPT_ASSERT((boost::VertexListGraphConcept<Graph>));
  BOOST_CONCEPT_ASSERT((boost::EdgeListGraphConcept<Graph>));

  Random random(1);
  const std::vector<Triangulation> surfaces = {
    testing::one_vertex_torus(3., 4., 5.), polygon_surface(2), testing::triangulation(testing::flat_grid(3)),
    testing::triangulation(testing::together({testing::icosahedron(), testing::annulus(2, 5)}, true)),
    random_surface(1, 2, 3, random)};
  for(const Triangulation& t : surfaces)
  {
    const Graph g(t);
    std::vector<int> ends(num_edges(g), 0);
    for(auto v = vertices(g); v.first != v.second; ++v.first)
    {
      std::size_t degree = 0;
      for(auto e = out_edges(*v.first, g); e.first != e.second; ++e.first, ++degree)
      {
        const Index h = t.edge_halfedge((*e.first).index);
        BOOST_TEST(source(*e.first, g) == *v.first);
        BOOST_TEST((std::set<Index>{source(*e.first, g), target(*e.first, g)} == std::set<Index>{t.origin(h), t.target(h)}));
        ++ends[(*e.first).index];
      }
      BOOST_TEST(degree == out_degree(*v.first, g));
    }
    BOOST_TEST(std::count(ends.begin(), ends.end(), 2) == std::ptrdiff_t(num_edges(g)));
    Index n = 0;
    for(auto e = edges(g); e.first != e.second; ++e.first)
      BOOST_TEST((*e.first).index == n++);
    BOOST_TEST(n == num_edges(g));
  }
}

// ---- Topology

BOOST_AUTO_TEST_CASE(disks_and_spheres)
{
  const Triangulation disk = testing::triangulation(testing::flat_grid(6));
  CE::Cut_graph cut = CE::compute_cut_graph(disk, {});
  check_cut(disk, cut, {});
  BOOST_TEST(std::count(cut.is_cut.begin(), cut.is_cut.end(), 1) == 0);
  check_cut(disk, CE::compute_cut_graph(disk, {24, 16, 24, 30, 0}), {24, 16, 30}); // the centre twice; 0 is on the border

  const Triangulation sphere = testing::triangulation(testing::icosphere(2));
  for(const std::vector<Index>& cones : {std::vector<Index>{}, {5}, {5, 5}})
  {
    cut = CE::compute_cut_graph(sphere, cones);
    check_failure(cut, CE::Status::WRONG_TOPOLOGY, sphere);
    BOOST_TEST(cut.faces == std::vector<Index>(1, 0));
  }
  Random random(2);
  for(std::size_t n : {2u, 3u, 8u, 50u})
  {
    const std::vector<Index> cones = random_cones(sphere, n, random);
    check_cut(sphere, CE::compute_cut_graph(sphere, cones), cones);
  }

  const Triangulation one = testing::triangulation(testing::one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}));
  check_cut(one, CE::compute_cut_graph(one, {0, 1, 2}), {});
  check_failure(CE::compute_cut_graph(Triangulation(), {}), CE::Status::EMPTY_MESH, one);
  check_failure(CE::compute_cut_graph(Triangulation(2, {}, {}), {1}), CE::Status::EMPTY_MESH, one);

  // between two cones the shortest path, in each component its own
  const Triangulation two = testing::triangulation(testing::together({testing::icosphere(2), testing::torus(7, 9), testing::annulus(3, 8)}, true));
  const Index n = sphere.number_of_vertices();
  const std::vector<Index> cones = {0, 1 + 3, 1 + 40, n + 2 + 5, n + 2 + 63 + 1 + 9};
  check_cut(two, CE::compute_cut_graph(two, cones), cones);
  check_failure(CE::compute_cut_graph(two, {4}), CE::Status::WRONG_TOPOLOGY, two);
}

BOOST_AUTO_TEST_CASE(random_surfaces)
{
  Random random(3);
  for(Index genus = 0; genus <= 3; ++genus)
    for(std::size_t holes = 0; holes <= 3; ++holes)
      for(std::size_t n : {0u, 1u, 4u})
      {
        const Triangulation t = random_surface(genus, 2, holes, random);
        const std::vector<Index> cones = random_cones(t, n, random);
        const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
        const auto component = CE::connected_components(t).components.at(0);
        BOOST_REQUIRE_EQUAL(component.genus(), genus);
        if(genus == 0 && component.number_of_borders == 0 && n < 2)
          check_failure(cut, CE::Status::WRONG_TOPOLOGY, t);
        else
        {
          check_cut(t, cut, cones);
          BOOST_TEST(cut.loops.size() == 2 * genus);
        }
      }
}

BOOST_AUTO_TEST_CASE(delta_complexes)
{
  const Triangulation torus = testing::one_vertex_torus(3., 5., 4.);
  for(const std::vector<Index>& cones : {std::vector<Index>{}, {0}})
  {
    const CE::Cut_graph cut = CE::compute_cut_graph(torus, cones);
    check_cut(torus, cut, cones);
    BOOST_TEST((cut.is_cut == std::vector<char>{1, 0, 1})); // all but the longest
    BOOST_TEST(cut.loops.size() == 2u);
  }
  Random random(4);
  for(Index genus = 1; genus <= 5; ++genus)
  {
    Triangulation t = polygon_surface(genus);
    set_random_lengths(t, random);
    check_cut(t, CE::compute_cut_graph(t, {}), {});
    check_cut(t, CE::compute_cut_graph(t, {1}), {1});
    check_cut(t, CE::compute_cut_graph(t, {0, 1}), {0, 1});
  }
}

// ---- Lengths

BOOST_AUTO_TEST_CASE(loops_are_the_shortest_for_their_base)
{
  Random random(5);
  for(Index genus = 1; genus <= 3; ++genus)
    for(int levels = 0; levels <= (genus == 3 ? 1 : 2); ++levels)
      for(std::size_t holes = 0; holes <= (levels == 2 ? 3u : 0u); ++holes)
        for(int trial = 0; trial < 5; ++trial)
        {
          const Triangulation t = random_surface(genus, levels, holes, random);
          const Index v = random.below(2);
          const CE::Cut_graph cut = CE::compute_cut_graph(t, {v});
          check_cut(t, cut, {v});
          BOOST_REQUIRE_EQUAL(cut.loops.size(), 2 * genus);

          Index base = v;
          for(Index i = t.number_of_vertices(); i-- > 0; )
            if(t.is_border_vertex(i))
              base = i;
          const std::vector<double> walks = shortest_walks(t, cocycles(t), 1u << 2 * genus, base);
          BOOST_TEST(total_length(t, cut.loops) == shortest_basis(walks), boost::test_tools::tolerance(rounded_sum));
        }
}

BOOST_AUTO_TEST_CASE(base_moves_to_where_the_loops_part)
{
  // vertex 0 is far from all others but one
  Random random(11);
  Triangulation t = testing::triangulation(testing::torus(6, 7));
  set_random_lengths(t, random);
  const Index stem = t.vertex_halfedge(0);
  t.for_each_outgoing(0, [&](Index h) { t.set_length(t.edge(h), h == stem ? .1 : 100); });

  const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
  check_cut(t, cut, {});
  BOOST_TEST(!cut[t.edge(stem)]);
  BOOST_REQUIRE_EQUAL(cut.loops.size(), 2u);
  const Index base = t.origin(cut.loops[0].front());
  BOOST_TEST(base != 0u);
  BOOST_TEST(base == t.origin(cut.loops[1].front()));
  BOOST_TEST(total_length(t, cut.loops) == shortest_basis(shortest_walks(t, cocycles(t), 4, base)), boost::test_tools::tolerance(rounded_sum));

  // a cone stays where it is
  const CE::Cut_graph with_cone = CE::compute_cut_graph(t, {0});
  check_cut(t, with_cone, {0});
  BOOST_TEST(with_cone[t.edge(stem)]);
  BOOST_TEST(t.origin(with_cone.loops[0].front()) == 0u);

  // a first vertex with constrained edges only is no obstacle, a cone there is
  const auto is_at_0 = edge_map([&](Index e) { return t.origin(t.edge_halfedge(e)) == 0 || t.target(t.edge_halfedge(e)) == 0; });
  const auto none = edge_map([](Index) { return false; });
  check_cut(t, CE::compute_cut_graph(t, {}, params::edge_is_seam_map(none).edge_is_constrained_map(is_at_0)), {});
  const CE::Cut_graph failed = CE::compute_cut_graph(t, {0}, params::edge_is_seam_map(none).edge_is_constrained_map(is_at_0));
  check_failure(failed, CE::Status::WRONG_TOPOLOGY, t);
  BOOST_TEST(!failed.edges.empty());
}

// Dijkstra's distances between all terminals, and the minimum spanning tree on them.
double minimum_spanning_tree(const Triangulation& t, const std::vector<std::vector<Index> >& terminals)
{
  const std::vector<unsigned> nothing(t.number_of_edges(), 0);
  std::vector<std::pair<double, std::pair<Index, Index> > > pairs;
  const CE::internal::Triangulation_graph<double> graph(t);
  for(Index i = 0; i < terminals.size(); ++i)
  {
    std::vector<double> distance(t.number_of_vertices(), 1e300);
    for(Index v : terminals[i])
      distance[v] = 0;
    for(bool changed = true; changed; ) // Bellman and Ford; what passes through a terminal changes no tree
    {
      changed = false;
      for(auto e = edges(graph); e.first != e.second; ++e.first)
      {
        const double l = t.is_border_edge((*e.first).index) ? 0 : t.length((*e.first).index);
        double &a = distance[(*e.first).source], &b = distance[(*e.first).target];
        if(a + l < b || b + l < a)
        {
          changed = true;
          a = (std::min)(a, b + l);
          b = (std::min)(b, a + l);
        }
      }
    }
    for(Index j = 0; j < i; ++j)
      pairs.push_back({distance[terminals[j].front()], {i, j}});
  }
  std::sort(pairs.begin(), pairs.end());
  CE::internal::Partition sets(terminals.size());
  double sum = 0;
  for(const auto& p : pairs)
    if(sets.unite(p.second.first, p.second.second))
      sum += p.first;
  return sum;
}

BOOST_AUTO_TEST_CASE(cone_tree_is_at_most_the_minimum_spanning_tree)
{
  Random random(6);
  for(std::size_t holes = 0; holes <= 3; ++holes)
    for(std::size_t n : {2u, 3u, 7u})
    {
      const Triangulation t = random_surface(0, 2, holes, random);
      const std::vector<Index> cones = random_cones(t, n, random);
      const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
      check_cut(t, cut, cones);

      std::vector<std::vector<Index> > terminals;
      for(Index v : cones)
        terminals.push_back({v});
      std::vector<char> seen(t.number_of_halfedges(), 0);
      for(Index h = 0; h < t.number_of_halfedges(); ++h)
        if(t.is_border(h) && !seen[h])
        {
          terminals.emplace_back();
          for(Index b = h; !seen[b]; b = t.next_on_border(b))
          {
            seen[b] = 1;
            terminals.back().push_back(t.origin(b));
          }
        }
      double length = 0;
      for(Index e = 0; e < t.number_of_edges(); ++e)
        length += cut[e] ? t.length(e) : 0;
      const double bound = minimum_spanning_tree(t, terminals);
      BOOST_TEST(length <= bound * (1 + rounded_sum));
      BOOST_TEST(length >= bound / 2 * (1 - rounded_sum)); // the shortest tree there is
      if(terminals.size() == 2)
        BOOST_TEST(length == bound, boost::test_tools::tolerance(rounded_sum));
    }
}

BOOST_AUTO_TEST_CASE(scale_and_number_type_do_not_matter)
{
  Random random(7);
  const Triangulation t = random_surface(2, 2, 2, random);
  const std::vector<Index> cones = random_cones(t, 3, random);
  const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
  check_cut(t, cut, cones);
  for(int exponent : {-500, 500, 1000})
  {
    std::vector<double> lengths = t.lengths();
    for(double& l : lengths)
      l = std::ldexp(l, exponent);
    const CE::Cut_graph scaled = CE::compute_cut_graph(t.with_lengths(lengths), cones);
    BOOST_TEST((scaled.is_cut == cut.is_cut));
  }
  BOOST_TEST((CE::compute_cut_graph(testing::widened<long double>(t), cones).is_cut == cut.is_cut));

  // with ties everywhere, and with edges that cost nothing, it is still a cut
  for(double length : {0., 1.})
  {
    const Triangulation regular = t.with_lengths(std::vector<double>(t.number_of_edges(), length));
    check_cut(regular, CE::compute_cut_graph(regular, cones), cones);
  }
  for(int trial = 0; trial < 20; ++trial)
  {
    Triangulation coarse = random_surface(1 + trial % 3, 2, trial % 4, random);
    for(Index e = 0; e < coarse.number_of_edges(); ++e)
      coarse.set_length(e, random.below(3));
    const std::vector<Index> some = random_cones(coarse, trial % 5, random);
    check_cut(coarse, CE::compute_cut_graph(coarse, some), some);
  }
}

// ---- Named parameters

BOOST_AUTO_TEST_CASE(weights_steer_the_seam)
{
  const Index n = 8;
  const Triangulation t = testing::triangulation(testing::annulus(n, 12));
  // cheap: from the inner border straight, then half around, then straight; vertex (i, j) is 12 i + j
  std::set<std::pair<Index, Index> > cheap;
  for(Index i = 0; i < n; ++i)
    cheap.insert(std::minmax(12 * i + (i < 4 ? 0 : 6), 12 * (i + 1) + (i < 4 ? 0 : 6)));
  for(Index j = 0; j < 6; ++j)
    cheap.insert(std::minmax(12 * 4 + j, 12 * 4 + j + 1));
  const auto is_cheap = [&](Index e)
  { return cheap.count(std::minmax(t.origin(t.edge_halfedge(e)), t.target(t.edge_halfedge(e)))) != 0; };
  const CE::Cut_graph cut = CE::compute_cut_graph(t, {}, params::seam_weight_map(edge_map([&](Index e) { return is_cheap(e) ? 1 : 100; })));
  check_cut(t, cut, {});
  for(Index e = 0; e < t.number_of_edges(); ++e)
    BOOST_TEST(cut[e] == is_cheap(e));
  BOOST_TEST(cheap.size() == 14u);

  const double bad[] = {-1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  Index inner = 0;
  while(t.is_border_edge(inner))
    ++inner;
  Index border = 0;
  while(!t.is_border_edge(border))
    ++border;
  for(double w : bad)
  {
    const CE::Cut_graph failed = CE::compute_cut_graph(t, {}, params::seam_weight_map(edge_map([=](Index e) { return e == inner ? w : 1.; })));
    check_failure(failed, CE::Status::INVALID_NUMBER, t);
    BOOST_TEST(failed.edges == std::vector<Index>(1, inner));
    check_cut(t, CE::compute_cut_graph(t, {}, params::seam_weight_map(edge_map([=](Index e) { return e == border ? w : 1.; }))), {});
  }
}

BOOST_AUTO_TEST_CASE(prescribed_seams)
{
  // a circle around the tube of a torus leaves an annulus
  const Triangulation torus = testing::triangulation(testing::torus(9, 7));
  const auto is_meridian = [&](Index e)
  { const Index h = torus.edge_halfedge(e); return torus.origin(h) / 7 == 3 && torus.target(h) / 7 == 3; };
  CE::Cut_graph cut = CE::compute_cut_graph(torus, {5}, params::edge_is_seam_map(edge_map(is_meridian)));
  check_cut(torus, cut, {5});
  for(Index e = 0; e < torus.number_of_edges(); ++e)
    BOOST_TEST((!is_meridian(e) || cut[e]));

  // one edge makes a disk of a sphere, and its ends may be cones
  const Triangulation sphere = testing::triangulation(testing::icosphere(1));
  cut = CE::compute_cut_graph(sphere, {}, params::edge_is_seam_map(edge_map([](Index e) { return e == 10; })));
  BOOST_TEST((cut.status == CE::Status::OK));
  BOOST_TEST(makes_components_disks(sphere, cut, {}));
  BOOST_TEST(std::count(cut.is_cut.begin(), cut.is_cut.end(), 1) == 1);
  const Index h = sphere.edge_halfedge(10);
  const std::vector<Index> cones = {sphere.origin(h), sphere.target(h), 20, 30};
  cut = CE::compute_cut_graph(sphere, cones, params::edge_is_seam_map(edge_map([](Index e) { return e == 10; })));
  check_cut(sphere, cut, cones);
  BOOST_TEST(cut[10]);

  // a circle that separates leaves two pieces, each a disk with its cones on the border
  const auto is_around_vertex = [&](Index e)
  {
    const Index g = sphere.edge_halfedge(e);
    return sphere.apex(g) == 0 || sphere.apex(sphere.twin(g)) == 0;
  };
  cut = CE::compute_cut_graph(sphere, {0, 20, 30}, params::edge_is_seam_map(edge_map(is_around_vertex)));
  BOOST_TEST((cut.status == CE::Status::OK));
  BOOST_TEST(makes_disks(sphere, cut, {0, 20, 30}));
  BOOST_TEST(CE::connected_components(CE::internal::cut_open(sphere, cut)).components.size() == 2u);

  // marks on the border are ignored
  const Triangulation disk = testing::triangulation(testing::flat_grid(4));
  cut = CE::compute_cut_graph(disk, {12}, params::edge_is_seam_map(edge_map([&](Index e) { return disk.is_border_edge(e); })));
  check_cut(disk, cut, {12});
}

// Whether free edges suffice: one connected part of them (borders are connected for free) meets all cones and
// borders, and cutting along all of it leaves only disks.
bool free_edges_suffice(const Triangulation& t, const std::vector<Index>& cones, const std::vector<char>& is_constrained)
{
  CE::internal::Partition parts(t.number_of_vertices());
  std::vector<Index> required = cones;
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index h = t.edge_halfedge(e);
    if(t.is_border_edge(e))
      required.push_back(t.origin(h));
    if(t.is_border_edge(e) || !is_constrained[e])
      parts.unite(t.origin(h), t.target(h));
  }
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    if(parts.find(v) != v || std::any_of(required.begin(), required.end(), [&](Index r) { return parts.find(r) != v; }))
      continue;
    CE::Cut_graph all;
    all.is_cut.assign(t.number_of_edges(), 0);
    for(Index e = 0; e < t.number_of_edges(); ++e)
      all.is_cut[e] = !t.is_border_edge(e) && !is_constrained[e] && parts.find(t.origin(t.edge_halfedge(e))) == v;
    if(makes_disks(t, all, cones))
      return true;
  }
  return false;
}

BOOST_AUTO_TEST_CASE(constrained_edges)
{
  Random random(8);
  int possible = 0, impossible = 0;
  for(int trial = 0; trial < 400; ++trial)
  {
    const Triangulation t = random_surface(trial % 3, 1 + trial % 2, trial / 3 % 3, random);
    const std::vector<Index> cones = random_cones(t, trial % 4, random);
    const auto component = CE::connected_components(t).components.at(0);
    if(component.genus() == 0 && component.number_of_borders == 0 && cones.size() < 2)
      continue;
    const double share = random(.3, .8);
    std::vector<char> is_constrained(t.number_of_edges());
    for(char& c : is_constrained)
      c = random(0, 1) < share;
    const CE::Cut_graph cut = CE::compute_cut_graph(
      t, cones, params::seam_weight_map(edge_map([&](Index e) { return t.length(e); }))
                      .edge_is_constrained_map(edge_map([&](Index e) { return is_constrained[e] != 0; })));
    if(free_edges_suffice(t, cones, is_constrained))
    {
      ++possible;
      check_cut(t, cut, cones);
      for(Index e = 0; e < t.number_of_edges(); ++e)
        BOOST_TEST(!(cut[e] && is_constrained[e]));
    }
    else
    {
      ++impossible;
      check_failure(cut, CE::Status::WRONG_TOPOLOGY, t);
      BOOST_TEST(!cut.edges.empty());
      for(Index e : cut.edges)
        BOOST_TEST(is_constrained[e]);
    }
  }
  BOOST_TEST_MESSAGE(possible << " can be cut, " << impossible << " cannot");
  BOOST_TEST(possible > 50);
  BOOST_TEST(impossible > 50);

  const Triangulation t = testing::triangulation(testing::torus(5, 6));
  const auto fifth = edge_map([](Index e) { return e == 5; });
  const CE::Cut_graph contradictory = CE::compute_cut_graph(t, {}, params::edge_is_seam_map(fifth).edge_is_constrained_map(fifth));
  check_failure(contradictory, CE::Status::WRONG_TOPOLOGY, t);
  BOOST_TEST(contradictory.edges == std::vector<Index>(1, 5));
}

// ---- CGAL's meshes

bool read_triangles(const std::string& path, Mesh& mesh)
{
  return CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(path, mesh) && num_faces(mesh) > 0 && CGAL::is_triangle_mesh(mesh);
}

// The number of spheres with fewer than two cones.
std::size_t number_of_bare_spheres(const Triangulation& t, const std::vector<Index>& cones)
{
  const CE::Surface_components pieces = CE::connected_components(t);
  std::vector<int> count(pieces.components.size(), 0);
  for(Index v : cones)
    ++count[pieces.component_of_vertex[v]];
  std::size_t result = 0;
  for(std::size_t c = 0; c < pieces.components.size(); ++c)
    if(pieces.components[c].genus() == 0 && pieces.components[c].number_of_borders == 0 && count[c] < 2)
      ++result;
  return result;
}

BOOST_AUTO_TEST_CASE(meshes_of_CGAL, * testing::needs_mesh("cheese.off") * testing::slow())
{
  Random random(9);
  std::size_t meshes = 0, cuts = 0, refused = 0, largest_genus = 0, most_borders = 0;
  std::vector<std::filesystem::path> files;
  for(const auto& entry : std::filesystem::directory_iterator(testing::mesh_path("")))
    if(entry.path().extension() == ".off")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for(const std::filesystem::path& file : files)
  {
    Mesh mesh;
    if(!read_triangles(file.string(), mesh))
      continue;
    const CE::Imported_mesh<Mesh> imported = CE::import_mesh(mesh);
    if(imported.status != CE::Status::OK && imported.status != CE::Status::ZERO_LENGTH_EDGE)
      continue;
    const Triangulation& t = imported.triangulation;
    ++meshes;
    const auto pieces = CE::connected_components(t);
    const CE::Surface_topology topology = CE::surface_topology(t, pieces);
    largest_genus = (std::max)(largest_genus, topology.genus);
    most_borders = (std::max)(most_borders, topology.number_of_borders);
    for(std::size_t n : {0u, 1u, 8u})
    {
      BOOST_TEST_CONTEXT(file.filename().string() << " with " << n << " cones")
      {
        const std::vector<Index> cones = random_cones(t, n, random);
        const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
        const std::size_t bare_spheres = number_of_bare_spheres(t, cones);
        if(bare_spheres > 0)
        {
          ++refused;
          check_failure(cut, CE::Status::WRONG_TOPOLOGY, t);
          BOOST_TEST(cut.faces.size() == bare_spheres);
          continue;
        }
        ++cuts;
        check_cut(t, cut, cones, 1 + 1000000 / t.number_of_faces());
        BOOST_TEST(cut.loops.size() == 2 * topology.genus);
      }
    }
  }
  BOOST_TEST_MESSAGE(meshes << " meshes, " << cuts << " cut, " << refused << " refused; genus up to " << largest_genus
                            << ", up to " << most_borders << " borders");
  BOOST_TEST(meshes >= 90u);
  BOOST_TEST(largest_genus == 133u);
  BOOST_TEST(most_borders == 106u);
}

void check_loops_not_contractible(const std::string& name, std::size_t genus)
{
  Mesh mesh;
  BOOST_REQUIRE(read_triangles(testing::mesh_path(name), mesh));
  const CE::Imported_mesh<Mesh> imported = CE::import_mesh(mesh);
  const CE::Cut_graph cut = CE::compute_cut_graph(imported.triangulation, {});
  check_cut(imported.triangulation, cut, {}, 100);
  BOOST_REQUIRE_EQUAL(cut.loops.size(), 2 * genus);

  CGAL::Surface_mesh_topology::Curves_on_surface_topology<Mesh> curves(mesh);
  for(const std::vector<Index>& loop : cut.loops)
  {
    CGAL::Surface_mesh_topology::Path_on_surface<Mesh> path(mesh);
    for(Index h : loop)
      path.push_back(imported.halfedge(h));
    BOOST_REQUIRE(path.is_closed());
    BOOST_TEST(!curves.is_contractible(path));
  }
  CGAL::Surface_mesh_topology::Path_on_surface<Mesh> triangle(mesh);
  for(Index h = 0; h < 3; ++h)
    triangle.push_back(imported.halfedge(h));
  BOOST_TEST(curves.is_contractible(triangle));
}

BOOST_AUTO_TEST_CASE(loops_are_not_contractible, * testing::needs_mesh("elephant.off"))
{
  check_loops_not_contractible("elephant.off", 3);
  check_loops_not_contractible("knot1.off", 1);
}
