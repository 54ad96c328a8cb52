// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Texture rectification (section 6 of Springborn, Schroeder and Pinkall, 2008): a flat layout whose cones have multiples of 2 pi / n is
// deformed, as little as possible, until its cones are lattice points, and the motions across its cut symmetries of the lattice.
//
// What can be admitted is in position_lattice.h, what is chosen in Position_choice.h, how the layout follows in Laplace_layout.h, and how
// seams become exact in Seamless_layout.h.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_RECTIFICATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_RECTIFICATION_H

#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Laplace_layout.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Meta_polygon.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Normalized_layout.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Position_choice.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Quantized_cone.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Rectified_layout.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Seamless_layout.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/mean_factor.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/position_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Rectification_options
{
  double number_of_tiles = 0;        // 0: as few as the distortion allows
  double maximum_distortion = 1.02;
  bool is_lattice_coordinates = false;
  Any_visitor visitor;               // is told the positions that are tried, and may stop the search
};

// `NT` is `double`: it is a template so that it can be compiled once (compiled.h).
template <typename NT>
class Rectification
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef std::complex<double> Complex;
  typedef Lattice_coordinates<std::int64_t> Lattice_point;
  typedef Position_choice::Coefficients Coefficients;
  typedef Position_choice::Candidate Candidate;
  typedef Seamless_layout::Motions Motions;
  typedef Seamless_layout::Positions Positions;

public:
  // `flat` is the layout of one surface. Keeps references.
  Rectification(const Triangulation& t, const Cut_graph& cut, const Layout<NT>& flat, const std::vector<Quantized_cone>& cones,
                const Texture_lattice& lattice, const Rectification_options& options, std::unique_ptr<Factorization> factorization);
  ~Rectification();

  Rectification(const Rectification&) = delete;
  Rectification& operator=(const Rectification&) = delete;

  // Can be called once. The caller may take the result away.
  Rectified_layout& run();

  // ---- For tests and comparisons

  const Rectified_layout& result() const { return result_; }
  const Meta_polygon& polygon() const { return polygon_; }
  const Position_lattice& positions() const { return positions_; }
  const Position_choice& choice() const { return *choice_; } // if the lattice of positions has a rank

  // The Laplace layout for any coefficients: by vertex, in its first corner; lengths are in units of the root of the area.
  std::vector<Complex> laplace_layout(const Coefficients& x)
  {
    return (*laplace_)(data(choice_->plane_positions(x)));
  }

  // The corners of the normalized layout.
  const std::vector<Complex>& normalized_corners() const { return normalized_->corners(); }

private:
  // A layout with positive triangles, and what it was made with.
  struct Found
  {
    bool is_any = false;
    Layout<double> layout;
    Tiling tiling;                               // how much was deformed
    std::vector<Lattice_point> cone_positions, translation_of_path;
    Complex scale = 1;                           // by which the normalized layout was turned and scaled
  };

  void find()
  {
    if(polygon_.status != Status::OK)
    {
      result_.status = polygon_.status;
      result_.amount = polygon_.amount;
      result_.edges = polygon_.edges;
      return;
    }
    normalized_ = std::make_unique<Normalized_layout>(t_, flat_, cones_, lattice_, polygon_);
    if(!untangle_flat())
      return refuse_inverted();
    positions_ = position_lattice(polygon_, cones_.size(), lattice_);
    if(!positions_.fits)
      result_.status = Status::NOT_REPRESENTABLE;
    else if(positions_.rank() == 0)
      scale_only();
    else
      search();
  }

  void search()
  {
    options_.visitor.on_stage(Stage::POSITIONS);
    if(find_choice())
      deform();
    else
      result_.status = is_stopped_ ? Status::STOPPED_BY_VISITOR : Status::SINGULAR_PROBLEM;
  }

  // Asks the visitor, once more unless it has stopped the search before.
  bool is_to_stop()
  {
    is_stopped_ = is_stopped_ || !options_.visitor.go_further();
    return is_stopped_;
  }

  // ---- The flat layout

  const Complex& flat_corner(Index h) const { return (*normalized_)[h]; }

  // Straight triangles of the layout that are inverted, as where edges were flipped, are mended first.
  bool untangle_flat()
  {
    std::vector<Lattice_coordinates<double> > translations;
    for(const auto& path : polygon_.paths)
      translations.push_back(lattice_.from_plane(path.translation));
    flat_z_.assign(t_.number_of_vertices(), Lattice_coordinates<double>{{0, 0}});
    for(Index v = 0; v < flat_z_.size(); ++v)
      if(!t_.is_isolated_vertex(v))
        flat_z_[v] = lattice_.from_plane(flat_corner(polygon_.first_corner[v]));
    bool is_positive = true;
    for(Index f = 0; f < t_.number_of_faces() && is_positive; ++f)
      is_positive = is_flat_positive(f);
    Layout<double> ignored;
    return is_positive || seamless_(polygon_.values(translations), flat_z_, ignored);
  }

  bool is_flat_positive(Index f) const { return is_left_turn(flat_.corner[3 * f], flat_.corner[3 * f + 1], flat_.corner[3 * f + 2]); }

  // The layout turned and scaled.
  Positions scaled_flat(const Complex& s) const
  {
    Positions z(flat_z_.size());
    for(std::size_t v = 0; v < z.size(); ++v)
      z[v] = lattice_.from_plane(s * lattice_.to_plane(flat_z_[v]));
    return z;
  }

  // ---- Energy

  Laplace_layout::Data data(const Coefficients& positions) const
  {
    Laplace_layout::Data result;
    std::vector<Lattice_coordinates<double> > translations;
    for(std::size_t p = 0; p < polygon_.paths.size(); ++p)
      translations.push_back(lattice_.from_plane(positions(cones_.size() + p)));
    for(const auto& motion : polygon_.values(translations))
      result.translation.push_back(lattice_.to_plane(motion.translation));
    result.fixed.assign(positions.data(), positions.data() + cones_.size());
    if(result.fixed.size() < fixed_.size())
      result.fixed.push_back(0);
    return result;
  }

  // Sets up the Laplace layout, and the choice among positions with its energy.
  bool find_choice()
  {
    Coefficients flat_positions(cones_.size() + polygon_.paths.size());
    for(std::size_t i = 0; i < cones_.size(); ++i)
      flat_positions(i) = flat_corner(polygon_.first_corner[cones_[i].vertex]);
    for(std::size_t p = 0; p < polygon_.paths.size(); ++p)
      flat_positions(cones_.size() + p) = polygon_.paths[p].translation;

    for(const Quantized_cone& cone : cones_)
      fixed_.push_back(cone.vertex);
    bool is_turned = !cones_.empty();
    for(const auto& path : polygon_.paths)
      is_turned = is_turned || path.quanta != 0;
    if(!is_turned)
      fixed_.push_back(t_.target(0));
    laplace_ = std::make_unique<Laplace_layout>(t_, normalized_->corners(), polygon_, lattice_, fixed_, std::move(factorization_));
    if(!laplace_->factorize())
      return false;
    choice_ = std::make_unique<Position_choice>(positions_, lattice_, flat_positions, [&](const Eigen::MatrixXcd& basis) { return energy(basis); });
    return choice_->is_valid();
  }

  // The Hermitian form of the energies for positions that are combinations of the columns; not finite where these cannot be found.
  Eigen::MatrixXcd energy(const Eigen::MatrixXcd& basis)
  {
    const Eigen::Index r = basis.cols();
    std::vector<std::vector<Complex> > forces(r), responses(r);
    for(Eigen::Index j = 0; j < r; ++j)
    {
      const Laplace_layout::Data d = data(basis.col(j));
      const std::vector<Complex> z = is_to_stop() ? std::vector<Complex>() : (*laplace_)(d);
      if(z.empty())
        return Eigen::MatrixXcd::Constant(r, r, std::numeric_limits<double>::quiet_NaN());
      forces[j] = laplace_->forces(d);
      responses[j] = laplace_->responses(d, z);
    }
    Eigen::MatrixXcd result(r, r);
    for(Eigen::Index i = 0; i < r; ++i)
      for(Eigen::Index j = 0; j < r; ++j)
      {
        Complex sum = 0;
        for(std::size_t k = 0; k < forces[i].size(); ++k)
          sum += std::conj(forces[i][k]) * responses[j][k];
        result(i, j) = sum;
      }
    return (result + result.adjoint()) / 2.;
  }

  // ---- Choice

  void deform()
  {
    if(options_.number_of_tiles > 0)
      deform_to_number_of_tiles();
    else
      deform_within_bound();
  }

  // If triangles are inverted whatever candidate is taken, on a finer grid.
  void deform_to_number_of_tiles()
  {
    const std::size_t most_tried = 6; // of about eight rotations that are aimed at, and their second best
    const int most_refinements = 8;   // as triangles that are inverted with 256 times as many tiles are so because of the layout, not of the grid
    for(int finer = 0; finer < most_refinements && !is_to_stop(); ++finer)
    {
      const std::vector<Candidate> c = choice_->candidates(std::ldexp(options_.number_of_tiles, finer));
      const auto is_found = [&]
      {
        for(std::size_t i = 0; i < c.size() && i < most_tried; ++i)
          if(try_candidate(c[i]))
          {
            prove(c[i]);
            return true;
          }
        return false;
      };
      if(is_found_strictly_or_not(is_found))
        return;
    }
    refuse();
  }

  // As few tiles as the bound on the mean distortion allows.
  void deform_within_bound()
  {
    Found best; // of those beyond the bound
    if(is_found_strictly_or_not([&] { return search_within_bound(best); }))
      return;
    if(is_stopped_ || !best.is_any)
      return refuse();
    found_ = std::move(best);
    result_.status = Status::BOUND_NOT_MET;
    result_.amount = found_.tiling.mean_distortion;
  }

  // Triangles that go around a vertex once too often are better than nothing. Unless some were refused for that, the same search finds the same.
  template <typename Search>
  bool is_found_strictly_or_not(const Search& is_found)
  {
    seamless_.set_strict(true);
    if(is_found())
      return true;
    if(is_stopped_ || !seamless_.has_refused_wound())
      return false;
    seamless_.set_strict(false);
    return is_found();
  }

  // Returns whether the bound is met; `best` is the layout of least distortion beyond it, one without wound vertices if there is one.
  bool search_within_bound(Found& best)
  {
    const std::size_t most_tried = 2; // the next number of tiles comes soon
    const double most_tiles = 1e9;    // so that lattice points stay far below the range in which seams are exact
    const bool is_any_strict = best.is_any;
    for(double tiles = 1; tiles < most_tiles && !is_to_stop(); tiles *= std::sqrt(2.))
    {
      const std::vector<Candidate> c = choice_->candidates(tiles);
      for(std::size_t i = 0; i < c.size() && i < most_tried; ++i)
      {
        if(choice_->expected_distortion(choice_->complex_coefficients(c[i].coefficients)) > most_expected_distortion())
          break;
        if(!try_candidate(c[i]))
          continue;
        if(is_within_bound(found_))
        {
          prove_within_bound(c[i]);
          return true;
        }
        if(!best.is_any || (!is_any_strict && found_.tiling.mean_distortion < best.tiling.mean_distortion))
          best = found_;
      }
    }
    return false;
  }

  // What is closer to what was aimed at need not meet the bound.
  void prove_within_bound(const Candidate& taken)
  {
    Found first = found_;
    prove(taken);
    if(!is_within_bound(found_))
      found_ = std::move(first);
  }

  // Looks longer than before for positions closer to what was aimed at than those that were taken; most often proves that there are none. If that is
  // not to be waited for, what was found is kept without a proof.
  void prove(const Candidate& taken)
  {
    if(taken.is_closest || is_to_stop())
      return;
    const Candidate closest = choice_->closest(taken);
    if(closest.coefficients == taken.coefficients)
      found_.tiling.is_closest = closest.is_closest;
    else
      try_candidate(closest); // what is there is kept if this one inverts triangles
  }

  // The expected distortion is seldom below the true mean, and not by half as much again: what is above this is not worth a try.
  double most_expected_distortion() const { return 1 + 1.5 * (options_.maximum_distortion - 1) + 1e-12; }

  // A layout that need not be deformed has a mean distortion of 1, up to rounding.
  bool is_within_bound(const Found& f) const { return f.tiling.mean_distortion <= (std::max)(options_.maximum_distortion, 1 + 1e-9); }

  void refuse()
  {
    if(is_stopped_)
      result_.status = Status::STOPPED_BY_VISITOR;
    else
      refuse_inverted();
  }

  void refuse_inverted()
  {
    result_.status = Status::NOT_INJECTIVE;
    result_.faces = seamless_.inverted();
    std::sort(result_.faces.begin(), result_.faces.end());
    result_.faces.erase(std::unique(result_.faces.begin(), result_.faces.end()), result_.faces.end());
  }

  // ---- Positions

  // Returns whether all triangles are positive.
  bool try_candidate(const Candidate& c)
  {
    if(is_to_stop())
      return false;
    options_.visitor.on_progress(Stage::POSITIONS, ++number_of_tried_, std::norm(c.s) / lattice_.area_of_tile());
    const Coefficients x = choice_->complex_coefficients(c.coefficients);
    const Complex s = choice_->scale_of(x);
    const std::vector<Complex> moved = (*laplace_)(data(choice_->plane_positions(x - s * choice_->flat_coefficients())));
    if(moved.empty())
      return false;
    const std::vector<Lattice_point> positions = choice_->integral_positions(c.coefficients);
    Positions z = scaled_flat(s), unmended(z.size());
    for(std::size_t v = 0; v < z.size(); ++v)
    {
      const Lattice_coordinates<double> by = lattice_.from_plane(moved[v]);
      z[v] = {{z[v][0] + by[0], z[v][1] + by[1]}};
      if(!t_.is_isolated_vertex(Index(v)))
        unmended[v] = lattice_.from_plane(s * flat_corner(polygon_.first_corner[v]) + moved[v]);
    }
    const Motions motion = motions(positions);
    if(!finish(std::move(z), positions, motion, s))
      return false;
    const Mean_factor deformation = deformation_factor(motion, unmended);
    found_.tiling.is_closest = c.is_closest;
    found_.tiling.mean_distortion = deformation.mean;
    found_.tiling.maximum_distortion = deformation.largest;
    return true;
  }

  // The motions across the cut, exactly.
  Motions motions(const std::vector<Lattice_point>& integral) const
  {
    const std::vector<Lattice_point> translation(integral.begin() + cones_.size(), integral.end());
    const std::vector<Meta_polygon::Values<std::int64_t> > exact = polygon_.values(translation);
    Motions result(exact.size());
    for(std::size_t m = 0; m < exact.size(); ++m)
      result[m] = {exact[m].quanta, {{double(exact[m].translation[0]), double(exact[m].translation[1])}}};
    return result;
  }

  // Nothing need be deformed: the scale alone is free.
  void scale_only()
  {
    const double default_number_of_tiles = 64; // any number would do: nothing hangs on it
    const double tiles = options_.number_of_tiles > 0 ? options_.number_of_tiles : default_number_of_tiles;
    const double s = std::sqrt(tiles * lattice_.area_of_tile());
    const std::vector<Lattice_point> origin(cones_.size() + polygon_.paths.size(), Lattice_point{{0, 0}});
    if(!finish(scaled_flat(s), origin, motions(origin), s))
      refuse_inverted();
  }

  // Rounds the positions where motions must be exact, makes the corners, and judges them.
  bool finish(Positions z, const std::vector<Lattice_point>& integral, const Motions& motion, const Complex& s)
  {
    for(std::size_t i = 0; i < cones_.size(); ++i)
      z[cones_[i].vertex] = {{double(integral[i][0]), double(integral[i][1])}};
    Layout<double> result;
    if(!seamless_(motion, z, result))
      return false;
    found_.is_any = true;
    found_.layout = std::move(result);
    found_.cone_positions.assign(integral.begin(), integral.begin() + cones_.size());
    found_.translation_of_path.assign(integral.begin() + cones_.size(), integral.end());
    found_.scale = s;
    CGAL_postcondition(seamless_.is_seamless(motion, z, found_.translation_of_path));
    return true;
  }

  // ---- What is told of the layout that was taken

  void report()
  {
    result_.layout = std::move(found_.layout);
    result_.tiling = found_.tiling;
    result_.cone_positions = found_.cone_positions;
    result_.layout.length_error = flat_.length_error;
    result_.tiling.number_of_wound_vertices = seamless_.wound_vertices(result_.layout).size();
    find_transitions();
    measure();
  }

  void find_transitions()
  {
    for(Index e = 0; e < t_.number_of_edges(); ++e)
    {
      const Index h = t_.edge_halfedge(e);
      if(!cut_[e] || t_.is_border(h))
        continue;
      const auto motion = polygon_.after(Meta_polygon::Values<std::int64_t>(), polygon_.crossing(h), found_.translation_of_path);
      const Complex rotation = lattice_.rotation(motion.quanta), by = lattice_.to_plane(motion.translation);
      result_.layout.transitions.push_back({h, {{rotation.real(), rotation.imag()}}, {{by.real(), by.imag()}}});
      result_.quanta.push_back(motion.quanta);
      result_.translations.push_back(motion.translation);
    }
  }

  // ---- Distortion

  void measure()
  {
    result_.tiling.symmetry = lattice_.symmetry();
    result_.tiling.scale = std::abs(found_.scale) / normalized_->unit();
    result_.tiling.rotation = std::remainder(std::arg(found_.scale), 2 * CGAL_PI);
    std::vector<Face_factor> before, after;
    double area = 0;
    for(Index f = 0; f < t_.number_of_faces(); ++f)
    {
      const UV_corners image = uv_corners([&](Index h) { return in_plane(h); }, f);
      const Triangle_frame given = given_frame(t_, f);
      if(!given.is_degenerate())
      {
        const UV_corners flat = uv_corners([&](Index h) { return flat_corner(h); }, f);
        before.push_back({given.area(), quasi_conformal_factor(given, flat)});
        after.push_back({given.area(), quasi_conformal_factor(given, image)});
      }
      area += std::imag(std::conj(in_plane(3 * f + 1) - in_plane(3 * f)) * (in_plane(3 * f + 2) - in_plane(3 * f))) / 2;
    }
    result_.tiling.number_of_tiles = area / lattice_.area_of_tile();
    result_.tiling.mean_factor_before = mean_factor(before).mean;
    result_.tiling.mean_factor = mean_factor(after).mean;
  }

  // Of the map from the flat surface, where its straight triangles are positive.
  Mean_factor deformation_factor(const Motions& motion, const Positions& z) const
  {
    const auto image = [&](Index h) { return lattice_.to_plane(polygon_.apply(motion[polygon_.motion_of_corner[h]], z[t_.target(h)])); };
    std::vector<Face_factor> result;
    for(Index f = 0; f < t_.number_of_faces(); ++f)
    {
      const Triangle_frame given = given_frame(t_, f);
      if(given.is_degenerate() || !is_flat_positive(f))
        continue;
      const double factor = quasi_conformal_factor(plane_frame(normalized_->corners(), f), uv_corners(image, f));
      result.push_back({given.area(), factor});
    }
    return mean_factor(result);
  }

  Complex in_plane(Index h) const
  {
    const auto& p = result_.layout.corner[h];
    return options_.is_lattice_coordinates ? lattice_.to_plane(p) : Complex(p[0], p[1]);
  }

  const Triangulation& t_;
  const Cut_graph& cut_;
  const Layout<NT>& flat_;
  const std::vector<Quantized_cone>& cones_;
  const Texture_lattice lattice_;
  const Rectification_options options_;
  std::unique_ptr<Factorization> factorization_;
  Meta_polygon polygon_;
  Seamless_layout seamless_;

  Rectified_layout result_;
  Found found_;                       // the layout that was found last
  bool is_stopped_ = false;           // by the visitor
  std::size_t number_of_tried_ = 0;   // candidates
  std::unique_ptr<Normalized_layout> normalized_; // set up once the polygon is known to be one
  Positions flat_z_;                  // by vertex, in its first corner: the normalized layout, without inverted triangles
  Position_lattice positions_;
  std::vector<Index> fixed_;
  std::unique_ptr<Laplace_layout> laplace_;
  std::unique_ptr<Position_choice> choice_;
};

template <typename NT>
Rectification<NT>::Rectification(const Triangulation& t, const Cut_graph& cut, const Layout<NT>& flat, const std::vector<Quantized_cone>& cones,
                                 const Texture_lattice& lattice, const Rectification_options& options,
                                 std::unique_ptr<Factorization> factorization)
  : t_(t), cut_(cut), flat_(flat), cones_(cones), lattice_(lattice), options_(options), factorization_(std::move(factorization)),
    polygon_(t, cut, flat, cones, lattice), seamless_(t, polygon_, lattice_, cones, options.is_lattice_coordinates)
{}

template <typename NT>
Rectification<NT>::~Rectification()
{}

template <typename NT>
Rectified_layout& Rectification<NT>::run()
{
  find();
  if(result_.status == Status::OK || result_.status == Status::BOUND_NOT_MET)
    report();
  return result_;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Rectification<double>::Rectification(const Intrinsic_triangulation<double>&, const Cut_graph&, const Layout<double>&,
                                                     const std::vector<Quantized_cone>&, const Texture_lattice&,
                                                     const Rectification_options&, std::unique_ptr<Factorization>);
extern template Rectification<double>::~Rectification();
extern template Rectified_layout& Rectification<double>::run();
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_RECTIFICATION_H
