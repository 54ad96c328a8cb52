// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Compile-only: the five programs that the interface was made for.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>
#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/make_seam_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>

#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <functional>
#include <iostream>
#include <vector>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::edge_descriptor           edge_descriptor;

typedef Mesh::Property_map<vertex_descriptor, Kernel::Point_2>   Vertex_uv_map;
typedef Mesh::Property_map<halfedge_descriptor, Kernel::Point_2> Halfedge_uv_map;
typedef Mesh::Property_map<vertex_descriptor, double>            Vertex_number_map;

namespace SMP = CGAL::Surface_mesh_parameterization;
namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

SMP::Error_code natural_border(Mesh& sm, halfedge_descriptor bhd, Vertex_uv_map uv)
{
  SMP::Error_code e = SMP::parameterize(sm, SMP::Conformal_equivalence_parameterizer_3<Mesh>(), bhd, uv);
  return e;
}

int scale_factors(Mesh& sm, halfedge_descriptor bhd, Vertex_uv_map uv, Vertex_number_map u, Vertex_number_map w)
{
  CE::Flattening_report<Mesh> report;
  SMP::Conformal_equivalence_parameterizer_3<Mesh> p(
    params::log_scale_factor_map(u).projective_weight_map(w).flattening_report(std::ref(report)));
  if(SMP::parameterize(sm, p, bhd, uv) != SMP::OK) { std::cerr << CE::message(report) << "\n"; return 1; }
  return 0;
}

template <typename Seam_map, typename On_seam_map, typename Use>
void four_cones(Mesh& sm, const std::vector<vertex_descriptor>& cones, Vertex_number_map angle, Halfedge_uv_map uv,
                Seam_map seam, On_seam_map on_seam, Use use)
{
  for (vertex_descriptor v : cones) angle[v] = CGAL_PI;
  const auto report = CE::flatten(sm, uv, params::cone_angle_map(angle).edge_is_seam_map(seam));
  if(!report) return;
  auto seam_mesh = CE::make_seam_mesh(sm, seam, on_seam);
  for (auto hd : halfedges(seam_mesh)) use(uv[target(hd, seam_mesh)]);
}

bool rectangle(Mesh& sm, halfedge_descriptor bhd, Vertex_number_map angle, Halfedge_uv_map uv)
{
  CE::prescribe_rectangle(sm, CE::select_rectangle_corners(sm, bhd), angle);
  const auto report = CE::flatten(sm, uv, params::border_angle_map(angle));
  return bool(report);
}

template <typename Seam_map>
bool seamless(std::ostream& out, Mesh& sm, Halfedge_uv_map uv, Seam_map seam)
{
  const auto report = CE::compute_seamless_parameterization(
    sm, uv, params::number_of_cones(8).number_of_tiles(40).edge_is_seam_map(seam));
  CE::IO::write_OBJ(out, sm, uv);
  return bool(report);
}

int main(int argc, char*[])
{
  if(argc < 1000) // compiled, not run
    return 0;
  Mesh sm;
  const halfedge_descriptor bhd;
  auto vertex_uv = sm.add_property_map<vertex_descriptor, Kernel::Point_2>("v:uv").first;
  auto uv = sm.add_property_map<halfedge_descriptor, Kernel::Point_2>("h:uv").first;
  auto number = sm.add_property_map<vertex_descriptor, double>("v:number").first;
  auto seam = sm.add_property_map<edge_descriptor, bool>("e:seam").first;
  auto on_seam = sm.add_property_map<vertex_descriptor, bool>("v:on_seam").first;
  four_cones(sm, {}, number, uv, seam, on_seam, [](const Kernel::Point_2&) {});
  return natural_border(sm, bhd, vertex_uv) + scale_factors(sm, bhd, vertex_uv, number, number)
       + rectangle(sm, bhd, number, uv) + seamless(std::cout, sm, uv, seam);
}
