// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_RESULTS_H
#define FLATTEN_MESH_RESULTS_H

#include "mesh.h"
#include "precision.h"

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace flattening {

typedef CE::Flattening_report<Mesh>   Report;
typedef CE::Common_refinement<double> Refinement;

// A layout, with what goes with it, in maps of the mesh itself.
struct Result
{
  Mesh& mesh;
  UV_map uv;
  Vertex_map<double> u, weight;
  Wide_layout wide; // with --precision
  std::optional<UV_map> lattice_uv; // with --lattice-coordinates: what is written instead of `uv`

  // Of a mesh that was made: by face, the face given that it is part of, or that it is made of
  std::vector<std::size_t> given_face;

  // With --target sphere or disk: the images of the vertices, in the plane z = 0 for the disk; the origin for isolated ones. If there are several
  // components, each is on a unit sphere or disk about the origin, which is written with its centre elsewhere.
  std::vector<Space_point> image;
  std::vector<Wide_space_point> wide_image; // with --precision
  std::vector<std::array<double, 2> > centres; // by vertex; empty: all are the origin

  explicit Result(Mesh& mesh)
    : mesh(mesh),
      uv(mesh.add_property_map<Halfedge, Kernel::Point_2>("h:uv").first),
      u(mesh.add_property_map<Vertex, double>("v:u", 0.).first),
      weight(mesh.add_property_map<Vertex, double>("v:weight", 1.).first)
  {}
};

// What is known of a component that was mapped by itself.
struct Mapped_component
{
  Face first_face;
  std::size_t number_of_faces = 0;
  CE::Status status = CE::Status::OK;
  CE::Statistics statistics;
  CE::Tiling tiling;
  std::array<double, 2> centre = {{0, 0}}; // of its sphere, in the plane z = 0, or of its disk, in what is written
};

// How a copy of the mesh was changed by --local-repair.
struct Repair_figures
{
  std::size_t number_of_flips = 0, number_of_splits = 0;
};

// The layout of the mesh given and, if another mesh has to be made, of that.
class Results
{
  Mesh made_mesh_;

public:
  Result given, made;
  Refinement refinement;  // if edges were flipped
  Repair_figures repair;
  double placing_seconds = 0; // of --cones auto
  bool is_search_stopped = false; // by an interrupt: the cones are the best by then
  bool is_search_futile = false;  // it was stopped before there was a metric with any cones
  std::vector<Mapped_component> components; // if there are several, and each was mapped by itself

  explicit Results(Mesh& mesh) : given(mesh), made(made_mesh_) {}
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;
};

} // namespace flattening

#endif // FLATTEN_MESH_RESULTS_H
