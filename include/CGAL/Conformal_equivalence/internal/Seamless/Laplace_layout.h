// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The generalized Laplace layout (section 6.2 of Springborn, Schroeder and Pinkall, 2008): the positions z of the vertices of a flat surface that
// have least conformal energy, where the motions across the cut, and the positions of the cones, are given.
//
// A piecewise linear map f of a flat triangle with corners Z_0, Z_1, Z_2 has the derivative
//
//     f_zbar = i / (4 A) (f_0 e_0 + f_1 e_1 + f_2 e_2),      e_k = Z_{k+2} - Z_{k+1},   A its area,
//
// which is zero iff f is a similarity. The conformal energy, Dirichlet's minus the area of the image, is the sum of
//
//     2 A |f_zbar|^2  =  |f_0 e_0 + f_1 e_1 + f_2 e_2|^2 / (8 A)
//
// over all triangles. The corners are f_k = rho z_v + tau, where (rho, tau) takes the corner that stands for the vertex v to this one. So
// the energy is a Hermitian form in the z_v and the data. Over an inner edge both triangles give the same factor but for the area's part, which
// cancels: with 1/4 (cot + cot) there it is the cotangent Laplacian of the edges; on borders the area's part stays, the natural
// condition (Desbrun, Meyer and Alliez, 2002; Levy et al., 2002). Where the data are those of the flat surface the energy is zero, and z is the
// layout itself.
//
// Triangles may be negative, as where straight lines replace the edges of a triangulation that was flipped. They count with the absolute value of the
// area.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LAPLACE_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LAPLACE_LAYOUT_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Meta_polygon.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Laplace_layout
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<double> Triangulation;

public:
  typedef std::complex<double> Complex;

  // What the layout hangs on: the motions of the polygon with these translations (by number of the motion), and the positions of
  // the vertices that are fixed.
  struct Data
  {
    std::vector<Complex> translation;
    std::vector<Complex> fixed;
  };

  // `corner` are those of a flat layout, of moderate size. Keeps references.
  Laplace_layout(const Triangulation& t, const std::vector<Complex>& corner, const Meta_polygon& polygon, const Texture_lattice& lattice,
                 const std::vector<Index>& fixed, std::unique_ptr<Factorization> factorization)
    : t_(t), corner_(corner), polygon_(polygon), factor_(std::move(factorization)), number_(t.number_of_vertices(), t.null_index)
  {
    const std::vector<Lattice_coordinates<double> > zero(polygon.paths.size(), Lattice_coordinates<double>{{0, 0}});
    for(const auto& motion : polygon.values(zero))
      rotation_of_motion_.push_back(lattice.rotation(motion.quanta));

    std::vector<char> is_fixed(t.number_of_vertices(), 0);
    for(Index v : fixed)
      is_fixed[v] = 1;
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v) && !is_fixed[v])
        number_[v] = number_of_free_++;
    fixed_number_.assign(t.number_of_vertices(), t.null_index);
    for(Index i = 0; i < fixed.size(); ++i)
      fixed_number_[fixed[i]] = i;
    for(Index f = 0; f < t.number_of_faces(); ++f)
      if(hangs_on_data(f))
        faces_at_data_.push_back(f);
  }

  // Where rounding has spoiled the matrix, a little is added to its diagonal: the layout then is not quite the best one.
  bool factorize()
  {
    if(number_of_free_ == 0)
      return true;
    const Eigen::SparseMatrix<double> lower = assemble();
    const double first_shift = 1e-13, most = 1e-2; // relative to the diagonal: from a few hundred roundings to what would deform the layout visibly
    for(double shift = 0; shift < most; shift = shift == 0 ? first_shift : 100 * shift)
    {
      Eigen::SparseMatrix<double> shifted = lower;
      for(int i = 0; i < int(shifted.rows()); ++i)
        shifted.coeffRef(i, i) *= 1 + shift;
      if(factor_->factor(std::move(shifted)))
        return true;
    }
    return false;
  }

  // The position of every vertex, in its first corner. Empty if the linear system cannot be solved.
  std::vector<Complex> operator()(const Data& data)
  {
    std::vector<double> b(2 * std::size_t(number_of_free_), 0.);
    for(Index f : faces_at_data_)
    {
      const Face face = face_form(f);
      const Complex c = constant(face, data) * face.weight;
      for(int k = 0; k < 3; ++k)
        if(number_[face.vertex[k]] != t_.null_index)
        {
          const Complex entry = -std::conj(face.factor[k]) * c;
          b[2 * number_[face.vertex[k]]] += entry.real();
          b[2 * number_[face.vertex[k]] + 1] += entry.imag();
        }
    }
    if(number_of_free_ > 0 && !factor_->solve(b))
      return {};
    std::vector<Complex> z(t_.number_of_vertices(), Complex(0, 0));
    for(Index v = 0; v < z.size(); ++v)
      if(number_[v] != t_.null_index)
        z[v] = Complex(b[2 * number_[v]], b[2 * number_[v] + 1]);
      else if(fixed_number_[v] != t_.null_index)
        z[v] = data.fixed[fixed_number_[v]];
    return z;
  }

  // The part of the energy that the data make: by face at the cut or at fixed vertices, sqrt(8 A) f_zbar of the data alone.
  std::vector<Complex> forces(const Data& data) const
  {
    std::vector<Complex> result;
    for(Index f : faces_at_data_)
    {
      const Face face = face_form(f);
      result.push_back(constant(face, data) * std::sqrt(face.weight));
    }
    return result;
  }

  // The same of a whole layout; `z` must be the one for the data. The Hermitian form of the energies is the product of forces of
  // one with responses of the other, as the layout has no force on free vertices.
  std::vector<Complex> responses(const Data& data, const std::vector<Complex>& z) const
  {
    std::vector<Complex> result;
    for(Index f : faces_at_data_)
    {
      const Face face = face_form(f);
      Complex sum = constant(face, data);
      for(int k = 0; k < 3; ++k)
        if(number_[face.vertex[k]] != t_.null_index)
          sum += face.factor[k] * z[face.vertex[k]];
      result.push_back(sum * std::sqrt(face.weight));
    }
    return result;
  }

private:
  // The energy of a face is weight * |sum of factor * z + ...|^2.
  struct Face
  {
    std::array<Index, 3> vertex;
    std::array<Index, 3> motion;
    std::array<Complex, 3> opposite; // e_k
    std::array<Complex, 3> factor;   // e_k rho
    double weight;                   // 1 / (8 A)
    bool is_positive;
  };

  Face face_form(Index f) const
  {
    Face face;
    for(Index k = 0; k < 3; ++k)
    {
      const Index h = t_.halfedge(f, k);
      face.vertex[k] = t_.target(h);
      face.motion[k] = polygon_.motion_of_corner[h];
      face.opposite[k] = corner_[t_.previous(h)] - corner_[t_.next(h)];
      face.factor[k] = face.opposite[k] * rotation_of_motion_[face.motion[k]];
    }
    const Complex &x = face.opposite[0], &y = face.opposite[1];
    const double twice_area = x.real() * y.imag() - x.imag() * y.real();
    const double largest = (std::max)({std::norm(face.opposite[0]), std::norm(face.opposite[1]), std::norm(face.opposite[2])});
    const double least = least_area * largest;
    face.weight = largest > 0 ? 1 / (4 * (std::max)(std::abs(twice_area), least)) : 0;
    face.is_positive = twice_area > least;
    return face;
  }

  bool hangs_on_data(Index f) const
  {
    for(const Index h : t_.halfedges(f))
      if(polygon_.motion_of_corner[h] != 0 || number_[t_.target(h)] == t_.null_index)
        return true;
    return false;
  }

  Complex constant(const Face& face, const Data& data) const
  {
    Complex sum = 0;
    for(int k = 0; k < 3; ++k)
    {
      sum += face.opposite[k] * data.translation[face.motion[k]];
      if(number_[face.vertex[k]] == t_.null_index)
        sum += face.factor[k] * data.fixed[fixed_number_[face.vertex[k]]];
    }
    return sum;
  }

  // The lower half of the real matrix: two rows for every free vertex.
  Eigen::SparseMatrix<double> assemble() const
  {
    std::vector<Eigen::Triplet<double> > entries;
    entries.reserve(2 * std::size_t(number_of_free_) + 4 * std::size_t(t_.number_of_edges()));
    std::vector<double> diagonal(number_of_free_, 0.);
    const auto add_diagonal = [&](Index v, double x)
    {
      if(number_[v] != t_.null_index)
        diagonal[number_[v]] += x;
    };
    for(Index f = 0; f < t_.number_of_faces(); ++f)
    {
      const Face face = face_form(f);
      for(int k = 0; k < 3; ++k)
        add_diagonal(face.vertex[k], std::norm(face.factor[k]) * face.weight);
    }
    for(Index i = 0; i < number_of_free_; ++i)
      for(Index k = 0; k < 2; ++k)
        entries.emplace_back(2 * i + k, 2 * i + k, diagonal[i]);
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      add_edge(e, entries);
    Eigen::SparseMatrix<double> lower(2 * number_of_free_, 2 * number_of_free_);
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
  }

  void add_edge(Index e, std::vector<Eigen::Triplet<double> >& entries) const
  {
    const Index h = t_.edge_halfedge(e), i = t_.target(t_.previous(h)), j = t_.target(h);
    if(number_[i] == t_.null_index || number_[j] == t_.null_index)
      return;
    bool are_positive = true;
    Complex product = product_of_ends(h, are_positive);
    if(!t_.is_border(h))
    {
      product += std::conj(product_of_ends(t_.twin(h), are_positive));
      if(are_positive)
        product = product.real(); // exactly
    }
    const Complex turn = std::conj(rotation_of_motion_[polygon_.motion_of_corner[t_.previous(h)]])
                       * rotation_of_motion_[polygon_.motion_of_corner[h]];
    add_entry(number_[i], number_[j], turn * product, entries);
  }

  // conj(e) e of the corners at the ends of h, times the weight of its face
  Complex product_of_ends(Index h, bool& are_positive) const
  {
    const Face face = face_form(t_.face(h));
    are_positive = are_positive && face.is_positive;
    return std::conj(face.opposite[t_.previous(h) % 3]) * face.opposite[h % 3] * face.weight;
  }

  // The complex entry (i, j), a real block [re -im; im re], with its transpose. A loop gives twice the real part.
  static void add_entry(Index i, Index j, Complex x, std::vector<Eigen::Triplet<double> >& entries)
  {
    if(i < j)
    {
      std::swap(i, j);
      x = std::conj(x);
    }
    const double re = i == j ? 2 * x.real() : x.real();
    entries.emplace_back(2 * i, 2 * j, re);
    entries.emplace_back(2 * i + 1, 2 * j + 1, re);
    if(i != j && x.imag() != 0)
    {
      entries.emplace_back(2 * i, 2 * j + 1, -x.imag());
      entries.emplace_back(2 * i + 1, 2 * j, x.imag());
    }
  }

  // Twice the area of a triangle, over the square of its longest side: below this its digits are rounding, and it counts as if it had this area.
  static constexpr double least_area = 1e-12;

  const Triangulation& t_;
  const std::vector<Complex>& corner_;
  const Meta_polygon& polygon_;
  std::unique_ptr<Factorization> factor_;
  std::vector<Complex> rotation_of_motion_;
  std::vector<Index> number_;               // by vertex: of those that are free
  std::vector<Index> fixed_number_;         // by vertex
  std::vector<Index> faces_at_data_;        // where the cut or a fixed vertex is felt
  Index number_of_free_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LAPLACE_LAYOUT_H
