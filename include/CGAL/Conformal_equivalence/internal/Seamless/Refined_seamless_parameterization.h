// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A seamless parameterization on the common refinement of the mesh and the triangulation of the flat metric. Any map of edges that keeps the
// order of crossings takes the convex parts of the one to those of the other (Overlay/), so that nothing is inverted before cones are moved, whether
// the metric is a conformally equivalent one or one in which handles were turned.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_REFINED_SEAMLESS_PARAMETERIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_REFINED_SEAMLESS_PARAMETERIZATION_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Refined_mesh_elements.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Doors/output_maps.h>
#include <CGAL/Conformal_equivalence/internal/Doors/refined_output.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Quantized_cone.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Rectified_layout.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/make_refined_mesh.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The mesh of a refinement, imported, with the cut and the layout of the refinement.
template <typename RefinedMesh>
struct Refined_surface
{
  typedef std::uint32_t Index;

  Imported_mesh<RefinedMesh> mesh;
  Cut_graph cut;
  Layout<double> layout;
  std::vector<Index> input_halfedge; // by halfedge: along which one of the input it runs, on the same side; null_index: inside a face
  std::vector<Index> input_face;     // by face

  // `parts` are triangles, of which `refined` was made.
  Refined_surface(const RefinedMesh& refined, const Refined_mesh_elements<RefinedMesh>& elements, const Common_refinement<double>& parts,
                  const Intrinsic_triangulation<double>& input, const Cut_graph& input_cut)
    : mesh(refined)
  {
    const Intrinsic_triangulation<double>& t = mesh.triangulation;
    layout.corner.resize(t.number_of_halfedges());
    input_halfedge.assign(t.number_of_halfedges(), t.null_index);
    input_face.resize(t.number_of_faces());
    cut.is_cut.assign(t.number_of_edges(), 0);
    for(Index f = 0; f < parts.number_of_faces(); ++f)
    {
      input_face[mesh.index_of_face(elements.faces[f])] = parts.input_face[f];
      for(std::size_t c = parts.first_corner[f]; c < parts.first_corner[f + 1]; ++c)
      {
        const Index h = mesh.index_of_halfedge(elements.halfedges[c]), side = t.next(h); // from this corner to the next one
        layout.corner[h] = parts.corner_uv[c];
        input_halfedge[side] = parts.corner_halfedge[c];
        if(input_halfedge[side] != t.null_index && input_cut[input.edge(input_halfedge[side])] && !t.is_border(side))
          cut.is_cut[t.edge(side)] = 1;
      }
    }
  }
};

// As `Seamless_parameterization`, which finds the metric.
template <typename TriangleMesh, typename RefinedMesh>
class Refined_seamless_parameterization
{
  typedef std::uint32_t Index;
  typedef Flattening_report<TriangleMesh> Report;
  typedef Lattice_coordinates<std::int64_t> Lattice_point;

public:
  Refined_seamless_parameterization(Imported_mesh<TriangleMesh> mesh, const Stopwatch& since, const Seamless_options& options,
                                    RefinedMesh& refined)
    : seamless_(std::move(mesh), since, options), refined_(refined)
  {}

  Report& report() { return seamless_.flattening.report; }

  template <typename HalfedgeUVMap, typename NamedParameters, typename NamedParametersRefined>
  void run(HalfedgeUVMap uv, const NamedParameters& np, const NamedParametersRefined& np_refined)
  {
    auto& flattening = seamless_.flattening;
    seamless_.find_cut_metric(np);
    flattening.lay_out_with_refinement(true);
    flattening.tell_what_was_found();
    if(!bool(report()))
      return;
    const Common_refinement<double> parts = triangulate_refinement(flattening.refinement);
    const Refined_mesh_elements<RefinedMesh> elements = make_refined_mesh(flattening.mesh, parts, refined_, uv, np, np_refined);
    if(elements.faces.empty())
    {
      report().status = Status::NOT_REPRESENTABLE;
      return;
    }
    Refined_surface<RefinedMesh> surface(refined_, elements, parts, flattening.mesh.triangulation, flattening.cut);
    set_lengths_from_points(surface.mesh, parameters::choose_parameter(parameters::get_parameter(np_refined, internal_np::vertex_point),
                                                                       get(CGAL::vertex_point, refined_)));
    surface.layout.length_error = flattening.layout.length_error;
    std::vector<Quantized_cone> cones = seamless_.quantized_cones();
    for(Quantized_cone& cone : cones)
      cone.vertex = surface.mesh.index_of_vertex(elements.vertices[cone.vertex]);
    Rectified_layout rectified = seamless_.rectified(surface.mesh.triangulation, surface.cut, surface.layout, cones, np);
    take(std::move(rectified), surface);
    seamless_.finish();
    if(!bool(report()) && report().status != Status::BOUND_NOT_MET)
    {
      CGAL::clear(refined_);
      return;
    }
    write_corners(surface.mesh, layout_, uv);
    write_metric(flattening, np);
    write_seam(flattening, np);
    for(Index f = 0; f < parts.number_of_faces(); ++f)
      put_if_given(np_refined, internal_np::conformal_input_face, elements.faces[f], flattening.mesh.face(parts.input_face[f]));
  }

private:
  void take(Rectified_layout rectified, const Refined_surface<RefinedMesh>& surface)
  {
    const auto& mesh = seamless_.flattening.mesh;
    if(rectified.status != Status::OK)
    {
      report().status = rectified.status;
      report().amount = rectified.amount;
      name_elements(mesh, {}, input_edges(rectified.edges, surface), input_faces(rectified.faces, surface), report());
      if(rectified.status != Status::BOUND_NOT_MET)
        return;
    }
    report().tiling = rectified.tiling;
    for(std::size_t i = 0; i < report().cones.size(); ++i)
      report().cones[i].lattice_point = rectified.cone_positions[i];
    take_transitions(rectified, surface);
    report().lattices.clear();
    layout_ = std::move(rectified.layout);
  }

  // The parts of a seam edge all have one motion: by the input halfedge.
  void take_transitions(const Rectified_layout& rectified, const Refined_surface<RefinedMesh>& surface)
  {
    const Intrinsic_triangulation<double>& t = seamless_.flattening.mesh.triangulation;
    const Texture_lattice lattice(rectified.tiling.symmetry);
    std::vector<std::size_t> number(t.number_of_halfedges(), rectified.quanta.size()); // by input halfedge: of a transition of a part
    for(std::size_t j = 0; j < rectified.quanta.size(); ++j)
      number[surface.input_halfedge[rectified.layout.transitions[j].halfedge]] = j;
    for(std::size_t i = 0; i < report().transitions.size(); ++i)
    {
      const Index h = seamless_.flattening.layout.transitions[i].halfedge;
      const bool is_forward = number[h] < rectified.quanta.size();
      const std::size_t j = is_forward ? number[h] : number[t.twin(h)];
      int quanta = rectified.quanta[j];
      Lattice_point by = rectified.translations[j];
      if(!is_forward)
      {
        quanta = lattice.reduced(-quanta);
        by = lattice.rotated(quanta, Lattice_point{{-by[0], -by[1]}});
      }
      const auto rotation = lattice.rotation(quanta), translation = lattice.to_plane(by);
      auto& transition = report().transitions[i];
      transition.rotation = {{rotation.real(), rotation.imag()}};
      transition.translation = {{translation.real(), translation.imag()}};
      transition.quanta = quanta;
      transition.lattice_translation = by;
    }
  }

  std::vector<Index> input_edges(const std::vector<Index>& edges, const Refined_surface<RefinedMesh>& surface) const
  {
    std::vector<Index> result;
    for(Index e : edges)
      result.push_back(seamless_.flattening.mesh.triangulation.edge(surface.input_halfedge[surface.mesh.triangulation.edge_halfedge(e)]));
    return each_once(std::move(result));
  }

  static std::vector<Index> input_faces(const std::vector<Index>& faces, const Refined_surface<RefinedMesh>& surface)
  {
    std::vector<Index> result;
    for(Index f : faces)
      result.push_back(surface.input_face[f]);
    return each_once(std::move(result));
  }

  static std::vector<Index> each_once(std::vector<Index> elements)
  {
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    return elements;
  }

  Seamless_parameterization<TriangleMesh> seamless_;
  RefinedMesh& refined_;
  Layout<double> layout_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_REFINED_SEAMLESS_PARAMETERIZATION_H
