// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The methods that the benchmarks compare, and what is measured of their results.

#ifndef CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_METHODS_H
#define CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_METHODS_H

#include "Processor_stopwatch.h"
#include "benchmark_meshes.h"

#include <CGAL/Conformal_equivalence/Eigen_pattern_solver_traits.h>
#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Discrete_conformal_map_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
#  include <Eigen/CholmodSupport>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace benchmarks {

namespace CE = CGAL::Conformal_equivalence;
namespace SMP = CGAL::Surface_mesh_parameterization;
typedef CE::internal::Stopwatch Stopwatch;

// Processor seconds of each stage of `flatten()`: a model of `ConformalEquivalenceVisitor`.
class Stage_seconds : public CE::Default_visitor
{
public:
  // the import begins with the call, before it is announced
  void on_stage(CE::Stage stage)
  {
    end_stage();
    stage_ = stage;
  }

  void end_stage()
  {
    seconds_[std::size_t(stage_)] += stopwatch_.seconds();
    elapsed_seconds_[std::size_t(stage_)] += elapsed_.seconds();
    stopwatch_ = Processor_stopwatch();
    elapsed_ = Stopwatch();
  }

  double operator[](CE::Stage stage) const { return seconds_[std::size_t(stage)]; }
  double elapsed(CE::Stage stage) const { return elapsed_seconds_[std::size_t(stage)]; }

private:
  std::array<double, 8> seconds_ = {}, elapsed_seconds_ = {};
  CE::Stage stage_ = CE::Stage::IMPORT;
  Processor_stopwatch stopwatch_;
  Stopwatch elapsed_;
};

// What one method made of one mesh.
struct Result
{
  bool is_success = false;
  std::string message;          // in words, if it is none
  double seconds = 0;           // of processors, for the whole call
  double elapsed_seconds = 0;
  // of this package's method only
  Stage_seconds stage_seconds;
  CE::Statistics statistics;
  double largest_u = 0, layout_length_error = 0;
};

typedef Mesh::Property_map<halfedge_descriptor, Point_2> UV_map;

// This package, natural border, through `flatten()`.
template <typename SolverTraits>
Result flatten_conformally(Mesh& mesh, UV_map uv, unsigned number_of_threads = 1)
{
  auto u = mesh.add_property_map<vertex_descriptor, double>("v:u", 0).first;
  Result result;
  const Stopwatch stopwatch;
  const Processor_stopwatch processor_stopwatch;
  const auto report = CE::flatten(mesh, uv, CGAL::parameters::log_scale_factor_map(u)
                                              .sparse_linear_solver(SolverTraits())
                                              .number_of_threads(number_of_threads)
                                              .visitor(std::ref(result.stage_seconds)));
  result.stage_seconds.end_stage(); // the last one includes the writing of the maps
  result.seconds = processor_stopwatch.seconds();
  result.elapsed_seconds = stopwatch.seconds();
  result.is_success = bool(report);
  result.message = message(report);
  result.statistics = report.statistics;
  result.layout_length_error = report.layout_length_error;
  for(vertex_descriptor v : vertices(mesh))
    result.largest_u = (std::max)(result.largest_u, std::abs(get(u, v)));
  return result;
}

// A parameterizer of CGAL, with its defaults.
template <typename Parameterizer>
Result parameterize(Mesh& mesh, UV_map uv)
{
  auto vertex_uv = mesh.add_property_map<vertex_descriptor, Point_2>("v:uv", Point_2(0, 0)).first;
  Result result;
  const Stopwatch stopwatch;
  const Processor_stopwatch processor_stopwatch;
  const halfedge_descriptor border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  if(border == boost::graph_traits<Mesh>::null_halfedge())
    throw std::runtime_error("the mesh has no border");
  const SMP::Error_code code = SMP::parameterize(mesh, Parameterizer(), border, vertex_uv);
  result.seconds = processor_stopwatch.seconds();
  result.elapsed_seconds = stopwatch.seconds();
  result.is_success = code == SMP::OK;
  result.message = "error code " + std::to_string(int(code));
  for(halfedge_descriptor h : halfedges(mesh))
    put(uv, h, get(vertex_uv, target(h, mesh)));
  return result;
}

inline bool is_disk(const Mesh& mesh)
{
  const auto imported = CE::import_mesh(mesh);
  if(imported.status != CE::Status::OK)
    return false;
  const auto& t = imported.triangulation;
  return CE::surface_topology(t, CE::connected_components(t)).is_disk();
}

// `ours` (the default solver), `ours-2` (with two threads), `ours-simplicial`, `ours-cholmod` (where it was found), `lscm`, `arap`, `dcm`.
inline Result run_method(const std::string& method, Mesh& mesh, UV_map uv)
{
  if(method == "ours")
    return flatten_conformally<CE::Default_solver_traits>(mesh, uv);
  if(method == "ours-2")
    return flatten_conformally<CE::Default_solver_traits>(mesh, uv, 2);
  if(method == "ours-simplicial")
    return flatten_conformally<CE::Simplicial_solver_traits>(mesh, uv);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
  if(method == "ours-cholmod")
    return flatten_conformally<CE::Cholmod_solver_traits>(mesh, uv);
#endif
  if(method == "lscm")
    return parameterize<SMP::LSCM_parameterizer_3<Mesh> >(mesh, uv);
  if(method == "arap")
    return parameterize<SMP::ARAP_parameterizer_3<Mesh> >(mesh, uv);
  if(method == "dcm")
    return parameterize<SMP::Discrete_conformal_map_parameterizer_3<Mesh> >(mesh, uv);
  throw std::runtime_error("no method is called " + method);
}

inline double distance(const Point_2& p, const Point_2& q) { return std::hypot(q.x() - p.x(), q.y() - p.y()); }

// The largest relative error of the border's edge lengths after the scaling that makes it least:
// with the ratios between a and b, that is (b - a) / (b + a). No number if the layout has none.
inline double border_length_error(const Mesh& mesh, UV_map uv)
{
  double least = (std::numeric_limits<double>::max)(), most = 0;
  for(halfedge_descriptor h : halfedges(mesh))
  {
    if(!is_border(h, mesh))
      continue;
    const double length = std::sqrt(CGAL::squared_distance(mesh.point(source(h, mesh)), mesh.point(target(h, mesh))));
    const double ratio = distance(get(uv, prev(opposite(h, mesh), mesh)), get(uv, opposite(h, mesh))) / length;
    if(!std::isfinite(ratio))
      return std::numeric_limits<double>::quiet_NaN();
    least = (std::min)(least, ratio);
    most = (std::max)(most, ratio);
  }
  return (most - least) / (most + least);
}

// How good a layout is, whoever made it.
struct Quality
{
  double mean_qc = 0, max_qc = 0, border_error = 0;
  std::size_t flips = 0;          // triangles that are not positive, exactly, in the orientation of most
  CE::Injectivity injectivity = CE::Injectivity::UNDECIDED;
};

inline Quality measure(const Mesh& mesh, UV_map uv)
{
  Quality quality;
  const auto distortion = CE::compute_conformal_distortion(mesh, uv);
  quality.mean_qc = distortion.mean_quasi_conformal_factor;
  quality.max_qc = distortion.maximum_quasi_conformal_factor;
  quality.border_error = border_length_error(mesh, uv);
  const auto verdict = CE::verify_layout(mesh, uv);
  const std::size_t negative = verdict.number_of_flipped_triangles, collapsed = verdict.number_of_degenerate_triangles;
  quality.flips = (std::min)(negative, num_faces(mesh) - negative - collapsed) + collapsed;
  quality.injectivity = verdict.injectivity;
  return quality;
}

inline const char* to_string(CE::Injectivity injectivity)
{
  return injectivity == CE::Injectivity::YES ? "yes" : injectivity == CE::Injectivity::NO ? "no" : "undecided";
}

} // namespace benchmarks

#endif // CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_METHODS_H
