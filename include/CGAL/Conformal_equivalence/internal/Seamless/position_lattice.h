// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Where the cones of a seamless layout can be (section 6.1 of Springborn, Schroeder and Pinkall, 2008).
//
// The unknowns are the positions q of the cones, in their first corners, and the translations T across the paths of the cut. They must be
// points of the lattice of the texture, and go together: once around a special vertex the motions z -> rho_j z + T_j or back make
//
//     z -> rho z + (sum of powers of theta times the T_j),
//
// which is the identity at a vertex that is no cone, and leaves q where it is at a cone: one linear equation each, with coefficients in the ring
// Z[theta]. One cone lies in the origin. These are the conditions A d = 0, B d integral of the paper, without the sides d of the meta-polygon that
// are free anyway. The solutions are a module over Z[theta]; as that ring is Euclidean, columns are combined like the rows of
// integers in Euclid's algorithm until all equations are used up: what is left over is a basis of *all* integral
// solutions, not of a part of them.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_POSITION_LATTICE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_POSITION_LATTICE_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Integer.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Lattice_number.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Meta_polygon.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A matrix over the ring, by columns, without its zeros.
struct Sparse_columns
{
  typedef std::map<std::size_t, Lattice_number> Column; // by row

  std::vector<Column> columns;

  // column i += factor * column j
  void add(std::size_t i, const Lattice_number& factor, std::size_t j, const Lattice_ring& ring)
  {
    for(const auto& entry : columns[j])
    {
      Lattice_number& x = columns[i][entry.first];
      x = x + ring.product(factor, entry.second);
      if(x.is_zero())
        columns[i].erase(entry.first);
    }
  }

  const Lattice_number* find(std::size_t row, std::size_t column) const
  {
    const auto found = columns[column].find(row);
    return found == columns[column].end() ? nullptr : &found->second;
  }
};

// A basis of the vectors x over the ring with `equations` x = 0: the columns of the result.
inline Sparse_columns integral_null_space(Sparse_columns equations, std::size_t number_of_equations, const Lattice_ring& ring)
{
  const std::size_t n = equations.columns.size();
  Sparse_columns unimodular;
  unimodular.columns.resize(n);
  std::vector<std::size_t> free(n);
  for(std::size_t i = 0; i < n; ++i)
  {
    unimodular.columns[i][i] = Lattice_number(1);
    free[i] = i;
  }
  for(std::size_t row = 0; row < number_of_equations; ++row)
  {
    std::vector<std::size_t> nonzero;
    for(std::size_t c : free)
      if(equations.find(row, c) != nullptr)
        nonzero.push_back(c);
    while(!nonzero.empty())
    {
      // the smallest one divides the others, with remainders; of the smallest ones the one of the shortest column
      const std::size_t pivot = *std::min_element(nonzero.begin(), nonzero.end(), [&](std::size_t c, std::size_t d)
      {
        const Integer x = ring.norm(*equations.find(row, c)), y = ring.norm(*equations.find(row, d));
        return x != y ? x < y : unimodular.columns[c].size() < unimodular.columns[d].size();
      });
      std::vector<std::size_t> left(1, pivot);
      for(std::size_t c : nonzero)
      {
        if(c == pivot)
          continue;
        const Lattice_number q = Lattice_number() - ring.quotient(*equations.find(row, c), *equations.find(row, pivot));
        equations.add(c, q, pivot, ring);
        unimodular.add(c, q, pivot, ring);
        if(equations.find(row, c) != nullptr)
          left.push_back(c);
      }
      nonzero = std::move(left);
      if(nonzero.size() == 1)
      {
        free.erase(std::find(free.begin(), free.end(), pivot));
        break;
      }
    }
  }
  Sparse_columns result;
  for(std::size_t c : free)
    result.columns.push_back(std::move(unimodular.columns[c]));
  return result;
}

// The lattice of the admissible positions and translations.
struct Position_lattice
{
  typedef Lattice_coordinates<std::int64_t> Point;

  std::size_t number_of_cones = 0;
  std::vector<std::vector<Point> > basis;  // each: the positions of the cones, then the translations of the paths
  bool fits = true;                        // whether all numbers are below 2^40: sums and rotations of them then are in the range of 64 bits

  std::size_t rank() const { return basis.size(); }
};

// The equations of the relations, and of the origin: the position of the first cone; where there is none, the translation of the first path that
// turns.
inline Sparse_columns position_equations(const Meta_polygon& polygon, std::size_t number_of_cones, const Texture_lattice& lattice,
                                         const Lattice_ring& ring, std::size_t& number_of_equations)
{
  typedef Meta_polygon::Index Index;
  const auto rotation = [&](int quanta) { return ring.unit(lattice.reduced(quanta) * (lattice.order() / lattice.symmetry())); };

  Sparse_columns equations;
  equations.columns.resize(number_of_cones + polygon.paths.size());
  std::size_t row = 0;
  const auto add = [&](std::size_t column, const Lattice_number& x)
  {
    Lattice_number& entry = equations.columns[column][row];
    entry = entry + x;
    if(entry.is_zero())
      equations.columns[column].erase(row);
  };
  if(number_of_cones > 0)
    add(0, Lattice_number(1)), ++row;
  else
    for(Index p = 0; p < polygon.paths.size(); ++p)
      if(polygon.paths[p].quanta != 0)
      {
        add(p, Lattice_number(1));
        ++row;
        break;
      }

  for(const Meta_polygon::Relation& relation : polygon.relations)
  {
    int turned = 0;
    for(const Meta_polygon::Crossing& c : relation.crossings)
      turned += polygon.quanta(c);
    const int whole = turned;
    for(const Meta_polygon::Crossing& c : relation.crossings)
    {
      // forward: T is added, and turned by all that follows; back: -T is, before the rotation of the crossing itself
      turned -= polygon.quanta(c);
      const Lattice_number after = rotation(turned);
      if(c.is_forward)
        add(number_of_cones + c.path, after);
      else
        add(number_of_cones + c.path, Lattice_number() - ring.product(after, rotation(polygon.quanta(c))));
    }
    if(relation.cone != Meta_polygon::null_index)
      add(relation.cone, rotation(whole) - Lattice_number(1));
    ++row;
  }
  number_of_equations = row;
  return equations;
}

inline Position_lattice position_lattice(const Meta_polygon& polygon, std::size_t number_of_cones, const Texture_lattice& lattice)
{
  Position_lattice result;
  result.number_of_cones = number_of_cones;
  std::size_t number_of_equations = 0;
  const Lattice_ring ring(lattice.trace());
  Sparse_columns equations = position_equations(polygon, number_of_cones, lattice, ring, number_of_equations);
  const Sparse_columns solutions = integral_null_space(std::move(equations), number_of_equations, ring);
  const double most = 1099511627776.; // 2^40
  const auto narrow = [&](const Integer& x)
  {
    const double value = double(x);
    result.fits = result.fits && std::abs(value) < most;
    return result.fits ? std::int64_t(value) : 0;
  };
  for(const auto& column : solutions.columns)
  {
    std::vector<Position_lattice::Point> vector(number_of_cones + polygon.paths.size(), Position_lattice::Point{{0, 0}});
    for(const auto& entry : column)
      vector[entry.first] = {{narrow(entry.second.a), narrow(entry.second.b)}};
    result.basis.push_back(std::move(vector));
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_POSITION_LATTICE_H
