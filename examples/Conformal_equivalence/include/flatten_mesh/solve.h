// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SOLVE_H
#define FLATTEN_MESH_SOLVE_H

#include "conditions.h"
#include "inscribe.h"
#include "mesh.h"
#include "messages.h"
#include "options.h"
#include "precision.h"
#include "repair.h"
#include "results.h"

#include <CGAL/Conformal_equivalence/Eigen_pattern_solver_traits.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/Status.h>

#include <functional>
#include <iostream>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#  include <unistd.h>
#endif

namespace flattening {

// Shows on a terminal how far the computation is, in one line that is wiped out at the end.
class Progress
{
public:
  Progress(std::ostream& err, bool is_shown) : m_err(err), m_is_shown(is_shown) {}
  ~Progress() { show(""); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& line)
  {
    if(m_is_shown)
      m_err << "\r\033[K" << line << std::flush;
  }

private:
  std::ostream& m_err;
  bool m_is_shown;
};

inline bool is_terminal(const std::ostream& err)
{
#if defined(__unix__) || defined(__APPLE__)
  return &err == &std::cerr && isatty(STDERR_FILENO);
#else
  return false;
#endif
}

struct Progress_visitor : CE::Default_visitor
{
  Progress* progress;

  explicit Progress_visitor(Progress& progress) : progress(&progress) {}

  void on_stage(CE::Stage stage)
  {
    static const char* names[] = { "importing", "solving", "cutting", "laying out", "verifying" };
    progress->show(names[static_cast<int>(stage)]);
  }

  void on_iteration(std::size_t iteration, double residual)
  {
    progress->show(text("solving: Newton step ", iteration, ", residual ", residual));
  }
};

template <typename SolverTraits>
Report flatten_with(const SolverTraits& solver, const Options& options, const Conditions& conditions,
                    Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  Result& given = results.given;
  const auto common =
    CGAL::parameters::log_scale_factor_map(given.u)
                     .projective_weight_map(given.weight)
                     .mollification(options.mollification)
                     .gradient_tolerance(options.precision_in_bits > bits_of_double ? 0. : options.tolerance)
                     .number_of_iterations(options.maximum_number_of_iterations)
                     .retriangulation(options.retriangulation)
                     .sparse_linear_solver(solver)
                     .visitor(std::ref(visitor));
  if(options.target != Target::PLANE)
    return inscribe(options, results, common);
  const auto np =
    common.border_angle_map(conditions.border_angle)
          .cone_angle_map(conditions.cone_angle)
          .vertex_is_constrained_map(conditions.is_constrained)
          .prescribed_log_scale_factor_map(conditions.u)
          .border_edges(options.keep_border ? CE::Border_edges::KEPT : CE::Border_edges::FLIPPABLE)
          .layout_frame(options.unit_square ? CE::Layout_frame::UNIT_SQUARE : CE::Layout_frame::CANONICAL);
  if(options.local_repair)
    return flatten_repaired(given, results.made, results.repair, np);
  if(options.precision_in_bits > bits_of_double)
    return flatten_precisely(given.mesh, given.uv, results.refinement, given.wide, np);
  return CE::flatten(given.mesh, given.uv, np.common_refinement(std::ref(results.refinement)));
}

// The linear solvers compiled in, the default first.
inline std::vector<std::string> solver_names()
{
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
  return { "cholmod", "simplicial" };
#else
  return { "simplicial" };
#endif
}

inline void check_solver(const std::string& name)
{
  std::string known;
  for(const std::string& s : solver_names())
  {
    if(name.empty() || name == s)
      return;
    known += (known.empty() ? "" : ", ") + s;
  }
  throw Usage_error(text("unknown solver '", name, "'; this program has: ", known));
}

inline Report flatten(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  if(options.solver == "simplicial" && ! std::is_same<CE::Default_solver_traits, CE::Simplicial_solver_traits>::value)
    return flatten_with(CE::Simplicial_solver_traits(), options, conditions, results, progress);
  return flatten_with(CE::Default_solver_traits(), options, conditions, results, progress);
}

} // namespace flattening

#endif // FLATTEN_MESH_SOLVE_H
