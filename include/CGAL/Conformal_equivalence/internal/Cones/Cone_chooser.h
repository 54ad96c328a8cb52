// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Cones of which places and angles are chosen: as many as are asked for, or as it takes to meet bounds, as far as the linear model foresees
// (Cone_model.h). First for the root mean square of u, which has one best choice of angles; from there the largest |u| is approached by p-norms.
// The metric with these cones is found by others; the model can be made anew there.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_CHOOSER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_CHOOSER_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_fit.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_model.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_options.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_surface.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Quantized_cones.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Sparse_cones.h>
#include <CGAL/Conformal_equivalence/internal/Cones/area_distortion.h>
#include <CGAL/Conformal_equivalence/internal/Cones/coarse_surface.h>
#include <CGAL/Conformal_equivalence/internal/Cones/dense_systems.h>
#include <CGAL/Conformal_equivalence/internal/Cones/u_measures.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
class Cone_chooser
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;

public:
  // Keeps references.
  Cone_chooser(const Triangulation& t, const Surface_components::Component& component, const Cone_options& options,
               const Factorization_maker& make_factorization, const Factorization_maker& make_coarse_factorization, const Any_visitor& visitor)
    : t_(t), options_(options), make_factorization_(make_factorization), make_coarse_factorization_(make_coarse_factorization), visitor_(visitor),
      euler_characteristic_(double(component.euler_characteristic())),
      is_closed_(component.number_of_borders == 0), is_begun_coarsely_(is_begun_coarsely(t, options)), area_(vertex_areas(t)),
      width_(std::exp(log_sum(log_areas(t)) / 2))
  {}

  // Are cones first searched for on a coarse surface? Only where that has far fewer vertices: else it saves little, and places are not quite the best
  // ones; of means these matter less. A bound is to be met on the surface given.
  static bool is_begun_coarsely(const Triangulation& t, const Cone_options& options)
  {
    const std::size_t few_vertices = options.measure == Cone_measure::ROOT_MEAN_SQUARE_U ? most_vertices_of_long_search
                                                                                         : 2 * most_vertices_of_long_search;
    return !options.has_bound() && number_of_inner_vertices(t) >= few_vertices;
  }

  // Makes the model of the surface given. Returns whether that is possible.
  bool begin()
  {
    Triangulation delaunay = t_;
    std::vector<Index> broken_faces;
    make_intrinsic_delaunay(delaunay, broken_faces, [](Index) {});
    return make_level(delaunay, Vertex_vector(t_.number_of_vertices(), 0.));
  }

  // The same of a metric that was found; the double of a surface is none.
  bool go_on_from(const Conformal_metric<NT>& metric)
  {
    if(metric.is_doubled)
      return false;
    Vertex_vector u;
    for(const NT& x : metric.log_scale_factors)
      u.push_back(static_cast<double>(x));
    return make_level(metric.is_retriangulated() ? metric.triangulation : t_, u);
  }

  const std::vector<Index>& places() const { return level_.model->places(); }
  std::size_t number_of_solves() const { return number_of_solves_ + (level_.model ? level_.model->number_of_solves() : 0); }

  // No cones, if the surface can do without.
  bool without_cones(Curved_cones& s)
  {
    if(level_.fit->are_too_few(0))
      return false;
    level_.fit->fit(s);
    return true;
  }

  // As many cones as are asked for; or until the bounds are met in the model, but no more than `most`. `are_final`: whether their angles are kept
  Curved_cones placed(std::size_t most, bool are_final)
  {
    if(!is_begun_coarsely_ || !exchange_levels())
      return placed_here(most);
    Curved_cones s = placed_here(most);
    exchange_levels();
    set_places(s, [&](Index c) { return coarse_->vertex(c); });
    if(are_final)
      improve(s, options_.measure == Cone_measure::ROOT_MEAN_SQUARE_U); // of a mean it costs little to be thorough
    return s;
  }

  // One more cone. Returns whether there is a place.
  bool add(Curved_cones& s)
  {
    level_.fit->set_exponent(2);
    level_.fit->fit(s);
    if(!level_.search->add(s))
      return false;
    improve(s, false);
    return true;
  }

  // Moves the cones, and changes their angles, as long as that makes it better; `thoroughly`: some are put elsewhere, too.
  void improve(Curved_cones& s, bool thoroughly)
  {
    if(options_.measure != Cone_measure::ROOT_MEAN_SQUARE_U)
      improve_maximum(s, thoroughly);
    else
      improve_mean(s, thoroughly);
    level_.model->sharpen(s.cones);
    Curved_cones anew = s;
    anew.curvatures.resize(0); // what was found with blunt columns may be no good place to begin
    level_.fit->fit(anew);
    level_.fit->fit(s);
    if(anew.value < s.value)
      s = std::move(anew);
  }

  // Makes the curvatures multiples of 2 pi / n, and moves the cones with these. Returns whether there are such curvatures.
  bool quantize(Curved_cones& s, long n)
  {
    const std::size_t most = (std::max)(s.cones.size(), (std::min)(options_.number_of_cones, places().size()));
    return (is_begun_coarsely_ && quantize_coarsely(s, n, most)) || quantized(n).quantize(s, most);
  }

  // The same with multiples already.
  void improve_quantized(Curved_cones& s, long n) { quantized(n).improve(s, s.cones.size() + s.flattened.size()); }

  // The best curvatures for the places of `s`.
  Eigen::VectorXd best_curvatures(const Curved_cones& s)
  {
    Curved_cones best = s;
    best.curvatures.resize(0);
    level_.model->sharpen(best.cones);
    level_.fit->fit(best);
    return best.curvatures;
  }

  // What is aimed at, as the model foresees it.
  double measure(const Curved_cones& s) const { return measure_of(options_.measure, u_of(s)); }

  // u of the surface
  Vertex_vector u_of(const Curved_cones& s) const
  {
    Vertex_vector u(s.u.data(), s.u.data() + s.u.size());
    if(!is_closed_)
      for(double& x : u)
        x += s.shift;
    return u;
  }

private:
  static constexpr std::size_t most_vertices_of_long_search = 20000; // where a solution costs little
  static constexpr double vertices_of_coarse_surface = 8000; // about: where it costs next to nothing
  static constexpr int decisive_exponent = 8; // of two beginnings the better one is known here, and some cones are put elsewhere
  static constexpr int largest_exponent = 128; // a million vertices: n^{1/128} = 1.11, and far less where |u| is nearly equal at many

  // A model of a surface, and what searches for cones there; parts refer to one another.
  struct Level
  {
    std::unique_ptr<Cone_model> model;
    std::unique_ptr<Cone_fit> fit;
    std::unique_ptr<Sparse_cones> search;
    Eigen::VectorXd area; // by vertex, of one whole
  };

  // Of the surface with the lengths of `t` scaled by u.
  bool make_level(const Triangulation& t, const Vertex_vector& u)
  {
    if(level_.model)
      number_of_solves_ += level_.model->number_of_solves();
    level_ = Level();
    other_level_ = Level();
    coarse_.reset();
    Cone_surface surface;
    if(!make_cone_surface(t, u, surface))
      return false;
    add_room_for(t_, surface);
    return make_level(std::move(surface), area_, weights_for_maximum(), make_factorization_(), level_);
  }

  bool make_level(Cone_surface surface, const Eigen::VectorXd& area, const Eigen::VectorXd& weights_for_maximum,
                  std::unique_ptr<Factorization> factorization, Level& level) const
  {
    level.model = std::make_unique<Cone_model>(std::move(surface), euler_characteristic_, std::move(factorization));
    if(!level.model->factorize())
      return false;
    const bool is_mean = options_.measure == Cone_measure::ROOT_MEAN_SQUARE_U;
    level.area = area;
    level.fit = std::make_unique<Cone_fit>(*level.model, is_mean ? area : weights_for_maximum, options_.measure != Cone_measure::MAXIMUM_U);
    level.search = std::make_unique<Sparse_cones>(*level.model, *level.fit, width_);
    return true;
  }

  bool is_large() const { return places().size() >= most_vertices_of_long_search; }

  // Goes on with the coarse surface, where a search costs little and can be thorough; or back again. Returns whether there is a good one.
  bool exchange_levels()
  {
    const std::size_t few_vertices = 1000 + 20 * options_.number_of_cones;
    if(!coarse_)
    {
      const bool is_mean = options_.measure == Cone_measure::ROOT_MEAN_SQUARE_U, is_quantized = options_.angle_quantum > 0;
      const double fineness = is_mean || is_quantized ? 2 : 1; // means cost less, and multiples cannot make up for places that are not quite right
      const std::size_t radius = std::size_t(std::sqrt(double(places().size()) / (fineness * vertices_of_coarse_surface)));
      coarse_ = std::make_unique<Coarse_surface>(level_.model->surface(), radius, !is_mean);
      is_coarse_good_ = coarse_->surface().number_of_vertices() >= few_vertices
        && make_level(coarse_->surface(), coarse_->sums(area_), coarse_->sums(weights_for_maximum()), make_coarse_factorization_(), other_level_);
    }
    if(is_coarse_good_)
      std::swap(level_, other_level_);
    return is_coarse_good_;
  }

  // The cones are at the images of their places; u is not known there.
  template <typename Image>
  static void set_places(Curved_cones& s, const Image& image)
  {
    for(Index& c : s.cones)
      c = image(c);
    for(Index& c : s.flattened)
      c = image(c);
    s.u.resize(0);
  }

  // The same as quantize() on the coarse surface, from there and from where the mean of u is least; what is better is moved on the surface given.
  bool quantize_coarsely(Curved_cones& s, long n, std::size_t most)
  {
    if(!exchange_levels())
      return false;
    std::vector<Curved_cones> starts(1, s);
    set_places(starts[0], [&](Index c) { return coarse_->coarse_vertex(c); });
    std::vector<Index> places = starts[0].cones;
    std::sort(places.begin(), places.end());
    if(std::adjacent_find(places.begin(), places.end()) != places.end())
      starts.clear();
    if(options_.measure != Cone_measure::ROOT_MEAN_SQUARE_U || starts.empty())
    {
      starts.push_back(placed_for_mean(s.cones.size()));
      starts.push_back(starts.back());
      approach_maximum(starts.back(), decisive_exponent / 2, decisive_exponent);
      place_with_zero_u(s.cones.size(), starts);
    }
    std::vector<Curved_cones> found;
    for(Curved_cones& trial : starts)
      if(quantized(n).quantize(trial, most))
        found.push_back(std::move(trial));
    keep_best_of_each(found);
    exchange_levels();
    return quantize_from(found, s, n, most);
  }

  // Moves on the surface given what was found on the coarse one, the best first; the best of it goes on.
  bool quantize_from(std::vector<Curved_cones>& found, Curved_cones& s, long n, std::size_t most)
  {
    const std::size_t most_starts = 2; // each costs a few rounds on the surface given
    Curved_cones best;
    for(std::size_t i = 0; i < (std::min)(found.size(), most_starts); ++i)
    {
      Curved_cones& trial = found[i];
      set_places(trial, [&](Index c) { return coarse_->vertex(c); });
      move_quantized(trial, n);
      if(best.u.size() == 0 || measure(trial) < measure(best))
        best = std::move(trial);
    }
    if(best.u.size() == 0)
      return false;
    quantized(n).improve(best, most);
    s = std::move(best);
    return true;
  }

  // In ascending order of what they measure, and no places twice.
  void keep_best_of_each(std::vector<Curved_cones>& found) const
  {
    std::stable_sort(found.begin(), found.end(), [&](const Curved_cones& x, const Curved_cones& y) { return measure(x) < measure(y); });
    std::vector<Curved_cones> result;
    for(Curved_cones& x : found)
      if(std::none_of(result.begin(), result.end(), [&](const Curved_cones& y) { return are_same(x, y); }))
        result.push_back(std::move(x));
    found.swap(result);
  }

  // Are there the same cones, with the same curvatures?
  static bool are_same(const Curved_cones& x, const Curved_cones& y)
  {
    std::vector<std::pair<Index, double> > a, b;
    for(std::size_t i = 0; i < x.cones.size(); ++i)
      a.emplace_back(x.cones[i], x.curvatures[Eigen::Index(i)]);
    for(std::size_t i = 0; i < y.cones.size(); ++i)
      b.emplace_back(y.cones[i], y.curvatures[Eigen::Index(i)]);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
  }

  // Where a round costs much there are few of them.
  void move_quantized(Curved_cones& s, long n) { quantized(n).move(s, decisive_exponent, 4, 6); }

  Curved_cones placed_for_mean(std::size_t most)
  {
    Curved_cones s;
    fit_for_mean(s);
    while(s.cones.size() < most && visitor_.go_further() && search_another_for_mean(s)) {}
    improve_mean(s, true);
    return s;
  }

  // As in section 5.1 of the paper, to first order: where |u| is largest, again and again, the oldest cone being taken away when there are enough.
  // Adds the last cones, and those with the least of the largest |u| on the way.
  void place_with_zero_u(std::size_t n, std::vector<Curved_cones>& starts)
  {
    const std::size_t n_sweeps = 6;
    Curved_cones s, best;
    s.u = level_.model->flat();
    for(std::size_t i = 0; i < n_sweeps * n; ++i)
    {
      if(s.cones.size() == n)
        s.cones.erase(s.cones.begin());
      s.cones.push_back(worst_place(s));
      set_zero_u(s);
      if(s.cones.size() == n && s.largest() < best.largest())
        best = s;
    }
    starts.push_back(std::move(best));
    starts.push_back(std::move(s));
  }

  // The place of the largest |u| that is no cone. \pre there is one
  Index worst_place(const Curved_cones& s) const
  {
    Index result = places().front();
    double most = -1;
    for(Index v : places())
      if(std::abs(s.u[v]) > most && !s.has(v))
      {
        most = std::abs(s.u[v]);
        result = v;
      }
    return result;
  }

  // The curvatures with which u = 0 at the cones.
  void set_zero_u(Curved_cones& s)
  {
    const Eigen::Index n = Eigen::Index(s.cones.size()), size = n + (is_closed_ ? 1 : 0);
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
    for(Eigen::Index i = 0; i < n; ++i)
    {
      const Index c = s.cones[std::size_t(i)];
      for(Eigen::Index j = 0; j < n; ++j)
        m(i, j) = (*level_.model->column(s.cones[std::size_t(j)]))[c];
      m(i, i) += level_.model->excess(c, 0).second;
      b[i] = -level_.model->flat()[c];
    }
    if(is_closed_)
    {
      m.col(n).head(n).setConstant(-1);
      m.row(n).head(n).setOnes();
      b[n] = level_.model->total_curvature();
    }
    const Eigen::VectorXd x = dense_solution(m, b);
    s.curvatures = x.head(n);
    s.shift = is_closed_ ? x[n] : 0;
    s.u = level_.model->flat().array() - s.shift;
    for(Eigen::Index j = 0; j < n; ++j)
      s.u += x[j] * *level_.model->column(s.cones[std::size_t(j)]);
  }

  void fit_for_mean(Curved_cones& s)
  {
    level_.fit->set_exponent(2);
    level_.fit->fit(s);
  }

  // One more cone. Returns whether there is a place.
  bool search_another_for_mean(Curved_cones& s)
  {
    level_.fit->set_exponent(2);
    if(!level_.search->add(s))
      return false;
    level_.search->slide(s, 2);
    return true;
  }

  Curved_cones placed_here(std::size_t most)
  {
    Curved_cones s;
    most = (std::min)(most, places().size());
    if(options_.number_of_cones > 0)
      most = (std::min)(most, options_.number_of_cones);
    fit_for_mean(s);
    for(std::size_t next_look = 0; s.cones.size() < most && visitor_.go_further(); )
    {
      if(s.cones.size() >= next_look && options_.has_bound() && !level_.fit->are_too_few(s.cones.size()))
      {
        Curved_cones trial = s;
        if(is_near_bounds(trial) && (improve(trial, true), meets_bounds(trial)))
          return trial;
        next_look = s.cones.size() + 1 + s.cones.size() / 8; // a look costs as much as some cones
      }
      if(!search_another_for_mean(s))
        break;
      visitor_.on_progress(Stage::PLACE, s.cones.size(), measure(s));
    }
    improve(s, true);
    return s;
  }

  // Areas are what counts for means; a maximum is to be seen at small triangles, too.
  Eigen::VectorXd weights_for_maximum() const
  {
    Eigen::VectorXd result = area_;
    std::size_t n = 0;
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      n += t_.is_isolated_vertex(v) ? 0 : 1;
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(!t_.is_isolated_vertex(v))
        result[v] = (result[v] + 1 / double(n)) / 2;
    return result;
  }

  Quantized_cones quantized(long n)
  {
    return Quantized_cones(*level_.model, *level_.fit, *level_.search, [this](const Curved_cones& s) { return measure(s); }, n,
                               options_.measure == Cone_measure::ROOT_MEAN_SQUARE_U ? 2 : largest_exponent);
  }

  void improve_mean(Curved_cones& s, bool thoroughly)
  {
    level_.fit->set_exponent(2);
    level_.fit->fit(s);
    level_.search->slide(s, 10);
    if(thoroughly && level_.search->exchange(s, 2 * int(s.cones.size())))
      level_.search->slide(s, 10);
  }

  // From where the mean is small, and from where it is smaller yet: either may be the better place to begin.
  void improve_maximum(Curved_cones& s, bool thoroughly)
  {
    Curved_cones other = s;
    const bool is_small = !is_large();
    if(thoroughly)
    {
      level_.fit->set_exponent(2);
      level_.fit->fit(s);
      level_.search->slide(s, 10);
      other = s;
      if(is_small)
        improve_mean(other, true);
    }
    if(!thoroughly)
      return approach_maximum(s, 4 * decisive_exponent, largest_exponent);
    const int first = is_small ? decisive_exponent / 2 : decisive_exponent;
    approach_maximum(s, first, decisive_exponent);
    if(other.cones != s.cones)
    {
      approach_maximum(other, first, decisive_exponent);
      if(measure(other) < measure(s))
        s = std::move(other);
    }
    level_.fit->set_exponent(decisive_exponent);
    level_.fit->fit(s);
    level_.search->exchange(s, is_small ? 3 : 1);
    approach_maximum(s, is_small ? 2 * decisive_exponent : 4 * decisive_exponent, largest_exponent);
  }

  // By p-norms of larger and larger p. The best on the way is kept.
  void approach_maximum(Curved_cones& s, int first, int last)
  {
    Curved_cones best;
    double least = std::numeric_limits<double>::infinity();
    const bool is_small = !is_large();
    for(int p = first; p <= last && visitor_.go_further(); p *= p <= 2 * decisive_exponent ? 2 : 4)
    {
      level_.fit->set_exponent(p);
      level_.fit->fit(s);
      level_.search->slide(s, is_small ? 6 : 3);
      const double now = measure(s);
      visitor_.on_progress(Stage::PLACE, s.cones.size(), now);
      if(now < least)
      {
        least = now;
        best = s;
      }
    }
    if(!best.cones.empty())
      s = std::move(best);
  }

  // Is it worth while to look?
  bool is_near_bounds(const Curved_cones& s) const
  {
    const Vertex_vector u = u_of(s);
    return (!(options_.maximum_u > 0) || root_mean_square(level_.area, u) <= options_.maximum_u)
        && (!(options_.maximum_area_distortion > 1) || 2 * root_mean_square(level_.area, u) <= std::log(options_.maximum_area_distortion))
        && (!(options_.maximum_root_mean_square > 0) || root_mean_square(level_.area, u) <= 1.1 * options_.maximum_root_mean_square);
  }

  bool meets_bounds(const Curved_cones& s) const
  {
    const Vertex_vector u = u_of(s);
    return (!(options_.maximum_u > 0) || measure_of(Cone_measure::MAXIMUM_U, u) <= options_.maximum_u)
        && (!(options_.maximum_area_distortion > 0) || measure_of(Cone_measure::AREA_DISTORTION, u) <= options_.maximum_area_distortion)
        && (!(options_.maximum_root_mean_square > 0)
            || measure_of(Cone_measure::ROOT_MEAN_SQUARE_U, u) <= options_.maximum_root_mean_square);
  }

  double measure_of(Cone_measure what, const Vertex_vector& u) const
  {
    return what == Cone_measure::ROOT_MEAN_SQUARE_U ? root_mean_square(level_.area, u)
         : what == Cone_measure::AREA_DISTORTION    ? area_distortion_of_vertices(level_.area, u)
                                                    : largest_entry(u);
  }

  const Triangulation& t_;
  const Cone_options options_;
  const Factorization_maker make_factorization_;
  const Factorization_maker make_coarse_factorization_; // which must not be shared with the other
  const Any_visitor visitor_; // may end every search: what has been found counts
  const double euler_characteristic_;
  const bool is_closed_;
  const bool is_begun_coarsely_;
  const Eigen::VectorXd area_; // by vertex, of one whole
  const double width_;         // the square root of the area of the surface
  Level level_;
  std::unique_ptr<Coarse_surface> coarse_; // of its surface, once it was asked for
  bool is_coarse_good_ = false;
  Level other_level_;                      // the coarse one, or, while that is searched, the one given
  std::size_t number_of_solves_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_CHOOSER_H
