// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Closest lattice vectors, for the rectification of seamless textures (section 6.1 of Springborn, Schroeder and
// Pinkall, 2008): the positions that the cones may have are a lattice, and the one that costs the least is wanted.
//
// The lattice is that of all integer combinations of b_1 ... b_d, known by their Gram matrix G. The target is
// the combination of the b_j with real coefficients x; wanted are the integers k that minimize (k - x)^T G (k - x).
//
// - The basis is reduced first (Lattice_reduction.h): Lenstra, Lenstra and Lovasz, "Factoring polynomials with rational coefficients", 1982,
//   with the deep insertions of Schnorr and Euchner, "Lattice basis reduction", 1994, in moderate dimensions. The
//   Gram-Schmidt coefficients are floating-point numbers, computed from the Gram matrix as by Nguyen and Stehle,
//   "Floating-point LLL revisited", 2005; the transformation is exact.
// - Rounding one coordinate after the other gives a near point: Babai, "On Lovasz' lattice reduction and the
//   nearest lattice point problem", 1986.
// - Enumeration of all points that are as near, in the order of Schnorr and Euchner, gives the nearest: Agrell, Eriksson,
//   Vardy and Zeger, "Closest point search in lattices", 2002. Its time grows exponentially with the dimension.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LATTICES_CLOSEST_VECTOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LATTICES_CLOSEST_VECTOR_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Lattices/Lattice_reduction.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A point of a lattice, and what is known of it.
struct Lattice_vector
{
  std::vector<std::int64_t> coefficients; // in the basis given; empty if there is no answer
  double square_distance = 0;             // from the target
  bool is_closest = false;                // proven: no point is nearer (of a list: no point that is left out is nearer)
  std::size_t number_of_nodes = 0;        // of the search tree
};

// The order of the results: by distance, ties by coefficients.
inline bool is_nearer(const Lattice_vector& a, const Lattice_vector& b)
{
  if(a.square_distance != b.square_distance)
    return a.square_distance < b.square_distance;
  return a.coefficients < b.coefficients;
}

// The quadratic form of a Gram matrix, of differences from a target.
class Square_distance
{
  Eigen::MatrixXd gram_;
  int exponent_ = 0; // the matrix is 2^exponent times the one stored

public:
  // Scales by a power of two, so that no square overflows, and makes the matrix exactly symmetric. Its diagonal is positive.
  explicit Square_distance(const Eigen::MatrixXd& gram) : gram_(gram)
  {
    int least = (std::numeric_limits<int>::max)(), largest = (std::numeric_limits<int>::min)();
    for(Eigen::Index i = 0; i < gram_.rows(); ++i)
    {
      const int e = std::ilogb(gram(i, i));
      least = (std::min)(least, e);
      largest = (std::max)(largest, e);
    }
    if(gram_.rows() > 0)
      exponent_ = least + (largest - least) / 2;
    for(Eigen::Index i = 0; i < gram_.rows(); ++i)
      for(Eigen::Index j = 0; j <= i; ++j)
      {
        const double a = std::ldexp(gram(i, j), -exponent_), b = std::ldexp(gram(j, i), -exponent_);
        gram_(i, j) = gram_(j, i) = a / 2 + b / 2;
      }
  }

  const Eigen::MatrixXd& scaled_gram() const { return gram_; }

  // 2^exponent times a value of the scaled form
  double unscaled(double x) const { return std::ldexp(x, exponent_); }

  // (k - x)^T G (k - x), scaled, correctly rounded but for very few cases.
  double operator()(const std::vector<std::int64_t>& k, const Eigen::VectorXd& x) const
  {
    const Eigen::Index d = gram_.rows();
    std::vector<Double_double> y(k.size());
    for(std::size_t i = 0; i < k.size(); ++i)
      y[i] = Double_double(k[i]) - x[Eigen::Index(i)];
    Double_double result;
    for(Eigen::Index i = 0; i < d; ++i)
    {
      Double_double sum;
      for(Eigen::Index j = 0; j < i; ++j)
        sum += y[std::size_t(j)] * gram_(i, j);
      result += y[std::size_t(i)] * (sum * 2. + y[std::size_t(i)] * gram_(i, i));
    }
    return (std::max)(result.hi, 0.);
  }
};

// A lattice, its reduced basis, and the search for points near a target. All results are deterministic.
class Reduced_lattice
{
  typedef Lattice_reduction::Real Real;
  typedef std::vector<std::int64_t> Integer_vector;

public:
  // `gram`: symmetric and positive definite.
  explicit Reduced_lattice(const Eigen::MatrixXd& gram)
    : dimension_(static_cast<std::size_t>(gram.rows())), square_distance_(is_symmetric(gram) ? gram : Eigen::MatrixXd(0, 0)),
      basis_(square_distance_.scaled_gram())
  {
    is_valid_ = is_symmetric(gram) && basis_.is_positive_definite();
    if(!is_valid_)
      return;
    basis_();
    tabulate();
    bound_errors();
  }

  // Whether the matrix was finite, symmetric, and positive definite as far as rounding tells. Otherwise nothing is found.
  bool is_valid() const { return is_valid_; }

  std::size_t dimension() const { return dimension_; }

  // The reduced basis: coefficients, inverse transformation, and Gram-Schmidt coefficients (for a multiple of the matrix).
  const Lattice_reduction& basis() const { return basis_; }

  // |b*_k|^2 of the reduced basis
  double square_length(std::size_t k) const { return square_distance_.unscaled(square_length_[k]); }

  // The point of the nearest plane of the nearest plane ...: at most 2^(d/2) times as far away as the closest, and much better in
  // practice. O(d^2). No answer (no coefficients) if the lattice is invalid, or coefficients of the target are not
  // finite or beyond 2^52.
  Lattice_vector babai(const Eigen::VectorXd& target) const
  {
    Residual residual;
    return nearest_plane(target, residual);
  }

  // The closest point; the best one found, with `is_closest == false`, if it is not proven in a search of at most `most_nodes` nodes.
  Lattice_vector closest(const Eigen::VectorXd& target, std::size_t most_nodes) const
  {
    Residual residual;
    const Lattice_vector first = nearest_plane(target, residual);
    if(first.coefficients.empty() || first.is_closest)
      return first;
    return search(target, residual, first, 1, most_nodes).front();
  }

  // The `most` nearest points, in ascending order of the distance, ties by coefficients. Fewer, or not the nearest, and with
  // `is_closest == false`, if that takes more than `most_nodes` nodes. O(d) at most for every node, O(d^2) for every point found.
  std::vector<Lattice_vector> nearest_vectors(const Eigen::VectorXd& target, std::size_t most, std::size_t most_nodes) const
  {
    Residual residual;
    const Lattice_vector first = nearest_plane(target, residual);
    if(most == 0 || !accepts(target) || first.coefficients.size() != dimension_)
      return std::vector<Lattice_vector>();
    if(dimension_ == 0)
      return std::vector<Lattice_vector>(1, first);
    return search(target, residual, first, most, most_nodes);
  }

private:
  // What is left of the target when Babai's point is subtracted: coordinates along the b*_i, at most 1/2.
  typedef std::vector<double> Residual;

  // Finite, symmetric, with a positive diagonal the range of which leaves room for squares.
  static bool is_symmetric(const Eigen::MatrixXd& gram)
  {
    if(gram.rows() != gram.cols() || !gram.allFinite() || !(gram.diagonal().array() > 0).all())
      return false;
    const Eigen::VectorXd length = gram.diagonal().cwiseSqrt();
    const double asymmetry = 1e-8; // far more than rounding makes of a symmetric matrix
    if(gram.rows() > 0 && !(length.maxCoeff() / length.minCoeff() < std::ldexp(1., 800))) // squares of quotients stay in the range of `double`
      return false;
    for(Eigen::Index i = 0; i < gram.rows(); ++i)
      for(Eigen::Index j = 0; j < i; ++j)
        if(!(std::abs(gram(i, j) - gram(j, i)) <= asymmetry * length[i] * length[j]))
          return false;
    return true;
  }

  // The Gram-Schmidt coefficients for the search, which runs in `double`.
  void tabulate()
  {
    const Eigen::Index d = Eigen::Index(dimension_);
    mu_.setIdentity(d, d);
    square_length_.resize(dimension_);
    is_orthogonal_ = true;
    for(std::size_t k = 0; k < dimension_; ++k)
    {
      square_length_[k] = static_cast<double>(basis_.square_length(k));
      for(std::size_t j = 0; j < k; ++j)
      {
        mu_(Eigen::Index(k), Eigen::Index(j)) = static_cast<double>(basis_[k].mu[j]);
        is_orthogonal_ = is_orthogonal_ && basis_[k].mu[j] == 0;
      }
    }
  }

  // How much longer, relatively, a vector may seem to be than it is, squared. Cholesky's algorithm gives the exact factor L D L^T of a
  // matrix that differs by at most (d + 2) eps |b_i| |b_j| (Higham, "Accuracy and stability of numerical algorithms", 2002, section 10.1). For the
  // vector L^-T D^-1/2 u that is the sum of the |b_i| |(L^-T D^-1/2 u)_i|, squared. To that the rounding of the search itself is added.
  void bound_errors()
  {
    if(dimension_ == 0)
      return;
    const std::size_t d = dimension_;
    std::vector<double> length(d), star(d);
    for(std::size_t i = 0; i < d; ++i)
    {
      length[i] = std::sqrt(static_cast<double>(basis_.product(i, i)));
      star[i] = std::sqrt(square_length_[i]);
    }
    const double growth = square_norm_of_inverse(star, length);
    const double largest = *std::max_element(star.begin(), star.end()), least = *std::min_element(star.begin(), star.end());
    slack_ = 2 * double(d + 4) * static_cast<double>(std::numeric_limits<Real>::epsilon()) * growth
             + 16 * double(d) * std::numeric_limits<double>::epsilon() * (1 + largest / least);
    if(!(slack_ < .25))
    {
      slack_ = .25;
      can_prove_ = false;
    }
  }

  // |A l|^2 for the absolute values A of the inverse of the lower factor L D^1/2, where D^1/2 is `star`: by forward substitution, column by column.
  double square_norm_of_inverse(const std::vector<double>& star, const std::vector<double>& l) const
  {
    const std::size_t d = dimension_;
    std::vector<double> sum(d, 0.), column(d);
    for(std::size_t j = 0; j < d; ++j)
      for(std::size_t i = j; i < d; ++i)
      {
        double x = i == j ? 1 : 0;
        for(std::size_t k = j; k < i; ++k)
          x -= mu_(Eigen::Index(i), Eigen::Index(k)) * star[k] * column[k];
        column[i] = x / star[i];
        sum[i] += std::abs(column[i]) * l[j];
      }
    double result = 0;
    for(double x : sum)
      result += x * x;
    return result;
  }

  bool accepts(const Eigen::VectorXd& target) const
  {
    const double bound = 4503599627370496.; // 2^52
    return is_valid_ && std::size_t(target.size()) == dimension_ && target.allFinite() && (target.array().abs() <= bound).all();
  }

  static Lattice_vector no_answer()
  {
    Lattice_vector result;
    result.square_distance = std::numeric_limits<double>::infinity();
    return result;
  }

  // The coordinates of a vector in the reduced basis, from those in the given one.
  std::vector<Real> reduced_coordinates(const Eigen::VectorXd& x) const
  {
    std::vector<Real> result(dimension_);
    for(std::size_t i = 0; i < dimension_; ++i)
    {
      Double_double sum;
      for(std::size_t j = 0; j < dimension_; ++j)
        if(basis_[i].dual[j] != 0)
          sum += Double_double(basis_[i].dual[j]) * x[Eigen::Index(j)];
      result[i] = static_cast<Real>(sum);
    }
    return result;
  }

  Lattice_vector nearest_plane(const Eigen::VectorXd& target, Residual& residual) const
  {
    if(!accepts(target))
      return no_answer();
    Lattice_vector result;
    Eigen::VectorXd fraction = target;
    for(Eigen::Index i = 0; i < target.size(); ++i)
    {
      result.coefficients.push_back(static_cast<std::int64_t>(std::round(target[i])));
      fraction[i] -= std::round(target[i]);
    }
    std::vector<Real> rest = reduced_coordinates(fraction); // the target less the point, in the reduced basis
    residual.resize(dimension_);
    for(std::size_t i = dimension_; i-- > 0; )
    {
      Real center = rest[i]; // its coordinate along b*_i
      for(std::size_t j = i + 1; j < dimension_; ++j)
        center += basis_[j].mu[i] * rest[j];
      const Real nearest = std::round(center);
      if(!(std::abs(nearest) < Real(largest_factor)) ||
         !add_multiple(result.coefficients, static_cast<std::int64_t>(nearest), basis_[i].coefficients))
        return no_answer();
      rest[i] -= nearest;
      residual[i] = static_cast<double>(center - nearest);
    }
    const double distance = square_distance_(result.coefficients, target);
    result.square_distance = square_distance_.unscaled(distance);
    result.is_closest = is_certainly_closest(distance);
    result.number_of_nodes = dimension_;
    return result;
  }

  // No vector of the lattice is shorter than the shortest b*_i: a point that is nearer than half of it is the closest.
  bool is_certainly_closest(double scaled_distance) const
  {
    if(dimension_ == 0 || is_orthogonal_)
      return true;
    const double shortest = *std::min_element(square_length_.begin(), square_length_.end());
    return can_prove_ && 4 * scaled_distance < (1 - slack_) * shortest;
  }

  // The nearest points that are known, at most `most`.
  class Candidates
  {
  public:
    Candidates(std::size_t most, const Lattice_vector& first) : most_(most), list_(1, first) {}

    void insert(Lattice_vector v)
    {
      const auto place = std::lower_bound(list_.begin(), list_.end(), v, is_nearer);
      if(place != list_.end() && place->coefficients == v.coefficients)
        return;
      list_.insert(place, std::move(v));
      if(list_.size() > most_)
        list_.pop_back();
    }

    // What is farther away is of no interest.
    double bound() const
    {
      return list_.size() < most_ ? std::numeric_limits<double>::infinity() : list_.back().square_distance;
    }

    std::vector<Lattice_vector>& list() { return list_; }

  private:
    std::size_t most_;
    std::vector<Lattice_vector> list_; // in ascending order
  };

  // Depth first search for z with |z - residual| within the bound: the levels are the coordinates from the last to the first, and the
  // children of a node the integers in the order of their distance from its center.
  class Enumeration
  {
  public:
    Enumeration(const Reduced_lattice& lattice, const Residual& residual, std::size_t most_nodes)
      : number_of_nodes(0), lattice_(lattice), d_(lattice.dimension_), most_nodes_(most_nodes),
        sums_(d_ * (d_ + 1), 0.), mu_transposed_(d_ * d_), z_(d_), step_(d_), center_(d_), square_(d_ + 1, 0.),
        bound_(d_), last_changed_(d_)
    {
      for(std::size_t i = 0; i < d_; ++i)
      {
        sums_[i * (d_ + 1) + d_] = residual[i];
        for(std::size_t j = i; j < d_; ++j)
          mu_transposed_[i * d_ + j] = lattice.mu_(Eigen::Index(j), Eigen::Index(i));
      }
    }

    std::size_t number_of_nodes;

    // Calls `visit(z)` for every point within the bound that `radius()` gives, after every visit anew. If `is_pruned` the bound is that part of
    // it which is usual for the levels above: most points are found, at a small part of the cost. False if the nodes did not suffice.
    template <typename Radius, typename Visit>
    bool operator()(bool is_pruned, const Radius& radius, const Visit& visit)
    {
      std::fill(last_changed_.begin(), last_changed_.end(), d_ - 1);
      set_bounds(radius(), is_pruned);
      std::size_t i = d_ - 1;
      enter(i);
      for(;;)
      {
        const double offset = z_[i] - center_[i];
        square_[i] = square_[i + 1] + offset * offset * lattice_.square_length_[i];
        if(square_[i] <= bound_[i])
        {
          if(number_of_nodes == most_nodes_)
            return false;
          ++number_of_nodes;
          if(i > 0)
          {
            enter(--i);
            continue;
          }
          visit(z_);
          set_bounds(radius(), is_pruned);
        }
        else if(++i == d_)
          return true;
        z_[i] += step_[i];
        step_[i] = -step_[i] - (step_[i] > 0 ? 1 : -1);
      }
    }

  private:
    // The center of level i, from the coordinates above it that have changed since it was entered last, and the integer next to
    // it. When it is entered again at least the coordinate just above will have changed.
    void enter(std::size_t i)
    {
      double* const sum = &sums_[i * (d_ + 1)];
      const double* const mu = &mu_transposed_[i * d_];
      for(std::size_t j = last_changed_[i]; j > i; --j)
        sum[j] = sum[j + 1] - mu[j] * z_[j];
      if(i > 0)
        last_changed_[i - 1] = (std::max)(last_changed_[i - 1], last_changed_[i]);
      last_changed_[i] = i + 1;
      center_[i] = sum[i + 1];
      z_[i] = std::round(center_[i]);
      step_[i] = center_[i] > z_[i] ? 1 : -1;
    }

    void set_bounds(double radius, bool is_pruned)
    {
      for(std::size_t i = 0; i < d_; ++i)
        bound_[i] = radius * (1 + lattice_.slack_) * (is_pruned ? pruned_part(d_ - i) : 1);
    }

    // Of the square distance that the first of the levels may have used up.
    double pruned_part(std::size_t levels) const
    {
      return (std::min)(1., 1.1 * double(levels) / double(d_) + .05);
    }

    const Reduced_lattice& lattice_;
    std::size_t d_, most_nodes_;
    std::vector<double> sums_;          // row i, column j: the residual less the contributions of z_j, z_{j+1}, ... to the center of level i
    std::vector<double> mu_transposed_; // row i: mu_ji
    std::vector<double> z_, step_, center_;
    std::vector<double> square_, bound_; // of the coordinates from i on
    std::vector<std::size_t> last_changed_; // the largest j for which z_j has changed since level i was entered
  };

  // The point z of the reduced basis, counted from the first one.
  bool add_coordinates(Integer_vector& point, const std::vector<double>& z) const
  {
    for(std::size_t i = 0; i < dimension_; ++i)
      if(z[i] != 0 && (!(std::abs(z[i]) < largest_factor) || !add_multiple(point, static_cast<std::int64_t>(z[i]), basis_[i].coefficients)))
        return false;
    return true;
  }

  // First a pruned search, with half of the nodes at most, which makes the bound small, then a complete one.
  std::vector<Lattice_vector> search(const Eigen::VectorXd& target, const Residual& residual, const Lattice_vector& first, std::size_t most,
                                     std::size_t most_nodes) const
  {
    Lattice_vector origin = first;
    origin.square_distance = square_distance_(first.coefficients, target);
    Candidates candidates(most, origin);
    const auto radius = [&] { return candidates.bound(); };
    const auto visit = [&](const std::vector<double>& z)
    {
      Lattice_vector v;
      v.coefficients = first.coefficients;
      if(!add_coordinates(v.coefficients, z))
        return;
      v.square_distance = square_distance_(v.coefficients, target);
      candidates.insert(std::move(v));
    };

    Enumeration pruned(*this, residual, most_nodes / 2);
    pruned(true, radius, visit);
    Enumeration complete(*this, residual, most_nodes - pruned.number_of_nodes);
    const bool is_complete = complete(false, radius, visit) && can_prove_;

    for(Lattice_vector& v : candidates.list())
    {
      v.square_distance = square_distance_.unscaled(v.square_distance);
      v.is_closest = is_complete;
      v.number_of_nodes = pruned.number_of_nodes + complete.number_of_nodes;
    }
    return std::move(candidates.list());
  }

  std::size_t dimension_;
  bool is_valid_ = false;
  Square_distance square_distance_;
  Lattice_reduction basis_;
  Eigen::MatrixXd mu_;
  std::vector<double> square_length_; // of the b*_i
  bool is_orthogonal_ = false;
  bool can_prove_ = true;
  double slack_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LATTICES_CLOSEST_VECTOR_H
