// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Which of the admissible positions a layout is deformed to (section 6.1 of Springborn, Schroeder and Pinkall, 2008).
//
// They are sum x_j b_j with a basis b_j (position_lattice.h) and coefficients x_j in the ring. The paper looks for the nearest positions, by rounding
// as many as are independent. Here the distance is the conformal energy itself: with the Laplace layouts of the b_j the least energy for any x is a
// Hermitian form x* H x. That of the layout itself, x = x*, is zero, and so is that of all its multiples s x*, by which it is turned and
// scaled. So H knows no scale, and that is chosen: the closest vector to s x* for
//
//     x* H x  +  lambda |alpha(x)|^2,     alpha(x) = the factor by which positions were turned and scaled,
//
// where the small lambda says how much a scale other than s is worth. s is varied: its argument, as the lattice is not round, and its size.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_POSITION_CHOICE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_POSITION_CHOICE_H

#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Lattices/closest_vector.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/position_lattice.h>
#include <CGAL/Conformal_equivalence/internal/stable_order.h>

#include <CGAL/number_utils.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Position_choice
{
public:
  typedef std::complex<double> Complex;
  typedef Lattice_coordinates<std::int64_t> Lattice_point;
  typedef Eigen::VectorXcd Coefficients;

  struct Candidate
  {
    std::vector<Lattice_point> coefficients;
    Complex s;          // what was aimed at
    double cost;
    bool is_closest;
  };

  // `flat_positions` are those of the layout, in the plane; `energy(basis)` is H for a basis in the plane, by columns. The area of
  // the layout must be 1. Keeps references.
  template <typename Energy>
  Position_choice(const Position_lattice& positions, const Texture_lattice& lattice, const Coefficients& flat_positions, Energy energy)
    : lattice_of_positions_(positions), lattice_(lattice), flat_positions_(flat_positions),
      basis_(plane_basis(positions, lattice, flat_positions.size())),
      flat_coefficients_(solve_least_squares(basis_, flat_positions)), energy_(energy(basis_)), reduced_(gram())
  {}

  bool is_valid() const { return reduced_.is_valid(); }

  const Eigen::MatrixXcd& energy() const { return energy_; }
  const Coefficients& flat_coefficients() const { return flat_coefficients_; }

  // By number of cone and path, in the plane.
  Coefficients plane_positions(const Coefficients& x) const
  {
    Coefficients result = Coefficients::Zero(basis_.rows());
    for(Eigen::Index i = 0; i < basis_.rows(); ++i)
      for(Eigen::Index j = 0; j < basis_.cols(); ++j)
        result(i) += basis_(i, j) * x(j);
    return result;
  }

  // The same in lattice coordinates.
  std::vector<Lattice_point> integral_positions(const std::vector<Lattice_point>& x) const
  {
    std::vector<Lattice_point> result(std::size_t(flat_positions_.size()), Lattice_point{{0, 0}});
    for(std::size_t j = 0; j < x.size(); ++j)
      for(std::size_t i = 0; i < result.size(); ++i)
      {
        const Lattice_point &p = lattice_of_positions_.basis[j][i], q = lattice_.times_theta(p);
        for(int k = 0; k < 2; ++k)
          result[i][k] += x[j][0] * p[k] + x[j][1] * q[k];
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

  // alpha(x)
  Complex scale_of(const Coefficients& x) const
  {
    return flat_positions_.dot(plane_positions(x)) / flat_positions_.squaredNorm();
  }

  // The part of the energy in the area, for coefficients x.
  double relative_energy(const Coefficients& x) const
  {
    return product_of_adjoint(x, energy_).cwiseProduct(x).sum().real() / std::norm(scale_of(x));
  }

  // From the root of the mean square of |f_zbar / f_z|: not below the mean.
  double expected_distortion(const Coefficients& x) const
  {
    return 1 + 2 * std::sqrt((std::max)(0., relative_energy(x)) / 2);
  }

  // The best ones with about that many tiles, for several rotations.
  std::vector<Candidate> candidates(double number_of_tiles) const
  {
    const int number_of_rotations = 8;
    const bool is_enumerated = reduced_.dimension() <= most_enumerated_dimensions;
    const double size = std::sqrt(number_of_tiles * lattice_.area_of_tile());
    std::vector<Candidate> result;
    for(int k = 0; k < number_of_rotations; ++k)
    {
      const Complex s = std::polar(size, 2 * CGAL_PI * k / (lattice_.order() * number_of_rotations));
      const Eigen::VectorXd target = real_coefficients(s * flat_coefficients_);
      const std::vector<Lattice_vector> vectors = is_enumerated ? reduced_.nearest_vectors(target, 2, most_nodes)
                                                                : std::vector<Lattice_vector>(1, reduced_.babai(target));
      for(std::size_t i = 0; i < vectors.size(); ++i)
        add_candidate(vectors[i], s, i == 0 && vectors[i].is_closest, result);
    }
    std::vector<Candidate> sorted;
    for(std::uint32_t i : stable_order(result.size(), [&](std::uint32_t c, std::uint32_t d) { return result[c].cost < result[d].cost; }))
      sorted.push_back(std::move(result[i]));
    return sorted;
  }

  // Looks longer for the closest one to what was aimed at.
  Candidate closest(const Candidate& c) const
  {
    Candidate result = c;
    if(reduced_.dimension() > most_enumerated_dimensions)
      return result;
    const Lattice_vector v = reduced_.closest(real_coefficients(c.s * flat_coefficients_), most_nodes_of_proof);
    result.coefficients = lattice_points(v);
    result.is_closest = v.is_closest;
    return result.coefficients.empty() ? c : result;
  }

private:
  static Eigen::MatrixXcd plane_basis(const Position_lattice& positions, const Texture_lattice& lattice, Eigen::Index number_of_positions)
  {
    Eigen::MatrixXcd result(number_of_positions, Eigen::Index(positions.rank()));
    for(Eigen::Index j = 0; j < result.cols(); ++j)
      for(Eigen::Index i = 0; i < result.rows(); ++i)
        result(i, j) = lattice.to_plane(positions.basis[j][i]);
    return result;
  }

  // The x* a, as a column. (Loops of our own, here and below: matrices are small, and Eigen's products of complex ones cost a program seconds to
  // compile.)
  static Coefficients product_of_adjoint(const Coefficients& x, const Eigen::MatrixXcd& a)
  {
    Coefficients result = Coefficients::Zero(a.cols());
    for(Eigen::Index j = 0; j < a.cols(); ++j)
      for(Eigen::Index i = 0; i < a.rows(); ++i)
        result(j) += a(i, j) * std::conj(x(i));
    return result;
  }

  // The x for which a x is closest to b.
  static Coefficients solve_least_squares(const Eigen::MatrixXcd& a, const Coefficients& b)
  {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXcd> qr(a);
    const Eigen::Index rank = qr.nonzeroPivots(), n = b.size();
    Coefficients c = b; // becomes Q* b
    for(Eigen::Index k = 0; k < rank; ++k)
    {
      const Complex tau = qr.hCoeffs()(k);
      if(k == n - 1)
        c(k) *= 1. - tau;
      else if(tau != 0.)
      {
        const auto reflector = qr.matrixQR().col(k).tail(n - k - 1);
        const Complex product = reflector.dot(c.tail(n - k - 1)) + c(k);
        c(k) -= tau * product;
        c.tail(n - k - 1) -= product * (tau * reflector);
      }
    }
    qr.matrixQR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(c.head(rank));
    Coefficients result = Coefficients::Zero(a.cols());
    for(Eigen::Index k = 0; k < rank; ++k)
      result(qr.colsPermutation().indices()(k)) = c(k);
    return result;
  }

  // The Hermitian form that is minimized.
  Eigen::MatrixXcd form() const
  {
    const Eigen::Index r = energy_.rows();
    const Coefficients alpha = product_of_adjoint(flat_positions_, basis_) / flat_positions_.squaredNorm();
    Eigen::MatrixXcd result = energy_;
    for(Eigen::Index i = 0; i < r; ++i)
      for(Eigen::Index j = 0; j < r; ++j)
        result(i, j) += weight_of_scale * std::conj(alpha(i)) * alpha(j);
    const double rounding = 1e-13; // of the energies, relative to the mean one: with this added the form is positive definite
    const double shift = rounding * result.diagonal().real().sum() / double(r);
    for(Eigen::Index i = 0; i < r; ++i)
      result(i, i) += shift;
    return result;
  }

  // The same as a real form in the lattice coordinates of the coefficients, of which 1 and theta are the units.
  Eigen::MatrixXd gram() const
  {
    const Eigen::MatrixXcd f = form();
    const Complex unit[2] = {1, lattice_.theta()};
    Eigen::MatrixXd result(2 * f.rows(), 2 * f.cols());
    for(Eigen::Index i = 0; i < result.rows(); ++i)
      for(Eigen::Index j = 0; j < result.cols(); ++j)
        result(i, j) = (std::conj(unit[i % 2]) * f(i / 2, j / 2) * unit[j % 2]).real();
    return result;
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

  void add_candidate(const Lattice_vector& v, const Complex& s, bool is_closest, std::vector<Candidate>& result) const
  {
    Candidate c;
    c.coefficients = lattice_points(v);
    c.s = s;
    const Coefficients x = complex_coefficients(c.coefficients);
    const double scale = std::abs(scale_of(x)) / std::abs(s);
    if(!(scale > 0.7 && scale < 1.43)) // more than twice, or less than half, the number of tiles; or all in one point
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

  // Lambda: a scale that is wrong by a tenth costs as much as a mean distortion of about 1.01.
  static constexpr double weight_of_scale = 1. / 256;

  // Up to about 30 cones the closest vector is found in moderate time: beyond that, enumeration rarely ends.
  static constexpr std::size_t most_enumerated_dimensions = 60;
  static constexpr std::size_t most_nodes = 20000;             // milliseconds, for each of the rotations
  static constexpr std::size_t most_nodes_of_proof = 10000000; // about a second, once

  const Position_lattice& lattice_of_positions_;
  const Texture_lattice lattice_;
  const Coefficients flat_positions_;
  const Eigen::MatrixXcd basis_;               // in the plane
  const Coefficients flat_coefficients_;
  const Eigen::MatrixXcd energy_;
  const Reduced_lattice reduced_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_POSITION_CHOICE_H
