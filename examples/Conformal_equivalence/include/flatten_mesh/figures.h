// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_FIGURES_H
#define FLATTEN_MESH_FIGURES_H

#include "Given_surface.h"
#include "image_figures.h"
#include "mesh.h"
#include "options.h"
#include "results.h"
#include "Robust_range.h"
#include "seamless.h"

#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

// Of one component of several.
struct Component_figures
{
  Face first_face;
  CE::Surface_topology topology;
  double u_min = std::numeric_limits<double>::infinity(), u_max = -std::numeric_limits<double>::infinity();
  std::size_t number_of_cones = 0;
};

// Everything that is known at the end.
struct Figures
{
  const Given_surface* given = nullptr;
  Report report;
  CE::Layout_verdict<Mesh> verdict;
  CE::Conformal_distortion<Mesh> distortion;
  Image_figures image; // of the sphere or the disk
  std::vector<Seam_path> seams; // of a seamless layout
  std::vector<Component_figures> component_figures; // if there are several
  std::vector<Mapped_component> components;         // the same, if each was mapped by itself
  std::size_t number_of_isolated_vertices = 0;
  std::size_t number_of_rounded_triangles = 0; // with --precision: those that are positive, but not in double
  double u_min = 0, u_max = 0;

  // If edges were flipped, of the edges of the mesh as straight edges of the layout; NaN: none were, or these are not what is written
  double border_length_error = not_a_number; // largest relative error of border edges that were flipped, to what u makes their length
  double cross_ratio_error = not_a_number;   // largest relative error of length cross ratios

  // the mesh written, if it is not the one given: the common refinement, or a repaired copy
  bool is_refined = false;
  std::size_t number_of_crossings = 0, number_of_made_vertices = 0, number_of_made_faces = 0;
  Repair_figures repair;

  bool is_search_stopped = false; // the cones are the best that were found until then

  std::vector<std::string> notices; // what is said beside the figures

  double reading_seconds = 0, placing_seconds = 0, verifying_seconds = 0, writing_seconds = 0;

  std::optional<Robust_range> color_range; // of what gives triangles their colours, if there is a drawing
};

void find_range_of_u(const Result& result, Figures& figures);

// If there are several.
void describe_components(const Result& given, Figures& figures);

void describe_made_mesh(const Results& results, bool is_refined, Figures& figures);

// `is_written` says whether the triangles of the mesh given are, and no refinement of them.
void find_errors_of_straight_edges(const Options& options, const Result& given, bool is_written, Figures& figures);

// `drawn` is what is written: `given`, or what was made of it.
void judge(const Options& options, const Result& given, Result& drawn, Figures& figures);

// ---- Figures as text

std::string count(std::size_t n, const char* singular, const char* plural);

typedef std::vector<std::pair<std::string, std::string> > Lines;

// Names and values, for the terminal and the page.
Lines summary(const Options& options, const Mesh& mesh, const Figures& figures);

// The lines, and which files were written.
void print_summary(std::ostream& out, const Options& options, const Lines& lines);

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
std::string json_report(const Options& options, const Mesh& mesh, const Figures& figures);
#endif

} // namespace flattening

#endif // FLATTEN_MESH_FIGURES_H
