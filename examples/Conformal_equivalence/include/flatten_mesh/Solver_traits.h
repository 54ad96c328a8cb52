// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SOLVER_TRAITS_H
#define FLATTEN_MESH_SOLVER_TRAITS_H

#include <CGAL/Conformal_equivalence/Eigen_pattern_solver_traits.h>
#include <CGAL/Conformal_equivalence/Multifrontal_solver_traits.h>

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace flattening {

// The linear solver that --solver names. It is chosen while the program runs, so that all that stands on it is compiled for one
// type. A copy is a solver of the same kind that has nothing to solve yet.
class Solver_traits
{
  typedef CGAL::Conformal_equivalence::Multifrontal_solver_traits Multifrontal;
  typedef CGAL::Conformal_equivalence::Simplicial_solver_traits   Simplicial;
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
  typedef CGAL::Conformal_equivalence::Cholmod_solver_traits      Cholmod;
  typedef std::variant<Multifrontal, Simplicial, Cholmod>         Solver;
#else
  typedef std::variant<Multifrontal, Simplicial>                  Solver;
#endif

public:
  typedef Multifrontal::Matrix Matrix;
  typedef Multifrontal::Vector Vector;
  typedef Multifrontal::NT     NT;

  // of a name that is known, or the default
  explicit Solver_traits(const std::string& name)
  {
    if(name == "simplicial")
      solver_.emplace<Simplicial>();
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
    if(name == "cholmod")
      solver_.emplace<Cholmod>();
#endif
  }

  Solver_traits(const Solver_traits& other)
    : solver_(std::visit([](const auto& solver) { return Solver(std::decay_t<decltype(solver)>()); }, other.solver_))
  {}

  Solver_traits(Solver_traits&&) = default;
  Solver_traits& operator=(const Solver_traits&) = delete;
  Solver_traits& operator=(Solver_traits&&) = default;

  bool analyze_pattern(const Matrix& A)
  {
    return std::visit([&](auto& solver) { return solver.analyze_pattern(A); }, solver_);
  }

  bool refactor(const Matrix& A, NT& D)
  {
    return std::visit([&](auto& solver) { return solver.refactor(A, D); }, solver_);
  }

  bool factor(const Matrix& A, NT& D)
  {
    return std::visit([&](auto& solver) { return solver.factor(A, D); }, solver_);
  }

  bool linear_solver(const Vector& B, Vector& X)
  {
    return std::visit([&](auto& solver) { return solver.linear_solver(B, X); }, solver_);
  }

  bool linear_solver(const Matrix& A, const Vector& B, Vector& X, NT& D)
  {
    return std::visit([&](auto& solver) { return solver.linear_solver(A, B, X, D); }, solver_);
  }

  bool precondition(const Vector& B, Vector& X)
  {
    Multifrontal* const multifrontal = std::get_if<Multifrontal>(&solver_);
    return multifrontal != nullptr ? multifrontal->precondition(B, X) : linear_solver(B, X);
  }

private:
  Solver solver_;
};

} // namespace flattening

#endif // FLATTEN_MESH_SOLVER_TRAITS_H
