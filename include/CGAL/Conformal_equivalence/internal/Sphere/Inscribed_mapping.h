// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the maps to the sphere and to the disk have in common: which apex, which triangulation, and when a result is good.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_INSCRIBED_MAPPING_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_INSCRIBED_MAPPING_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Stages.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/resolve_degenerate_faces.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron_finder.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/best_apices.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>
#include <CGAL/Conformal_equivalence/projective_interpolation.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

template <typename NT>
class Inscribed_mapping
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef Ideal_polyhedron<NT> Polyhedron;

public:
  // Normalizes and judges a polyhedron: returns its faces that are not positive, or changes its status.
  typedef std::function<std::vector<Index>(Polyhedron&)> Accept;

  // `surface`: closed, or with one border; `whole`: the same, or its double. Both are kept as references.
  Inscribed_mapping(const Triangulation& surface, const Triangulation& whole, Solver_options options, Factorization_maker make_factorization)
    : surface_(surface), whole_(whole), options_(std::move(options)), make_factorization_(std::move(make_factorization))
  {}

  // The polyhedron that is accepted. On failure its status says why. `apex`: null_index for the best one.
  Polyhedron operator()(Index apex, const Accept& accept) const;

private:
  // Whether the whole has faces of no area that are to be resolved.
  bool has_faces_to_resolve() const { return options_.retriangulation == Retriangulation::WHEN_NEEDED && !degenerate_faces(whole_).empty(); }

  // A whole with `has_degenerate_faces` is solved with flips only, which resolve them first.
  Polyhedron find(Index apex, bool has_degenerate_faces, const Accept& accept) const
  {
    const Retriangulation retriangulation = options_.retriangulation;
    const Stopwatch stopwatch;
    Polyhedron result;
    double discarded = 0;
    std::size_t discarded_iterations = 0;
    if(retriangulation != Retriangulation::ALWAYS && !has_degenerate_faces)
    {
      result = on_fixed_triangulation(apex, retriangulation == Retriangulation::NEVER, accept);
      const bool may_be_helped_by_flips = is_worth_another_try(result.status) || result.status == Status::SCALE_OUT_OF_RANGE;
      if(retriangulation == Retriangulation::NEVER || is_success(result.status) || !may_be_helped_by_flips)
      {
        result.statistics.seconds.solve = stopwatch.seconds();
        return result;
      }
      discarded = stopwatch.seconds();
      discarded_iterations = result.statistics.number_of_iterations;
    }
    Triangulation start = whole_;
    std::vector<Index> flips;
    if(has_degenerate_faces)
      flips = resolve_degenerate_faces(start);
    const std::size_t number_of_resolving_flips = flips.size();
    result = with_flips(apex, std::move(start), std::move(flips), accept);
    result.statistics.number_of_resolving_flips = number_of_resolving_flips;
    result.statistics.seconds.solve = stopwatch.seconds();
    result.statistics.seconds.discarded = discarded;
    result.statistics.number_of_discarded_iterations = discarded_iterations;
    tell_flips(retriangulation, result);
    return result;
  }

  // Whether a convex polyhedron, which there is for every surface, may be found in another way: with flips, or from another apex.
  static bool is_worth_another_try(Status status)
  {
    return status == Status::DEGENERATE_METRIC || status == Status::ITERATIONS_EXHAUSTED || status == Status::SINGULAR_PROBLEM
        || status == Status::ANGLE_OUT_OF_RANGE || status == Status::NO_ANGLE_LEFT || status == Status::NOT_INJECTIVE;
  }

  Symmetry_axis axis(Index apex) const { return surface_.is_border_vertex(apex) ? border_axis(surface_, apex) : Symmetry_axis(); }

  // The same for all vertices of the whole.
  Symmetry_axis whole_axis(Index apex) const
  {
    Symmetry_axis result = axis(apex);
    if(!result.empty())
      result.contains.resize(whole_.number_of_vertices(), 0);
    return result;
  }

  // Seen from another vertex, a polyhedron that is not convex may have triangles that are flipped in the plane, and then is not found. So that it
  // does not depend on the vertex given whether edges will be flipped, the best one decides, unless `is_any_good`.
  Polyhedron on_fixed_triangulation(Index apex, bool is_any_good, const Accept& accept) const
  {
    const std::vector<Index> best = best_apices(surface_, 1);
    if(best.empty() && apex == surface_.null_index)
      return without_apex();
    const Ideal_polyhedron_finder<NT> find(surface_, options_, make_factorization_);
    const auto found = [&](Index a) { return judged(find.on_fixed_triangulation(a, axis(a)), accept); };
    Polyhedron result = best.empty() ? without_apex() : found(best[0]);
    if(apex == surface_.null_index || (!best.empty() && apex == best[0]) || !(is_any_good || is_success(result.status)))
      return result;
    Polyhedron other = found(apex);
    return is_success(other.status) || !is_success(result.status) ? other : result;
  }

  // `start` is what `flips` have made of the whole.
  Polyhedron with_flips(Index apex, Triangulation start, std::vector<Index> flips, const Accept& accept) const
  {
    Polyhedron result;
    if(options_.retriangulation == Retriangulation::ALWAYS && !make_intrinsic_delaunay(start, result.faces, [&](Index e) { flips.push_back(e); }))
    {
      // those of the surface come before their images
      result.faces.erase(std::lower_bound(result.faces.begin(), result.faces.end(), surface_.number_of_faces()), result.faces.end());
      result.status = Status::DEGENERATE_METRIC;
      return result;
    }
    std::vector<Index> apices = best_apices(is_closed() ? start : surface_, most_apices_);
    if(apex != surface_.null_index) // others lead to the same polyhedron, if this one fails
      apices.insert(apices.begin(), apex);
    const Ideal_polyhedron_finder<NT> find(whole_, options_, make_factorization_);
    result = without_apex();
    for(Index a : apices)
    {
      result = judged(find.convex(start, flips, a, whole_axis(a)), accept);
      if(is_success(result.status) || !is_worth_another_try(result.status))
        return result;
    }
    return result;
  }

  bool is_closed() const { return &surface_ == &whole_; }

  static Polyhedron without_apex()
  {
    Polyhedron result;
    result.status = Status::WRONG_TOPOLOGY;
    return result;
  }

  static Polyhedron judged(Polyhedron polyhedron, const Accept& accept)
  {
    if(!is_success(polyhedron.status))
      return polyhedron;
    const std::vector<Index> flipped = accept(polyhedron);
    if(is_success(polyhedron.status) && !flipped.empty())
    {
      polyhedron.status = Status::NOT_INJECTIVE;
      polyhedron.faces = flipped;
    }
    return polyhedron;
  }

  // The best one hardly ever fails; where it does, for what rounding makes of crowded vertices, those that are as good soon do not.
  static constexpr std::size_t most_apices_ = 8;

  const Triangulation& surface_;
  const Triangulation& whole_;
  const Solver_options options_;
  const Factorization_maker make_factorization_;
};

template <typename NT>
Ideal_polyhedron<NT> Inscribed_mapping<NT>::operator()(Index apex, const Accept& accept) const
{
  const bool has_degenerate_faces = has_faces_to_resolve();
  if(!is_closed() || !has_degenerate_faces)
    return find(apex, has_degenerate_faces, accept);
  Triangulation resolved = whole_;
  const std::vector<Index> flips = resolve_degenerate_faces(resolved);
  const Inscribed_mapping mapping(resolved, resolved, options_, make_factorization_);
  Polyhedron result = mapping.find(apex, mapping.has_faces_to_resolve(), accept);
  put_resolving_flips_first(flips, result);
  return result;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Ideal_polyhedron<double> Inscribed_mapping<double>::operator()(std::uint32_t, const Accept&) const;
#endif

// The stages of a map, one after the other, each only if all went well before: lengths; `is_kind()`, whether it is a surface of the right kind;
// `find()`; `judge()`.
template <typename TriangleMesh, typename NT, typename NamedParameters, typename Is_kind, typename Find, typename Judge>
void run_mapping(Imported_mesh<TriangleMesh, NT>& mesh, Flattening_report<TriangleMesh>& report, const NamedParameters& np,
                 Is_kind is_kind, Find find, Judge judge)
{
  const Any_visitor visitor = Conformal_equivalence::read_solver_options(np, 0).visitor;
  try
  {
    double seconds = 0;
    timed(seconds, Stage::IMPORT, visitor, [&] { set_lengths(mesh, np); report = import_report(mesh); });
    report.statistics.seconds.import = seconds;
    if(bool(report) && !is_kind(report.topology))
      report.status = Status::WRONG_TOPOLOGY;
    if(bool(report))
      find();
    if(bool(report))
      timed(report.statistics.seconds.verify, Stage::VERIFY, visitor, judge);
  }
  catch(const std::bad_alloc&)
  {
    report.status = Status::OUT_OF_MEMORY;
  }
}

// The vertex to be sent to infinity; null_index: any.
template <typename TriangleMesh, typename NT, typename NamedParameters>
std::uint32_t given_apex(const Imported_mesh<TriangleMesh, NT>& mesh, const NamedParameters& np)
{
  CGAL_USE(np);
  if constexpr(!is_given<internal_np::conformal_vertex_at_infinity_t, NamedParameters>)
    return mesh.triangulation.null_index;
  else
  {
    const auto v = parameters::get_parameter(np, internal_np::conformal_vertex_at_infinity);
    return v == boost::graph_traits<TriangleMesh>::null_vertex() ? mesh.triangulation.null_index : mesh.index_of_vertex(v);
  }
}

template <typename NamedParameters>
Moebius_weights given_moebius_weights(const NamedParameters& np)
{
  return parameters::choose_parameter(parameters::get_parameter(np, internal_np::conformal_moebius_weights), Moebius_weights::VERTICES);
}

// Names the faces, or, if these are no faces of the mesh, their vertices.
template <typename TriangleMesh, typename NT>
void take_over(const Imported_mesh<TriangleMesh, NT>& mesh, const Ideal_polyhedron<NT>& polyhedron, Flattening_report<TriangleMesh>& report)
{
  const Statistics::Seconds seconds = report.statistics.seconds;
  report.statistics = polyhedron.statistics;
  report.statistics.seconds.import = seconds.import;
  report.status = polyhedron.status;
  report.amount = polyhedron.amount;
  if(polyhedron.flips.empty())
    name_elements(mesh, polyhedron.vertices, {}, polyhedron.faces, report);
  else
    name_elements(mesh, with_vertices_of_faces(mesh.triangulation, polyhedron.vertices, polyhedron.triangulation, polyhedron.faces), {}, {}, report);
}

// The verdict on an image: the faces that are not positive there, and those that are not any more when their points are rounded.
template <typename TriangleMesh, typename NT>
void tell_verdict(const Imported_mesh<TriangleMesh, NT>& mesh, std::vector<std::uint32_t> flipped, const std::vector<std::uint32_t>& rounded,
                  Flattening_report<TriangleMesh>& report)
{
  if(report.statistics.number_of_resolving_flips != 0)
    for(std::uint32_t f : take_degenerate_faces(mesh.triangulation, flipped))
      report.flat_faces.push_back(mesh.face(f));
  if(!flipped.empty())
  {
    report.status = Status::NOT_INJECTIVE;
    name_elements(mesh, {}, {}, flipped, report);
  }
  for(std::uint32_t f : rounded)
    report.rounded_faces.push_back(mesh.face(f));
}

// u and e^{-u} of weights, by vertex of the mesh.
template <typename TriangleMesh, typename NT, typename Wide, typename NamedParameters>
void write_weights(const Imported_mesh<TriangleMesh, NT>& mesh, const std::vector<Wide>& weights, const NamedParameters& np)
{
  using parameters::get_parameter;
  using std::log;
  const Intrinsic_triangulation<NT>& t = mesh.triangulation;
  CGAL_USE(np);
  CGAL_USE(weights);
  CGAL_USE(t);
  if constexpr(is_given<internal_np::conformal_u_t, NamedParameters>)
  {
    const auto map = get_parameter(np, internal_np::conformal_u);
    typedef typename boost::property_traits<std::decay_t<decltype(map)> >::value_type Value;
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v))
        put(map, mesh.vertex(v), static_cast<Value>(static_cast<NT>(-Wide(log(weights[v])))));
  }
  if constexpr(is_given<internal_np::conformal_weight_t, NamedParameters>)
  {
    Wide largest(0);
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
      largest = t.is_isolated_vertex(v) || !(largest < weights[v]) ? largest : weights[v];
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v))
        put(get_parameter(np, internal_np::conformal_weight), mesh.vertex(v),
            (std::max)(static_cast<double>(Wide(weights[v] / largest)), (std::numeric_limits<double>::min)()));
  }
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_INSCRIBED_MAPPING_H
