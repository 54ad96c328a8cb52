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

  /// is called in stages that take long, whenever they have come further: in `CGAL::Conformal_equivalence::Stage::PLACE` after each cone; in
  /// `CGAL::Conformal_equivalence::Stage::CORNERS` after each metric; in `CGAL::Conformal_equivalence::Stage::POSITIONS` before each choice of lattice points is
  /// tried; in `CGAL::Conformal_equivalence::Stage::FLIP` four times a second, where flips take that long. A visitor need not have this function.
  /// \param stage which it is
  /// \param number how many cones are placed, metrics are solved for, choices are tried, or edges are flipped by now
  /// \param measure for cones, the measure that is made small (`CGAL::Conformal_equivalence::Cone_measure`), as the search sees it with these cones:
  ///        before they are moved to better places, and to first order in u; for corners, the Dirichlet energy of u of this metric; for lattice points, the number of tiles aimed at; for flips, how
  ///        many edges are to be looked at, as far as is known
  void on_progress(CGAL::Conformal_equivalence::Stage stage, std::size_t number, double measure);

  /// is asked before each Newton step, for each cone that is placed or moved, for each choice of lattice points, and four times a second while edges are flipped. If `false` is returned, the computation ends with the status
  /// `CGAL::Conformal_equivalence::Status::STOPPED_BY_VISITOR`, and no map is written.
  bool go_further();
};
