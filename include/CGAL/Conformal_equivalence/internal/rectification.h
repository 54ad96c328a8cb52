// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Texture rectification (section 6 of Springborn, Schroeder and Pinkall, 2008): a flat layout whose cones have multiples of 2 pi / n is
// deformed, as little as possible, until its cones are lattice points, and the motions across its cut symmetries of the lattice.
//
// The admissible positions are sum x_j b_j with a basis b_j (position_lattice.h) and coefficients x_j in the ring. The paper looks for the
// nearest positions. Here the distance is the conformal energy itself: with the Laplace layouts of the b_j the least energy for any x is the
// Hermitian form x* H x. That of the layout itself, x = x*, is zero, and so is that of all its multiples s x*, by which it is turned and
// scaled. So H knows no scale, and that is chosen: the closest vector to s x* for
//
//     x* H x  +  lambda |alpha(x)|^2,     alpha(x) = the factor by which positions were turned and scaled,
//
// where the small lambda says how much a scale other than s is worth. s is varied: its argument, as the lattice is not round, and its size.
//
// Seams are exact: positions of vertices on the cut are rounded to a grid so coarse that all motions, which are rotations of lattice
// coordinates and integers, are free of rounding.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RECTIFICATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RECTIFICATION_H

#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/internal/Texture_lattice.h>
#include <CGAL/Conformal_equivalence/internal/closest_vector.h>
#include <CGAL/Conformal_equivalence/internal/convex_polygon.h>
#include <CGAL/Conformal_equivalence/internal/laplace_layout.h>
#include <CGAL/Conformal_equivalence/internal/meta_polygon.h>
#include <CGAL/Conformal_equivalence/internal/position_lattice.h>
#include <CGAL/Conformal_equivalence/internal/relaxation.h>

#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
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

/// \ingroup PkgConformalEquivalenceEnums
/// The coordinates in which a seamless layout is given.
enum class Seamless_coordinates
{
  CARTESIAN, ///< of the plane, a tile having the side 1 (squares), or its neighbors at the distance 1 (hexagons)
  LATTICE    ///< (a, b) for a + b theta, see `Tiling`: for n = 2 and 4 the same; for n = 3 and 6 the coordinates in which seams are exact
};

namespace internal {

struct Rectification_options
{
  double number_of_tiles = 0;        // 0: as few as the distortion allows
  double maximum_distortion = 1.02;
  bool is_lattice_coordinates = false;
};

// The mean and the largest quasi-conformal factor of maps of the faces.
struct Mean_factor
{
  double mean = 1, largest = 1;
};

template <typename SolverTraits>
class Rectification
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<double> Triangulation;
  typedef std::complex<double> Complex;
  typedef Lattice_coordinates<std::int64_t> Lattice_point;
  typedef Laplace_layout<double, SolverTraits> Laplace;
  typedef Eigen::VectorXcd Coefficients;

public:
  Status status = Status::OK;         // BOUND_NOT_MET: the layout is there nevertheless
  double amount = 0;
  std::vector<Index> edges, faces;    // at fault

  Layout<double> layout;
  Tiling tiling;
  std::vector<Lattice_point> cone_positions;       // in the first corners
  std::vector<int> quanta;                         // by transition of `layout`
  std::vector<Lattice_point> translations;         // by transition of `layout`

  // `flat` is the layout of one surface. Keeps references.
  Rectification(const Triangulation& t, const Cut_graph& cut, const Layout<double>& flat, const std::vector<Quantized_cone>& cones,
                const Texture_lattice& lattice, const Rectification_options& options, const SolverTraits& traits)
    : t_(t), cut_(cut), flat_(flat), cones_(cones), lattice_(lattice), options_(options), traits_(traits),
      polygon_(t, cut, flat, cones, lattice)
  {
    if(polygon_.status != Status::OK)
    {
      status = polygon_.status;
      amount = polygon_.amount;
      edges = polygon_.edges;
      return;
    }
    normalize();
    if(!untangle_flat())
    {
      refuse_inverted();
      return;
    }
    positions_ = position_lattice(polygon_, cones.size(), lattice);
    if(!positions_.fits)
      status = Status::NOT_REPRESENTABLE;
    else if(positions_.rank() == 0)
      scale_only();
    else if(find_energy())
      deform();
    else
      status = Status::SINGULAR_PROBLEM;
  }

  // ---- For tests and comparisons

  const Meta_polygon& polygon() const { return polygon_; }
  const Position_lattice& positions() const { return positions_; }
  const Eigen::MatrixXcd& energy() const { return energy_; }
  const Coefficients& flat_coefficients() const { return flat_coefficients_; }
  double square_unit() const { return unit_ * unit_; }

  // The part of the energy that is left of the area, for coefficients x.
  double relative_energy(const Coefficients& x) const
  {
    return (x.adjoint() * energy_ * x)(0).real() / std::norm(scale_of(x));
  }

  // The Laplace layout for any coefficients: by vertex, in its first corner; lengths are in units of the root of the area.
  std::vector<Complex> laplace_layout(const Coefficients& x)
  {
    return laplace()(data(plane_positions(x)));
  }

  // The corners of the flat layout, with its area 1 and the first cone in the origin.
  const std::vector<Complex>& normalized_corners() const { return corner_; }

  // The rounding of the paper: as many cones as are independent go to the nearest lattice points, and the rest follows.
  // Returns false if the coefficients then are not in the ring.
  bool round_independent_cones(const Complex& scale, Coefficients& x) const
  {
    const std::size_t r = positions_.rank();
    Eigen::MatrixXcd independent(0, r);
    Coefficients rounded(0);
    for(Eigen::Index i = 0; i < basis_.rows() && independent.rows() < Eigen::Index(r); ++i)
    {
      Eigen::MatrixXcd more(independent.rows() + 1, r);
      more << independent, basis_.row(i);
      if(Eigen::FullPivLU<Eigen::MatrixXcd>(more).rank() < more.rows())
        continue;
      const Complex z = scale * flat_positions_(i);
      const Lattice_coordinates<double> p = lattice_.from_plane(z);
      Coefficients values(rounded.size() + 1);
      values << rounded, lattice_.to_plane(Lattice_coordinates<double>{{std::round(p[0]), std::round(p[1])}});
      independent = more;
      rounded = values;
    }
    x = Eigen::FullPivLU<Eigen::MatrixXcd>(independent).solve(rounded);
    bool is_integral = true;
    for(std::size_t j = 0; j < r; ++j)
    {
      const Lattice_coordinates<double> p = lattice_.from_plane(x(j));
      const Lattice_coordinates<double> nearest{{std::round(p[0]), std::round(p[1])}};
      is_integral = is_integral && std::abs(p[0] - nearest[0]) < 1e-6 && std::abs(p[1] - nearest[1]) < 1e-6;
      x(j) = lattice_.to_plane(nearest);
    }
    return is_integral;
  }

private:
  // ---- The flat layout

  // Area 1, the first cone in the origin; without a cone, what the first path that turns goes round.
  void normalize()
  {
    corner_.resize(t_.number_of_halfedges());
    double largest = 0;
    for(const auto& p : flat_.corner)
      largest = (std::max)(largest, (std::max)(std::abs(p[0]), std::abs(p[1])));
    int exponent = 0;
    std::frexp(largest, &exponent);
    for(Index h = 0; h < corner_.size(); ++h)
      corner_[h] = Complex(std::scalbn(flat_.corner[h][0], -exponent), std::scalbn(flat_.corner[h][1], -exponent));
    double area = 0;
    for(Index f = 0; f < t_.number_of_faces(); ++f)
      area += std::imag(std::conj(corner_[3 * f + 1] - corner_[3 * f]) * (corner_[3 * f + 2] - corner_[3 * f])) / 2;
    const double side = std::sqrt(area);
    unit_ = std::scalbn(side, exponent);
    for(Complex& z : corner_)
      z /= side;
    for(auto& path : polygon_.paths)
      path.translation = Complex(std::scalbn(path.translation.real(), -exponent), std::scalbn(path.translation.imag(), -exponent)) / side;
    move_origin(origin());
  }

  Complex origin() const
  {
    if(!cones_.empty())
      return corner_[polygon_.first_corner[cones_.front().vertex]];
    for(const auto& path : polygon_.paths)
      if(path.quanta != 0)
        return path.translation / (1. - lattice_.rotation(path.quanta));
    return 0;
  }

  void move_origin(const Complex& origin)
  {
    for(Complex& z : corner_)
      z -= origin;
    for(auto& path : polygon_.paths)
      path.translation += (lattice_.rotation(path.quanta) - 1.) * origin;
  }

  // Straight triangles of the layout that are inverted, as where edges were flipped, are mended first.
  bool untangle_flat()
  {
    std::vector<Lattice_coordinates<double> > translations;
    for(const auto& path : polygon_.paths)
      translations.push_back(lattice_.from_plane(path.translation));
    flat_z_.assign(t_.number_of_vertices(), Lattice_coordinates<double>{{0, 0}});
    for(Index v = 0; v < flat_z_.size(); ++v)
      if(!t_.is_isolated_vertex(v))
        flat_z_[v] = lattice_.from_plane(corner_[polygon_.first_corner[v]]);
    const auto motion = polygon_.values(translations);
    for(Index f = 0; f < t_.number_of_faces(); ++f)
      if(!is_left_turn(flat_.corner[3 * f], flat_.corner[3 * f + 1], flat_.corner[3 * f + 2]))
        inverted_.push_back(f);
    Layout<double> ignored;
    return inverted_.empty() || untangle(motion, flat_z_, ignored);
  }

  // The layout turned and scaled.
  std::vector<Lattice_coordinates<double> > scaled_flat(const Complex& s) const
  {
    std::vector<Lattice_coordinates<double> > z(flat_z_.size());
    for(std::size_t v = 0; v < z.size(); ++v)
      z[v] = lattice_.from_plane(s * lattice_.to_plane(flat_z_[v]));
    return z;
  }

  // ---- Energy

  Laplace& laplace() { return *laplace_; }

  // By number of cone and path, in the plane.
  std::vector<Complex> plane_positions(const Coefficients& x) const
  {
    const Coefficients y = basis_ * x;
    return std::vector<Complex>(y.data(), y.data() + y.size());
  }

  typename Laplace::Data data(const std::vector<Complex>& positions) const
  {
    typename Laplace::Data result;
    std::vector<Lattice_coordinates<double> > translations;
    for(std::size_t p = 0; p < polygon_.paths.size(); ++p)
      translations.push_back(lattice_.from_plane(positions[cones_.size() + p]));
    for(const auto& motion : polygon_.values(translations))
      result.translation.push_back(lattice_.to_plane(motion.translation));
    result.fixed.assign(positions.begin(), positions.begin() + cones_.size());
    if(result.fixed.size() < fixed_.size())
      result.fixed.push_back(0);
    return result;
  }

  // The basis in the plane, the layout's coefficients, and the Hermitian form.
  bool find_energy()
  {
    const std::size_t r = positions_.rank(), m = cones_.size() + polygon_.paths.size();
    basis_.resize(m, r);
    for(std::size_t j = 0; j < r; ++j)
      for(std::size_t i = 0; i < m; ++i)
        basis_(i, j) = lattice_.to_plane(positions_.basis[j][i]);
    flat_positions_.resize(m);
    for(std::size_t i = 0; i < cones_.size(); ++i)
      flat_positions_(i) = corner_[polygon_.first_corner[cones_[i].vertex]];
    for(std::size_t p = 0; p < polygon_.paths.size(); ++p)
      flat_positions_(cones_.size() + p) = polygon_.paths[p].translation;
    flat_coefficients_ = basis_.colPivHouseholderQr().solve(flat_positions_);

    for(const Quantized_cone& cone : cones_)
      fixed_.push_back(cone.vertex);
    bool is_turned = !cones_.empty();
    for(const auto& path : polygon_.paths)
      is_turned = is_turned || path.quanta != 0;
    if(!is_turned)
      fixed_.push_back(t_.target(0));
    laplace_ = std::make_unique<Laplace>(t_, corner_, polygon_, lattice_, fixed_, traits_);
    return laplace().factorize() && find_form();
  }

  bool find_form()
  {
    const std::size_t r = positions_.rank();
    std::vector<std::vector<Complex> > forces(r), responses(r);
    for(std::size_t j = 0; j < r; ++j)
    {
      const typename Laplace::Data d = data(plane_positions(Coefficients::Unit(r, j)));
      const std::vector<Complex> z = laplace()(d);
      if(z.empty())
        return false;
      forces[j] = laplace().forces(d);
      responses[j] = laplace().responses(d, z);
    }
    energy_.resize(r, r);
    for(std::size_t i = 0; i < r; ++i)
      for(std::size_t j = 0; j < r; ++j)
      {
        Complex sum = 0;
        for(std::size_t k = 0; k < forces[i].size(); ++k)
          sum += std::conj(forces[i][k]) * responses[j][k];
        energy_(i, j) = sum;
      }
    energy_ = ((energy_ + energy_.adjoint()) / 2.).eval();
    return energy_.allFinite();
  }

  // alpha(x)
  Complex scale_of(const Coefficients& x) const
  {
    const Coefficients y = basis_ * x;
    return flat_positions_.dot(y) / flat_positions_.squaredNorm();
  }

  // ---- Choice

  struct Candidate
  {
    std::vector<Lattice_point> coefficients;
    Complex s;          // what was aimed at
    double cost;
    bool is_closest;
  };

  // As a real form in the lattice coordinates of the coefficients.
  Eigen::MatrixXd gram() const
  {
    const int r = int(positions_.rank());
    const Eigen::RowVectorXcd alpha = flat_positions_.adjoint() * basis_ / flat_positions_.squaredNorm();
    Eigen::MatrixXcd form = energy_ + weight_of_scale * alpha.adjoint() * alpha;
    form += 1e-13 * form.diagonal().real().sum() / r * Eigen::MatrixXcd::Identity(r, r);
    Eigen::MatrixXcd complex(r, 2 * r);
    complex.setZero();
    for(int j = 0; j < r; ++j)
    {
      complex(j, 2 * j) = 1;
      complex(j, 2 * j + 1) = lattice_.theta();
    }
    return (complex.adjoint() * form * complex).real();
  }

  Eigen::VectorXd real_coefficients(const Coefficients& x) const
  {
    Eigen::VectorXd result(2 * x.size());
    for(int j = 0; j < x.size(); ++j)
    {
      const Lattice_coordinates<double> p = lattice_.from_plane(x(j));
      result(2 * j) = p[0];
      result(2 * j + 1) = p[1];
    }
    return result;
  }

  Coefficients complex_coefficients(const std::vector<Lattice_point>& x) const
  {
    Coefficients result(x.size());
    for(std::size_t j = 0; j < x.size(); ++j)
      result(j) = lattice_.to_plane(x[j]);
    return result;
  }

  // The best ones with about that many tiles, for several rotations.
  std::vector<Candidate> candidates(const Reduced_lattice& reduced, double number_of_tiles) const
  {
    const int number_of_rotations = 8;
    const bool is_enumerated = reduced.dimension() <= most_enumerated_dimensions;
    const double size = std::sqrt(number_of_tiles * lattice_.area_of_tile());
    std::vector<Candidate> result;
    for(int k = 0; k < number_of_rotations; ++k)
    {
      const Complex s = std::polar(size, 2 * CGAL_PI * k / (lattice_.order() * number_of_rotations));
      const Eigen::VectorXd target = real_coefficients(s * flat_coefficients_);
      const std::vector<Lattice_vector> vectors = is_enumerated ? reduced.near(target, 2, most_nodes)
                                                                : std::vector<Lattice_vector>(1, reduced.babai(target));
      for(std::size_t i = 0; i < vectors.size(); ++i)
        add_candidate(vectors[i], s, i == 0 && vectors[i].is_closest, result);
    }
    std::stable_sort(result.begin(), result.end(), [](const Candidate& c, const Candidate& d) { return c.cost < d.cost; });
    return result;
  }

  void add_candidate(const Lattice_vector& v, const Complex& s, bool is_closest, std::vector<Candidate>& result) const
  {
    Candidate c;
    c.coefficients = lattice_points(v);
    c.s = s;
    const Coefficients x = complex_coefficients(c.coefficients);
    const double scale = std::abs(scale_of(x)) / std::abs(s);
    if(!(scale > 0.7 && scale < 1.43)) // far from the number of tiles, or all in one point
      return;
    c.cost = relative_energy(x) + weight_of_scale * (scale - 1) * (scale - 1);
    c.is_closest = is_closest;
    for(Candidate& other : result)
      if(other.coefficients == c.coefficients)
      {
        other.is_closest = other.is_closest || is_closest;
        return;
      }
    result.push_back(std::move(c));
  }

  static std::vector<Lattice_point> lattice_points(const Lattice_vector& v)
  {
    std::vector<Lattice_point> result;
    for(std::size_t j = 0; j + 1 < v.coefficients.size(); j += 2)
      result.push_back({{v.coefficients[j], v.coefficients[j + 1]}});
    return result;
  }

  // Looks longer than before for a vector closer to what was aimed at than the one that was taken; most often proves that there is none.
  void prove(const Reduced_lattice& reduced, Candidate c)
  {
    if(c.is_closest || reduced.dimension() > most_enumerated_dimensions)
      return;
    const Lattice_vector v = reduced.closest(real_coefficients(c.s * flat_coefficients_), most_nodes_of_proof);
    const bool is_same = lattice_points(v) == c.coefficients;
    c.coefficients = lattice_points(v);
    c.is_closest = v.is_closest;
    if(is_same)
      tiling.is_closest = v.is_closest;
    else if(!c.coefficients.empty())
      try_candidate(c); // what is there is kept if this one inverts triangles
  }

  void deform()
  {
    const Reduced_lattice reduced(gram());
    if(!reduced.is_valid())
    {
      status = Status::SINGULAR_PROBLEM;
      return;
    }
    if(options_.number_of_tiles > 0)
      deform_to_number_of_tiles(reduced);
    else
      deform_within_bound(reduced);
  }

  // If triangles are inverted whatever candidate is taken, on a finer grid.
  void deform_to_number_of_tiles(const Reduced_lattice& reduced)
  {
    const std::size_t most_tried = 6;
    for(int finer = 0; finer < 8; ++finer)
    {
      const std::vector<Candidate> c = candidates(reduced, std::ldexp(options_.number_of_tiles, finer));
      for(std::size_t i = 0; i < c.size() && i < most_tried; ++i)
        if(try_candidate(c[i]))
          return prove(reduced, c[i]);
    }
    refuse_inverted();
  }

  // As few tiles as the bound on the mean distortion allows.
  void deform_within_bound(const Reduced_lattice& reduced)
  {
    const std::size_t most_tried = 2;
    const double most_tiles = 1e9;
    bool is_found = false;
    for(double tiles = 1; tiles < most_tiles; tiles *= std::sqrt(2.))
    {
      const std::vector<Candidate> c = candidates(reduced, tiles);
      for(std::size_t i = 0; i < c.size() && i < most_tried; ++i)
      {
        if(expected_distortion(complex_coefficients(c[i].coefficients)) > 1 + 1.5 * (options_.maximum_distortion - 1) + 1e-12)
          break;
        if(!try_candidate(c[i]))
          continue;
        is_found = true;
        if(is_within_bound())
          prove(reduced, c[i]);
        if(is_within_bound())
          return;
      }
    }
    if(!is_found)
      return refuse_inverted();
    status = Status::BOUND_NOT_MET;
    amount = tiling.mean_distortion;
  }

  bool is_within_bound() const { return tiling.mean_distortion <= (std::max)(options_.maximum_distortion, 1 + 1e-9); }

  // From the root of the mean square of |f_zbar / f_z|: not below the mean.
  double expected_distortion(const Coefficients& x) const
  {
    return 1 + 2 * std::sqrt((std::max)(0., relative_energy(x)) / 2);
  }

  void refuse_inverted()
  {
    status = Status::NOT_INJECTIVE;
    faces = inverted_;
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  }

  // ---- Positions

  // Returns whether all triangles are positive.
  bool try_candidate(const Candidate& c)
  {
    const Coefficients x = complex_coefficients(c.coefficients);
    const Complex s = scale_of(x);
    std::vector<Complex> difference = plane_positions(x);
    for(std::size_t i = 0; i < difference.size(); ++i)
      difference[i] -= s * flat_positions_(i);
    const std::vector<Complex> moved = laplace()(data(difference));
    if(moved.empty())
      return false;
    const std::vector<Lattice_point> positions = integral_positions(c.coefficients);
    std::vector<Lattice_coordinates<double> > z = scaled_flat(s), unmended(z.size());
    for(std::size_t v = 0; v < z.size(); ++v)
    {
      const Lattice_coordinates<double> by = lattice_.from_plane(moved[v]);
      z[v] = {{z[v][0] + by[0], z[v][1] + by[1]}};
      if(!t_.is_isolated_vertex(Index(v)))
        unmended[v] = lattice_.from_plane(s * corner_[polygon_.first_corner[v]] + moved[v]);
    }
    if(!finish(std::move(z), positions, s, c.is_closest))
      return false;
    const Mean_factor deformation = deformation_factor(motions(positions), unmended);
    tiling.mean_distortion = deformation.mean;
    tiling.maximum_distortion = deformation.largest;
    return true;
  }

  std::vector<Lattice_point> integral_positions(const std::vector<Lattice_point>& x) const
  {
    std::vector<Lattice_point> result(cones_.size() + polygon_.paths.size(), Lattice_point{{0, 0}});
    for(std::size_t j = 0; j < x.size(); ++j)
      for(std::size_t i = 0; i < result.size(); ++i)
      {
        const Lattice_point &p = positions_.basis[j][i], q = lattice_.times_theta(p);
        for(int k = 0; k < 2; ++k)
          result[i][k] += x[j][0] * p[k] + x[j][1] * q[k];
      }
    return result;
  }

  // The motions across the cut, exactly.
  std::vector<Meta_polygon::Values<double> > motions(const std::vector<Lattice_point>& integral) const
  {
    const std::vector<Lattice_point> translation(integral.begin() + cones_.size(), integral.end());
    const std::vector<Meta_polygon::Values<std::int64_t> > exact = polygon_.values(translation);
    std::vector<Meta_polygon::Values<double> > result(exact.size());
    for(std::size_t m = 0; m < exact.size(); ++m)
      result[m] = {exact[m].quanta, {{double(exact[m].translation[0]), double(exact[m].translation[1])}}};
    return result;
  }

  // Nothing need be deformed: the scale alone is free.
  void scale_only()
  {
    const double tiles = options_.number_of_tiles > 0 ? options_.number_of_tiles : 64;
    const double s = std::sqrt(tiles * lattice_.area_of_tile());
    if(!finish(scaled_flat(s), integral_positions({}), s, true))
      refuse_inverted();
  }

  // Rounds the positions where motions must be exact, makes the corners, and judges them.
  bool finish(std::vector<Lattice_coordinates<double> > z, const std::vector<Lattice_point>& integral, const Complex& s, bool is_closest)
  {
    for(std::size_t i = 0; i < cones_.size(); ++i)
      z[cones_[i].vertex] = {{double(integral[i][0]), double(integral[i][1])}};
    const std::vector<Lattice_point> translation(integral.begin() + cones_.size(), integral.end());
    const std::vector<Meta_polygon::Values<double> > motion = motions(integral);
    Layout<double> result;
    if(!lay_out(motion, z, result) && !untangle(motion, z, result))
      return false;
    CGAL_postcondition(is_seamless(motion, z, translation));
    layout = std::move(result);
    layout.length_error = flat_.length_error;
    cone_positions.assign(integral.begin(), integral.begin() + cones_.size());
    find_transitions(translation);
    measure(s, is_closest);
    return true;
  }

  // Makes the corners, with positions rounded. Returns whether all triangles are positive.
  bool lay_out(const std::vector<Meta_polygon::Values<double> >& motion, std::vector<Lattice_coordinates<double> >& z, Layout<double>& result)
  {
    snap(motion, z);
    result.corner.resize(t_.number_of_halfedges());
    for(Index h = 0; h < result.corner.size(); ++h)
    {
      result.corner[h] = polygon_.apply(motion[polygon_.motion_of_corner[h]], z[t_.target(h)]);
      if(options_.is_lattice_coordinates)
        continue;
      const Complex w = lattice_.to_plane(result.corner[h]);
      result.corner[h] = {{w.real(), w.imag()}};
    }
    find_inverted(result);
    return inverted_.empty();
  }

  // Moves vertices around triangles that are inverted, few of them, until none is.
  bool untangle(const std::vector<Meta_polygon::Values<double> >& motion, std::vector<Lattice_coordinates<double> >& z, Layout<double>& result)
  {
    if(inverted_.size() > 10 + t_.number_of_faces() / 100)
      return false;
    const std::vector<Index> first_inverted = inverted_;
    std::vector<char> is_fixed(t_.number_of_vertices(), 0);
    for(const Quantized_cone& cone : cones_)
      is_fixed[cone.vertex] = 1;
    for(int rings = 0; rings <= most_rings; ++rings)
    {
      std::vector<Lattice_coordinates<double> > relaxed = z;
      const Relaxation relaxation(t_, polygon_, lattice_, motion, is_fixed, inverted_, rings);
      for(int centred = 0; centred < 3; ++centred)
      {
        centred == 0 ? relaxation.average(relaxed) : relaxation.centre(relaxed);
        if(!lay_out(motion, relaxed, result))
          continue;
        z = std::move(relaxed);
        return true;
      }
      inverted_.insert(inverted_.end(), first_inverted.begin(), first_inverted.end());
    }
    return false;
  }

  // To multiples of a power of two, so coarse that there and in the images all coordinates have a few bits to spare.
  void snap(const std::vector<Meta_polygon::Values<double> >& motion, std::vector<Lattice_coordinates<double> >& z) const
  {
    std::vector<char> is_on_seam(z.size(), 0);
    double largest = 1;
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
    {
      const Index m = polygon_.motion_of_corner[h], v = t_.target(h);
      if(m == 0)
        continue;
      is_on_seam[v] = 1;
      for(const Lattice_coordinates<double>& p : {z[v], motion[m].translation, polygon_.apply(motion[m], z[v])})
        largest = (std::max)(largest, (std::max)(std::abs(p[0]), std::abs(p[1])));
    }
    const int bits = std::numeric_limits<double>::digits - 3 - (std::ilogb(largest) + 1);
    for(Index v = 0; v < z.size(); ++v)
      if(is_on_seam[v])
        for(double& x : z[v])
          x = std::scalbn(std::nearbyint(std::scalbn(x, bits)), -bits);
  }

  // Whether the motions take each side of the cut exactly to the other; in lattice coordinates.
  bool is_seamless(const std::vector<Meta_polygon::Values<double> >& motions, const std::vector<Lattice_coordinates<double> >& z,
                   const std::vector<Lattice_point>& translation) const
  {
    const auto corner = [&](Index h) { return polygon_.apply(motions[polygon_.motion_of_corner[h]], z[t_.target(h)]); };
    std::vector<Lattice_coordinates<double> > by;
    for(const Lattice_point& p : translation)
      by.push_back({{double(p[0]), double(p[1])}});
    for(std::size_t p = 0; p < polygon_.paths.size(); ++p)
      for(Index h : polygon_.paths[p].halfedges)
      {
        const auto motion = polygon_.after(Meta_polygon::Values<double>(), Meta_polygon::Crossing{Index(p), true}, by);
        if(polygon_.apply(motion, corner(h)) != corner(t_.previous(t_.twin(h))) || polygon_.apply(motion, corner(t_.previous(h))) != corner(t_.twin(h)))
          return false;
      }
    return true;
  }

  void find_inverted(const Layout<double>& result)
  {
    inverted_.clear();
    for(Index f = 0; f < t_.number_of_faces(); ++f)
      if(!is_left_turn(result.corner[3 * f], result.corner[3 * f + 1], result.corner[3 * f + 2]))
        inverted_.push_back(f);
  }

  void find_transitions(const std::vector<Lattice_point>& translation)
  {
    layout.transitions.clear();
    quanta.clear();
    translations.clear();
    for(Index e = 0; e < t_.number_of_edges(); ++e)
    {
      const Index h = t_.edge_halfedge(e);
      if(!cut_[e] || t_.is_border(h))
        continue;
      const auto motion = polygon_.after(Meta_polygon::Values<std::int64_t>(), polygon_.crossing(h), translation);
      const Complex rotation = lattice_.rotation(motion.quanta), by = lattice_.to_plane(motion.translation);
      layout.transitions.push_back({h, {{rotation.real(), rotation.imag()}}, {{by.real(), by.imag()}}});
      quanta.push_back(motion.quanta);
      translations.push_back(motion.translation);
    }
  }

  // ---- Distortion

  void measure(const Complex& s, bool is_closest)
  {
    const double pi = CGAL_PI;
    tiling.symmetry = lattice_.symmetry();
    tiling.scale = std::abs(s) / unit_;
    tiling.rotation = std::remainder(std::arg(s), 2 * pi);
    tiling.is_closest = is_closest;
    std::vector<Face_distortion> before, after;
    double area = 0;
    for(Index f = 0; f < t_.number_of_faces(); ++f)
    {
      const UV_corners image = uv([&](Index h) { return in_plane(h); }, f);
      const Triangle_frame given = given_frame(f);
      if(!given.is_degenerate())
      {
        before.push_back({given.area(), Scaled_number(), quasi_conformal_factor(given, uv([&](Index h) { return corner_[h]; }, f))});
        after.push_back({given.area(), Scaled_number(), quasi_conformal_factor(given, image)});
      }
      area += std::imag(std::conj(in_plane(3 * f + 1) - in_plane(3 * f)) * (in_plane(3 * f + 2) - in_plane(3 * f))) / 2;
    }
    tiling.number_of_tiles = area / lattice_.area_of_tile();
    tiling.mean_factor_before = mean_factor(before).mean;
    tiling.mean_factor = mean_factor(after).mean;
  }

  // Of the map from the flat surface, where its straight triangles are positive.
  Mean_factor deformation_factor(const std::vector<Meta_polygon::Values<double> >& motion, const std::vector<Lattice_coordinates<double> >& z) const
  {
    const auto image = [&](Index h) { return lattice_.to_plane(polygon_.apply(motion[polygon_.motion_of_corner[h]], z[t_.target(h)])); };
    std::vector<Face_distortion> result;
    for(Index f = 0; f < t_.number_of_faces(); ++f)
    {
      const Triangle_frame given = given_frame(f);
      if(!given.is_degenerate() && is_left_turn(flat_.corner[3 * f], flat_.corner[3 * f + 1], flat_.corner[3 * f + 2]))
        result.push_back({given.area(), Scaled_number(), quasi_conformal_factor(plane_frame(f), uv(image, f))});
    }
    return mean_factor(result);
  }

  // Of the triangle of the mesh.
  Triangle_frame given_frame(Index f) const
  {
    return frame_from_lengths({{t_.halfedge_length(3 * f + 2), t_.halfedge_length(3 * f), t_.halfedge_length(3 * f + 1)}});
  }

  Complex in_plane(Index h) const
  {
    return options_.is_lattice_coordinates ? lattice_.to_plane(layout.corner[h]) : Complex(layout.corner[h][0], layout.corner[h][1]);
  }

  template <typename Corner>
  static UV_corners uv(Corner corner, Index f)
  {
    const Complex p = corner(3 * f), q = corner(3 * f + 1), r = corner(3 * f + 2);
    return {{UV_point(p.real(), p.imag()), UV_point(q.real(), q.imag()), UV_point(r.real(), r.imag())}};
  }

  // Of the flat triangle.
  Triangle_frame plane_frame(Index f) const
  {
    std::array<Space_vector, 3> e;
    for(Index k = 0; k < 3; ++k)
    {
      const Complex d = corner_[3 * f + (k + 2) % 3] - corner_[3 * f + (k + 1) % 3];
      e[k] = {{d.real(), d.imag(), 0}};
    }
    return frame_from_edge_vectors(e);
  }

  // Weighted by the areas in the mesh.
  static Mean_factor mean_factor(const std::vector<Face_distortion>& faces)
  {
    Mean_factor result;
    if(faces.empty())
      return result;
    const Scaled_number total = total_area(faces, [](const Face_distortion& f) { return f.area; });
    double excess = 0;
    for(const Face_distortion& f : faces)
    {
      const double weight = scaled_to(f.area, total.exponent) / total.mantissa;
      if(!(weight > 0) || std::isnan(f.factor)) // a needle without an area in the plane
        continue;
      excess += weight * (f.factor - 1);
      result.largest = (std::max)(result.largest, f.factor);
    }
    result.mean = 1 + excess;
    return result;
  }

  static constexpr double weight_of_scale = 1. / 256;
  static constexpr int most_rings = 6;
  static constexpr std::size_t most_enumerated_dimensions = 60, most_nodes = 20000, most_nodes_of_proof = 10000000;

  const Triangulation& t_;
  const Cut_graph& cut_;
  const Layout<double>& flat_;
  const std::vector<Quantized_cone>& cones_;
  const Texture_lattice lattice_;
  const Rectification_options options_;
  const SolverTraits traits_;
  Meta_polygon polygon_;

  std::vector<Complex> corner_;       // of the flat layout, normalized
  std::vector<Lattice_coordinates<double> > flat_z_; // by vertex, in its first corner: the same, without inverted triangles
  double unit_ = 1;                   // by which it was divided
  Position_lattice positions_;
  Eigen::MatrixXcd basis_;            // in the plane
  Coefficients flat_positions_, flat_coefficients_;
  std::vector<Index> fixed_;
  std::unique_ptr<Laplace> laplace_;
  Eigen::MatrixXcd energy_;
  std::vector<Index> inverted_;       // of the last candidate
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RECTIFICATION_H
