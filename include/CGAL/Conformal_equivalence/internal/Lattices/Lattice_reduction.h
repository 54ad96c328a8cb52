// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Reduced bases of lattices that are known by their Gram matrix:
//
// Lenstra, Lenstra and Lovasz, "Factoring polynomials with rational coefficients", 1982,
// with the deep insertions of Schnorr and Euchner, "Lattice basis reduction", 1994, in moderate dimensions. The
// Gram-Schmidt coefficients are floating-point numbers, computed from the Gram matrix as by Nguyen and Stehle,
// "Floating-point LLL revisited", 2005; the transformation is exact.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LATTICES_LATTICE_REDUCTION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LATTICES_LATTICE_REDUCTION_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// a += factor * b, unless an integer would leave [-2^62, 2^62].
inline bool add_multiple(std::vector<std::int64_t>& a, std::int64_t factor, const std::vector<std::int64_t>& b)
{
  const double bound = 4.6e18; // a little less than 2^62, so that the rounding of this test does not matter
  for(std::size_t i = 0; i < a.size(); ++i)
    if(!(std::abs(double(a[i])) + std::abs(double(factor)) * std::abs(double(b[i])) < bound))
      return false;
  for(std::size_t i = 0; i < a.size(); ++i)
    a[i] += factor * b[i];
  return true;
}

// Somewhat less than 2^62: what is rounded to an integer of 64 bits must be below it.
constexpr double largest_factor = 4e18;

// A lattice and a basis of it that becomes reduced. The scalar products are kept as rounded numbers, which follow the
// changes of the basis; they are computed anew from the Gram matrix and the exact transformation where much has cancelled.
class Lattice_reduction
{
public:
  typedef long double Real;

  struct Basis_vector
  {
    std::vector<std::int64_t> coefficients; // in the basis given: a column of the transformation
    std::vector<std::int64_t> dual;         // a row of its inverse: the coordinate of a target that belongs to this vector
    std::vector<Real> mu;                   // the Gram-Schmidt coefficients mu_kj, j < k
    std::vector<Real> r;                    // mu_kj |b*_j|^2, j < k, then |b*_k|^2
    std::size_t number_known;               // of the entries of r
    std::size_t index;                      // of the row in the table of scalar products
    Real fresh_length;                      // the square length when it was computed last
  };

  // delta of the Lovasz condition
  static Real delta() { return Real(0.99); }

  // What |mu| may be: a little more than 1/2, so that ties do not go on forever.
  static Real eta() { return Real(0.5) + Real(1e-10); }

  explicit Lattice_reduction(const Eigen::MatrixXd& gram)
    : gram_(gram), dimension_(static_cast<std::size_t>(gram.rows())), products_(dimension_, std::vector<Real>(dimension_)),
      basis_(dimension_)
  {
    for(std::size_t k = 0; k < dimension_; ++k)
    {
      Basis_vector& b = basis_[k];
      b.coefficients.assign(dimension_, 0);
      b.coefficients[k] = 1;
      b.dual = b.coefficients;
      b.mu.assign(dimension_, 0);
      b.r.assign(dimension_, 0);
      b.index = k;
    }
    compute_products();
  }

  // Whether the matrix is positive definite as far as its rounded entries tell: |b*_k| is not lost in the rounding of |b_k|.
  bool is_positive_definite()
  {
    const Real noise = Real(2 * (dimension_ + 1)) * Real(std::numeric_limits<double>::epsilon());
    for(std::size_t k = 0; k < dimension_; ++k)
    {
      orthogonalize(k);
      if(!(square_length(k) > noise * product(k, k)))
        return false;
    }
    return true;
  }

  // Reduces the basis. It may end before the conditions hold, where integers would overflow: it is a basis nevertheless.
  void operator()()
  {
    const std::size_t d = dimension_;
    for(int pass = 0; pass < most_passes; ++pass)
    {
      bool has_changed = false;
      bool is_finished = reduce(false, most_steps * d * d, has_changed);
      if(d <= deep_dimension && is_finished)
        is_finished = reduce(true, most_deep_steps * d * d, has_changed) || reduce(false, most_steps * d * d, has_changed);
      compute_products();
      for(std::size_t k = 0; k < d; ++k)
        orthogonalize(k);
      if(!has_changed || !is_finished)
        return;
    }
  }

  std::size_t dimension() const { return dimension_; }
  const Basis_vector& operator[](std::size_t k) const { return basis_[k]; }
  Real product(std::size_t k, std::size_t j) const { return products_[basis_[k].index][basis_[j].index]; }
  Real square_length(std::size_t k) const { return basis_[k].r[k]; } // of b*_k

private:
  // Far more than are needed, but the end is not proven where numbers are rounded. Steps are times the square of the dimension. Deep insertions may
  // take exponential time: they are for dimensions in which enumeration follows, and shall take no longer than that.
  static constexpr int most_passes = 8, most_rounds = 200;
  static constexpr std::size_t most_steps = 2000, most_deep_steps = 60, deep_dimension = 64;

  // Row k of the Gram-Schmidt coefficients, as far as it is not known; the rows before it are.
  void orthogonalize(std::size_t k)
  {
    Basis_vector& b = basis_[k];
    for(std::size_t j = b.number_known; j <= k; ++j)
    {
      const Basis_vector& a = basis_[j];
      Real sum = product(k, j);
      for(std::size_t l = 0; l < j; ++l)
        sum -= a.mu[l] * b.r[l];
      b.r[j] = sum;
      if(j < k)
        b.mu[j] = sum / a.r[j];
    }
    b.number_known = k + 1;
  }

  // The scalar products of b_k with b_0 ... b_last from the Gram matrix.
  void compute_products(std::size_t k, std::size_t last)
  {
    Basis_vector& b = basis_[k];
    const std::size_t d = dimension_;
    std::vector<Double_double> image(d); // of b_k under the Gram matrix
    for(std::size_t j = 0; j < d; ++j)
      if(b.coefficients[j] != 0)
      {
        const Double_double factor(b.coefficients[j]);
        for(std::size_t i = 0; i < d; ++i)
          image[i] += factor * gram_(Eigen::Index(i), Eigen::Index(j));
      }
    for(std::size_t l = 0; l <= last; ++l)
    {
      const Basis_vector& a = basis_[l];
      Double_double sum;
      for(std::size_t i = 0; i < d; ++i)
        if(a.coefficients[i] != 0)
          sum += Double_double(a.coefficients[i]) * image[i];
      products_[b.index][a.index] = products_[a.index][b.index] = static_cast<Real>(sum);
    }
    b.fresh_length = product(k, k);
    b.number_known = 0;
  }

  void compute_products()
  {
    for(std::size_t k = 0; k < dimension_; ++k)
      compute_products(k, k);
  }

  // b_k -= factor * b_j, for j < k; false if the integers are too large.
  bool subtract_multiple(std::size_t k, std::size_t j, Real factor)
  {
    if(!(std::abs(factor) < Real(largest_factor)))
      return false;
    Basis_vector &b = basis_[k], &a = basis_[j];
    const std::int64_t q = static_cast<std::int64_t>(factor);
    if(!add_multiple(b.coefficients, -q, a.coefficients))
      return false;
    if(!add_multiple(a.dual, q, b.dual))
    {
      add_multiple(b.coefficients, q, a.coefficients);
      return false;
    }
    for(std::size_t l = 0; l < j; ++l)
      b.mu[l] -= factor * a.mu[l];
    b.mu[j] -= factor;
    for(std::size_t l = 0; l <= j; ++l)
      b.r[l] -= factor * a.r[l];

    std::vector<Real> &row = products_[b.index], &other = products_[a.index];
    for(std::size_t l = 0; l < dimension_; ++l)
      row[l] -= factor * other[l];
    row[b.index] -= factor * row[a.index];
    for(std::size_t l = 0; l < dimension_; ++l)
      products_[l][b.index] = row[l];
    return true;
  }

  // Size reduction: |mu_kj| <= 1/2 for all j < k. False if the integers are too large. Rounds are repeated where much has
  // cancelled: the length is at least 2^10 times less every time.
  bool size_reduce(std::size_t k, bool& has_changed)
  {
    for(int round = 0; round < most_rounds; ++round)
    {
      orthogonalize(k);
      for(std::size_t j = k; j-- > 0; )
        if(std::abs(basis_[k].mu[j]) > eta())
        {
          if(!subtract_multiple(k, j, std::round(basis_[k].mu[j])))
            return false;
          has_changed = true;
        }
      if(!(product(k, k) < std::ldexp(basis_[k].fresh_length, -20)))
        return true;
      compute_products(k, dimension_ - 1);
    }
    return false;
  }

  // Where b_k is to be inserted, k if the Lovasz condition holds: the first i for which b_k, less its components
  // along b_0 ... b_{i-1}, is shorter than b*_i. Without deep insertions i = k - 1 alone is tried.
  std::size_t insertion_place(std::size_t k, bool is_deep) const
  {
    const Basis_vector& b = basis_[k];
    const std::size_t first = is_deep || k == 0 ? 0 : k - 1;
    std::size_t place = k;
    Real rest = square_length(k);
    for(std::size_t i = k; i-- > first; )
    {
      rest += b.mu[i] * b.r[i];
      if(rest < delta() * square_length(i))
        place = i;
    }
    return place;
  }

  // Moves b_k before b_i.
  void insert(std::size_t k, std::size_t i)
  {
    std::rotate(basis_.begin() + std::ptrdiff_t(i), basis_.begin() + std::ptrdiff_t(k), basis_.begin() + std::ptrdiff_t(k) + 1);
    for(std::size_t l = i; l < dimension_; ++l)
      basis_[l].number_known = (std::min)(basis_[l].number_known, i);
  }

  // False if it had to end before the basis was reduced.
  bool reduce(bool is_deep, std::size_t most_steps, bool& has_changed)
  {
    std::size_t k = 0;
    for(std::size_t step = 0; k < dimension_; ++step)
    {
      if(step == most_steps || !size_reduce(k, has_changed))
        return false;
      const std::size_t i = insertion_place(k, is_deep);
      if(i < k)
      {
        insert(k, i);
        has_changed = true;
        k = i;
      }
      else
        ++k;
    }
    return true;
  }

  Eigen::MatrixXd gram_;
  std::size_t dimension_;
  std::vector<std::vector<Real> > products_;
  std::vector<Basis_vector> basis_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LATTICES_LATTICE_REDUCTION_H
