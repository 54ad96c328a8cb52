// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_OPTIONS_H
#define FLATTEN_MESH_OPTIONS_H

#include <CGAL/Conformal_equivalence/options.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flattening {

const unsigned int most_bits = 16384; // that --precision takes

enum class Target { PLANE, SPHERE, DISK, HYPERBOLIC };

// As it was given: its long name, and its value if it takes one.
struct Given_option
{
  std::string name;
  std::optional<std::string> value;
};

// The command line, as values.
struct Options
{
  std::string input, obj, svg, html, report;          // of one input (several_inputs.h); before, names of outputs may have a % for it
  std::string glb, ply, flat, dxf;
  double true_scale = 0;                              // millimetres in a unit of the layout; 0: pictures have no size
  Target target = Target::PLANE;
  std::optional<std::size_t> vertex_at_infinity, disk_centre;
  std::optional<std::array<std::size_t, 3> > disk_points;
  bool weighs_areas = false;                          // has the barycentre of the areas in the centre, not that of the vertices
  bool is_rectangle = false;
  std::optional<std::array<std::size_t, 4> > corners; // of the rectangle; chosen if absent
  std::string angle_file, scale_file;                 // of the borders
  std::string cone_file;
  std::string holonomy_file;                          // how loops around handles turn
  bool places_cones = false;                          // --cones auto
  std::size_t number_of_cones = 0;                    // to be placed; 0: as many as the bounds ask for
  double maximum_log_scale_factor = 0, maximum_area_distortion = 0, maximum_root_mean_square = 0; // of placed cones; 0: no bound
  std::optional<CGAL::Conformal_equivalence::Cone_measure> cone_measure;       // what they are placed for; by default what is bounded
  unsigned int quanta_of_turn = 0;                    // n: the angles of cones are multiples of 2 pi / n; 0: any
  bool seamless = false, lattice_coordinates = false;
  std::size_t number_of_tiles = 0;                    // 0: by the bound on the distortion
  double maximum_distortion = 1.02;
  bool unit_square = false;
  bool color_by_quasi_conformal_factor = false;
  bool repair = false; // of the surface that the file holds
  bool keep_border = false, refine = false, local_repair = false, projective = false, require_injective = false, quiet = false;
  CGAL::Conformal_equivalence::Retriangulation retriangulation = CGAL::Conformal_equivalence::Retriangulation::WHEN_NEEDED;
  double tolerance = 1e-12;
  double mollification = 0;
  unsigned int precision_in_bits = 53; // that of double, or more
  unsigned int maximum_number_of_iterations = 100;
  unsigned int number_of_threads = 1;
  std::string solver;
  bool is_help = false, is_version = false;
  std::string printed;                                // what --print is asked for
  std::vector<std::string> inputs;                    // all of them
  std::string format;                                 // of the inputs; empty: as they tell themselves
  bool is_report_joint = false;                       // all inputs have one report
  std::vector<Given_option> given;
};

// The places of the names of all outputs.
std::vector<std::string*> places_of_outputs(Options& options);

// The names of the files that will be written, some of them empty.
std::vector<std::string> outputs(Options options);

std::string help_text();

// Throws a `Usage_error` that says what is wrong with the command line.
Options parse_options(int argc, const char* const argv[]);

// Throws a `Usage_error` unless `name` is empty or one of the linear solvers that are compiled in.
void check_solver(const std::string& name);

} // namespace flattening

#endif // FLATTEN_MESH_OPTIONS_H
