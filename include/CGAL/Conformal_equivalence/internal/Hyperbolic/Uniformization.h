// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The engine of `uniformize_hyperbolic()`: the metric, of the surface or its double, loops, layout, canonical generators, one after the other; with
// cones, a layout alone.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_UNIFORMIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_UNIFORMIZATION_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Hyperbolic_metric.h>
#include <CGAL/Conformal_equivalence/Hyperbolic_uniformization.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_development.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_layout.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_metric_finder.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Loop_system.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/words.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Precise_number.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Whether the surface has a border, along all of which angle sums are prescribed.
template <typename NT>
bool has_border_of_angles(const Intrinsic_triangulation<NT>& t, const Conformal_conditions<NT>& conditions)
{
  bool has_border = false;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
    {
      has_border = true;
      if(conditions.is_fixed(v))
        return false;
    }
  return has_border;
}

class Uniformization
{
public:
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<double> Triangulation;
  typedef Hyperbolic_uniformization::Wide_number Wide;
  typedef Isometry<Wide> Motion;

  // `t` with Euclidean lengths. A border along which all angle sums are prescribed is doubled.
  static Hyperbolic_uniformization run(const Triangulation& t, const Conformal_conditions<double>& conditions, const Solver_options& options,
                                       std::unique_ptr<Factorization> factorization)
  {
    if(!has_border_of_angles(t, conditions))
      return Uniformization(t, conditions, options, std::move(factorization)).result_;
    const Surface_double<double> twofold(t);
    const Index n = t.number_of_vertices(), faces = t.number_of_faces();
    Solver_options options_of_double = options;
    options_of_double.initial_log_scale_factors.clear();
    Hyperbolic_uniformization result =
      Uniformization(twofold.triangulation, twofold.conditions(conditions), options_of_double, std::move(factorization)).result_;
    result.is_doubled = true;
    const auto is_image_of = [](Index number) { return [number](Index x) { return x >= number; }; };
    result.vertices.erase(std::remove_if(result.vertices.begin(), result.vertices.end(), is_image_of(n)), result.vertices.end());
    result.faces.erase(std::remove_if(result.faces.begin(), result.faces.end(), is_image_of(faces)), result.faces.end());
    return result;
  }

private:
  Uniformization(const Triangulation& t, const Conformal_conditions<double>& conditions, const Solver_options& options,
                 std::unique_ptr<Factorization> factorization)
    : given_(t)
  {
    Hyperbolic_metric_finder<double> finder(t, conditions, options, std::move(factorization));
    result_.metric = finder.find();
    result_.set_outcome(result_.metric);
    if(!bool(result_))
      return;
    const Surface_components pieces = connected_components(t);
    for(const Surface_components::Component& c : pieces.components)
      result_.genus += c.genus();
    if(pieces.components.size() != 1 || pieces.number_of_isolated_vertices > 0)
      return;
    const Stopwatch stopwatch;
    options.visitor.on_stage(Stage::LAYOUT);
    const std::vector<char> is_cone = cones(conditions);
    if(pieces.components.front().number_of_borders == 0 && std::count(is_cone.begin(), is_cone.end(), 1) == 0)
      lay_out(finder);
    else
      develop(is_cone, conditions);
    result_.metric.statistics.seconds.layout = stopwatch.seconds();
  }

  // By vertex.
  std::vector<char> cones(const Conformal_conditions<double>& conditions) const
  {
    std::vector<char> result(given_.number_of_vertices(), 0);
    for(Index v = 0; v < given_.number_of_vertices(); ++v)
      result[v] = !given_.is_border_vertex(v) && conditions.is_cone(v);
    return result;
  }

  static std::array<double, 2> rounded(const Complex_number<Wide>& z)
  {
    return {{static_cast<double>(z.re), static_cast<double>(z.im)}};
  }

  static Hyperbolic_uniformization::Motion rounded(const Motion& m) { return {rounded(m.a), rounded(m.b)}; }

  void lay_out(Hyperbolic_metric_finder<double>& finder)
  {
    const Triangulation& t = result_.metric.triangulation;
    std::vector<double> lengths;
    for(Index e = 0; e < t.number_of_edges(); ++e)
      lengths.push_back(result_.metric.length(t.edge_halfedge(e)));
    const Index number_of_bases = 10; // loops are much shorter from a good one
    Loop_system loops = Loop_system::shortest_of(t.with_lengths(std::move(lengths)), number_of_bases);
    Hyperbolic_layout<double, Wide> layout(t, result_.metric.scale_factors, loops);
    result_.relation_error = error_of(loops.relation, layout.generator);
    const double accurate_enough = 1e-12; // beside translations, none of which is as short
    if(!(result_.relation_error <= accurate_enough))
      lay_out_with_more_digits(finder, loops, accurate_enough, layout);
    for(const Motion& frame : layout.frame)
      result_.vertex_points.push_back(rounded(frame.center()));
    for(const Motion& g : layout.generator)
      result_.generators.push_back(rounded(g));

    Word_values<Motion> deck(layout.generator, Motion::identity());
    find_canonical_generators(loops.relation, deck);
    result_.relation = loops.relation;
    result_.labels = loops.label;
    Triangulation original = t;
    undo_flips(original, result_.metric.flips, loops.label);
    result_.input_labels = std::move(loops.label);
    find_corners(original, layout.frame, deck, loops.tree.empty() ? 0 : t.origin(loops.tree.front()));
    result_.wide_generators = std::move(layout.generator);
    result_.wide_frames = std::move(layout.frame);
  }

  template <typename Number>
  static double error_of(const Word& relation, const std::vector<Isometry<Number> >& generators)
  {
    Letter_values<Isometry<Number> > values(generators.size(), Isometry<Number>::identity());
    for(std::size_t n = 0; n < generators.size(); ++n)
      values.set(std::int32_t(n + 1), generators[n]);
    return values(relation).distance_from_identity();
  }

  // In long words errors are multiplied by the sizes of all that stands before: for a hundred handles, two `double` may not do. Then the metric gets
  // more digits, and more again, as long as numbers have them. What is laid out is kept if it is better than what was there.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void lay_out_with_more_digits(Hyperbolic_metric_finder<double>& finder, const Loop_system& loops, double accurate_enough,
                                Hyperbolic_layout<double, Wide>& layout)
  {
    std::vector<Precise_number> s;
    for(const Wide& x : result_.metric.scale_factors)
      s.push_back(To_precise()(x));
    for(const double goal : {1e-60, 1e-120, 1e-240})
    {
      finder.improve(result_.metric, s, Precise_number(goal));
      Hyperbolic_layout<double, Precise_number> found(result_.metric.triangulation, s, loops);
      const double error = error_of(loops.relation, found.generator);
      if(error < result_.relation_error)
      {
        result_.relation_error = error;
        for(std::size_t n = 0; n < found.generator.size(); ++n)
          layout.generator[n] = found.generator[n].template converted<Wide>(From_precise<Wide>());
        for(std::size_t v = 0; v < found.frame.size(); ++v)
          layout.frame[v] = found.frame[v].template converted<Wide>(From_precise<Wide>());
        result_.precise_generators = std::move(found.generator);
      }
      if(result_.relation_error <= accurate_enough)
        return;
    }
  }

  // With cones or borders: no group, but a disk.
  void develop(const std::vector<char>& is_cone, const Conformal_conditions<double>& conditions)
  {
    std::vector<Wide> half_angle_cosine(given_.number_of_vertices(), Wide(-1));
    for(Index v = 0; v < given_.number_of_vertices(); ++v)
      if(is_cone[v])
        half_angle_cosine[v] = conditions.is_fixed(v) ? Wide(2) : unit_complex(Wide(conditions.angle_sum(v).template radians<Wide>() / 2)).re;
    const Hyperbolic_development<double> disk(result_.metric, is_cone, half_angle_cosine);
    const Triangulation& t = disk.triangulation();
    result_.vertex_points.resize(t.number_of_vertices());
    for(Index h = t.number_of_halfedges(); h > 0; --h)
      result_.vertex_points[t.origin(h - 1)] = rounded(disk.corner[h - 1]);
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
      result_.corner_points.push_back(rounded(disk.corner[t.next(h)]));
    result_.is_seam = disk.is_seam;
    for(const Motion& m : disk.side_pairings)
      result_.generators.push_back(rounded(m));
    result_.relation_error = disk.closing_error;
  }

  void find_canonical_generators(const Word& relation, Word_values<Motion>& deck)
  {
    result_.canonical_words = canonical_generators(relation);
    for(const Word& w : result_.canonical_words)
      result_.canonical_generators.push_back(rounded(deck(w)));
  }

  void find_corners(const Triangulation& original, const std::vector<Motion>& frame, Word_values<Motion>& deck, Index base)
  {
    const std::vector<Word> origin_word = fundamental_domain(original, result_.input_labels, frame, deck, base);
    for(Index h = 0; h < original.number_of_halfedges(); ++h)
    {
      const Word& w = origin_word[original.next(h)];
      result_.corner_words.push_back(w);
      result_.corner_points.push_back(rounded((deck(w) * frame[original.target(h)]).center()));
    }
    for(Index e = 0; e < original.number_of_edges(); ++e)
    {
      const Index h = original.edge_halfedge(e), g = original.twin(h);
      result_.is_seam.push_back(!are_equal(origin_word[g], origin_word[original.next(h)], deck));
    }
  }

  // Different words may stand for the same motion, where the relation is at work; and different motions are far apart, compared with rounding.
  static bool are_equal(const Word& v, const Word& w, Word_values<Motion>& deck)
  {
    const double less_than_any_translation = 1e-10;
    return v == w || (deck(v).inverse() * deck(w)).distance_from_identity() < less_than_any_translation;
  }

  const Triangulation& given_;
  Hyperbolic_uniformization result_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_UNIFORMIZATION_H
