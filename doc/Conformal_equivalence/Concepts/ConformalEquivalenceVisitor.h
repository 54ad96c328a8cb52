// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgConformalEquivalenceConcepts
\cgalConcept

The concept `ConformalEquivalenceVisitor` describes what can be passed as the named parameter
`visitor`: it is told what a computation is doing, and may stop it.

All functions are called from the thread that called the package. A visitor whose state is to be read
afterwards is passed by `std::ref()`; otherwise a copy is used.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Conformal_equivalence::Default_visitor}
\cgalHasModelsEnd
*/
class ConformalEquivalenceVisitor
{
public:
  /// is called when `stage` begins. A solver that is used by itself has the stage
  /// `CGAL::Conformal_equivalence::Stage::SOLVE` only.
  void on_stage(CGAL::Conformal_equivalence::Stage stage);

  /// is called with the residual found before each Newton step, and after the last one.
  /// \param iteration the number of steps taken so far, from 0
  /// \param residual the largest difference of an angle sum from its target, in radians
  void on_iteration(std::size_t iteration, double residual);

  /// is asked before each Newton step. If `false` is returned, the computation ends with the status
  /// `CGAL::Conformal_equivalence::Status::STOPPED_BY_VISITOR`, and no map is written.
  bool go_further();
};
