// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Where edges were flipped: how far the straight edges between the places of their ends are from what they would be if they had not been.

#include "../include/flatten_mesh/figures.h"

#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace flattening {

namespace {

typedef CE::Intrinsic_triangulation<double> Triangulation;

// The length in the layout of the edge of `h`, on its left.
double length_in_layout(const Result& result, Halfedge h)
{
  const Kernel::Point_2 p = result.uv[h], q = result.uv[result.mesh.prev(h)];
  return std::hypot(p.x() - q.x(), p.y() - q.y());
}

template <typename Imported>
Triangulation with_lengths_of_layout(const Imported& imported, const Result& result)
{
  const Triangulation& t = imported.triangulation;
  std::vector<double> lengths;
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
    lengths.push_back(length_in_layout(result, imported.halfedge(t.edge_halfedge(e))));
  return t.with_lengths(std::move(lengths));
}

// The largest relative difference of a border edge that was flipped from the length that u makes it.
template <typename Imported>
double largest_border_error(const Imported& imported, const Result& result, const std::vector<Mesh::Edge_index>& edges)
{
  const Triangulation& t = imported.triangulation;
  double largest = 0;
  for(Mesh::Edge_index e : edges)
  {
    const std::uint32_t i = imported.index_of_edge(e);
    const std::uint32_t h = t.edge_halfedge(i);
    const double u = (result.u[imported.vertex(t.origin(h))] + result.u[imported.vertex(t.target(h))]) / 2,
                 length = std::exp(u) * t.length(i);
    largest = (std::max)(largest, std::abs(length_in_layout(result, imported.halfedge(h)) / length - 1));
  }
  return largest;
}

} // namespace

void find_errors_of_straight_edges(const Options& options, const Result& given, bool is_written, Figures& figures)
{
  const Report& report = figures.report;
  if(options.target != Target::PLANE || options.seamless || options.local_repair || report.statistics.number_of_flips == 0)
    return;
  const auto imported = CE::import_mesh(given.mesh, CGAL::parameters::mollification(options.mollification));
  if(imported.status != CE::Status::OK)
    return;
  if(! report.lost_border_edges.empty())
    figures.border_length_error = largest_border_error(imported, given, report.lost_border_edges);
  if(is_written)
    figures.cross_ratio_error = CE::largest_cross_ratio_difference(imported.triangulation, with_lengths_of_layout(imported, given));
}

} // namespace flattening
