// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// From marked edges to a Seam_mesh: its numbers of elements, which corners of faces share a vertex of it (those that are joined
// across edges without a mark), and the marks that are left, whatever they were before.

#define BOOST_TEST_MODULE test_make_seam_mesh
#include "include/boost_test.h"
#include "include/test_meshes.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>
#include <CGAL/Conformal_equivalence/make_seam_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
using testing::Index;
using testing::Random;

namespace {

typedef CGAL::Simple_cartesian<double>      Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CGAL::Polyhedron_3<Kernel>          Polyhedron;

// The corners of faces, each named by the halfedge that ends there, in classes: two corners at a vertex are one vertex of the seam mesh if they
// are joined by faces that lie side by side across edges that are no seam.
template <typename TriangleMesh>
class Corner_classes
{
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor Halfedge;

  std::map<Halfedge, Halfedge> parent_;

public:
  template <typename IsSeam> // of an edge
  Corner_classes(const TriangleMesh& tm, IsSeam is_seam)
  {
    for(Halfedge h : halfedges(tm))
      if(!is_border(h, tm))
        parent_[h] = h;
    for(Halfedge h : halfedges(tm))
    {
      const Halfedge g = opposite(h, tm);
      if(!is_border(h, tm) && !is_border(g, tm) && !is_seam(edge(h, tm)))
        parent_[class_of(h)] = class_of(prev(g, tm));
    }
  }

  Halfedge class_of(Halfedge h)
  {
    while(parent_[h] != h)
      h = parent_[h] = parent_[parent_[h]];
    return h;
  }

  std::size_t size() const
  {
    return std::size_t(std::count_if(parent_.begin(), parent_.end(), [](const auto& entry) { return entry.first == entry.second; }));
  }
};

template <typename Range>
std::size_t length(const Range& range) { return std::size_t(std::distance(range.begin(), range.end())); }

// Corners with the same vertex of the seam mesh are one class, and the other way round.
template <typename SeamMesh, typename TriangleMesh>
void check_vertices(const SeamMesh& seam_mesh, Corner_classes<TriangleMesh>& corners)
{
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor Halfedge;
  std::map<typename boost::graph_traits<SeamMesh>::vertex_descriptor, Halfedge> class_of_vertex;
  std::size_t wrong = 0;
  for(auto hd : halfedges(seam_mesh))
    if(!is_border(hd, seam_mesh))
    {
      const Halfedge corner = corners.class_of(hd);
      wrong += class_of_vertex.emplace(target(hd, seam_mesh), corner).first->second == corner ? 0 : 1;
    }
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(class_of_vertex.size() == corners.size());
}

// Makes the seam mesh of marks as they are, twice: the second time, the marks are right already.
template <typename TriangleMesh, typename EdgeIsSeamMap, typename VertexIsOnSeamMap>
void check_seam_mesh(const TriangleMesh& tm, EdgeIsSeamMap is_seam, VertexIsOnSeamMap is_on_seam, bool is_valid = true)
{
  typedef typename boost::graph_traits<TriangleMesh>::edge_descriptor   Edge;
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor Vertex;
  std::set<Edge> seam;
  std::set<Vertex> ends;
  for(Edge e : edges(tm))
    if(get(is_seam, e) && !CGAL::is_border(e, tm))
    {
      seam.insert(e);
      ends.insert(source(e, tm));
      ends.insert(target(e, tm));
    }
  Corner_classes<TriangleMesh> corners(tm, [&](Edge e) { return seam.count(e) != 0; });

  for(int time = 0; time < 2; ++time)
  {
    const auto seam_mesh = CE::make_seam_mesh(tm, is_seam, is_on_seam);
    const std::size_t number_of_edges = length(edges(tm)) + seam.size(); // each seam edge has two sides
    BOOST_TEST(num_faces(seam_mesh) == num_faces(tm));
    BOOST_TEST(num_edges(seam_mesh) == number_of_edges);
    BOOST_TEST(num_halfedges(seam_mesh) == 2 * number_of_edges);
    BOOST_TEST(num_vertices(seam_mesh) == corners.size());
    BOOST_TEST(length(edges(seam_mesh)) == number_of_edges);
    BOOST_TEST(length(halfedges(seam_mesh)) == 2 * number_of_edges);
    BOOST_TEST(length(vertices(seam_mesh)) == corners.size());
    BOOST_TEST(CGAL::is_valid_polygon_mesh(seam_mesh) == is_valid);
    check_vertices(seam_mesh, corners);
    std::size_t wrong_edges = 0, wrong_vertices = 0;
    for(Edge e : edges(tm))
      wrong_edges += get(is_seam, e) == (seam.count(e) != 0) ? 0 : 1;
    for(Vertex v : vertices(tm))
      wrong_vertices += get(is_on_seam, v) == (ends.count(v) != 0) ? 0 : 1;
    BOOST_TEST(wrong_edges == 0u);
    BOOST_TEST(wrong_vertices == 0u);
  }
}

struct Marked_mesh
{
  Mesh sm;
  Mesh::Property_map<Mesh::Edge_index, bool> is_seam;
  Mesh::Property_map<Mesh::Vertex_index, bool> is_on_seam;

  explicit Marked_mesh(const Mesh& mesh) : sm(mesh)
  {
    is_seam = sm.add_property_map<Mesh::Edge_index, bool>("e:is_seam", false).first;
    is_on_seam = sm.add_property_map<Mesh::Vertex_index, bool>("v:is_on_seam", true).first; // wrong nearly everywhere
  }
  explicit Marked_mesh(const testing::Soup& soup) : Marked_mesh(testing::surface_mesh<Mesh>(soup)) {}

  void check(bool is_valid = true) { check_seam_mesh(sm, is_seam, is_on_seam, is_valid); }
};

// Cut along what compute_cut_graph() finds, with the border marked, too.
void check_cut_mesh(const std::string& name, std::size_t number_of_cones)
{
  Mesh mesh;
  BOOST_REQUIRE(CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(testing::mesh_path(name), mesh));
  Marked_mesh m(mesh);
  const CE::Imported_mesh<Mesh> imported = CE::import_mesh(m.sm);
  Random random(10);
  std::set<Index> cones;
  while(cones.size() < number_of_cones)
  {
    const Index v = random.below(imported.triangulation.number_of_vertices());
    if(!imported.triangulation.is_border_vertex(v))
      cones.insert(v);
  }
  const CE::Cut_graph cut = CE::compute_cut_graph(imported.triangulation, std::vector<Index>(cones.begin(), cones.end()));
  BOOST_REQUIRE(bool(cut));
  for(Mesh::Edge_index e : edges(m.sm))
    m.is_seam[e] = is_border(e, m.sm) || cut[imported.index_of_edge(e)];
  m.check();

  // one disk, by Euler's formula
  const auto seam_mesh = CE::make_seam_mesh(m.sm, m.is_seam, m.is_on_seam);
  BOOST_TEST(num_vertices(seam_mesh) + num_faces(seam_mesh) == num_edges(seam_mesh) + 1);
}

} // namespace

BOOST_AUTO_TEST_CASE(cut_graphs, * testing::needs_mesh("elephant.off"))
{
  check_cut_mesh("elephant.off", 0);
  check_cut_mesh("elephant.off", 5);
  check_cut_mesh("knot1.off", 0);
  check_cut_mesh("bear.off", 8);
  check_cut_mesh("head.off", 3);
  check_cut_mesh("elephant-with-holes.off", 4);
}

BOOST_AUTO_TEST_CASE(nothing_to_cut)
{
  for(const testing::Soup& soup : { testing::flat_grid(4), testing::icosphere(1), testing::annulus(2, 7, .3) })
  {
    Marked_mesh m(soup);
    m.check();
    for(Mesh::Edge_index e : edges(m.sm)) // the border is no seam
      m.is_seam[e] = is_border(e, m.sm);
    m.check();
  }
}

// From border to border: two pieces, which share no vertex.
BOOST_AUTO_TEST_CASE(a_square_in_two_halves)
{
  Marked_mesh m(testing::flat_grid(4));
  for(Mesh::Edge_index e : edges(m.sm))
    m.is_seam[e] = source(e, m.sm).idx() % 5 == 2 && target(e, m.sm).idx() % 5 == 2; // the middle line
  m.check();
  BOOST_TEST(num_vertices(CE::make_seam_mesh(m.sm, m.is_seam, m.is_on_seam)) == 30u);
}

// CGAL does not call it valid, but its numbers and its vertices are right.
BOOST_AUTO_TEST_CASE(one_edge_inside)
{
  Marked_mesh m(testing::icosphere(1));
  m.is_seam[Mesh::Edge_index(7)] = true;
  m.check(false);
  BOOST_TEST(num_vertices(CE::make_seam_mesh(m.sm, m.is_seam, m.is_on_seam)) == num_vertices(m.sm)); // both ends are whole
}

BOOST_AUTO_TEST_CASE(everything_is_cut)
{
  for(const testing::Soup& soup : { testing::flat_grid(3), testing::icosahedron(), testing::torus(5, 4) })
  {
    Marked_mesh m(soup);
    for(Mesh::Edge_index e : edges(m.sm))
      m.is_seam[e] = true;
    m.check();
    BOOST_TEST(num_vertices(CE::make_seam_mesh(m.sm, m.is_seam, m.is_on_seam)) == 3 * num_faces(m.sm));
  }
}

BOOST_AUTO_TEST_CASE(another_mesh)
{
  Polyhedron p;
  CGAL::copy_face_graph(testing::surface_mesh<Mesh>(testing::torus(6, 5)), p);
  auto is_seam = get(CGAL::dynamic_edge_property_t<bool>(), p);
  auto is_on_seam = get(CGAL::dynamic_vertex_property_t<bool>(), p);
  const auto h = halfedge(*vertices(p).begin(), p);
  for(const auto e : edges(p)) // a star
    put(is_seam, e, target(e, p) == target(h, p) || source(e, p) == target(h, p));
  for(const auto v : vertices(p))
    put(is_on_seam, v, false);
  check_seam_mesh(p, is_seam, is_on_seam);
}
