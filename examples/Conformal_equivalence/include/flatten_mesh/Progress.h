// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What is told of a computation while it is going on, and how it is stopped.

#ifndef FLATTEN_MESH_PROGRESS_H
#define FLATTEN_MESH_PROGRESS_H

#include "Stopwatch.h"

#include <CGAL/Conformal_equivalence/options.h>

#include <cstddef>
#include <ostream>
#include <string>

namespace flattening {

// On a terminal one line, with a bar where it is known how much is left to do, which is wiped out at the end. Elsewhere a line for each stage, and
// for one that takes long another from time to time; but nothing at all of what is done in a moment.
class Progress
{
public:
  enum class Kind { NOTHING, ONE_LINE, LINES };

  Progress(std::ostream& err, Kind kind) : err_(err), kind_(kind) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // A stage begins, which is called so.
  void begin(const std::string& stage);

  // How far it is: `part` of it, from 0 to 1, is done; negative if that is not known.
  void show(const std::string& details, double part);

private:
  std::ostream& err_;
  const Kind kind_;
  const Stopwatch watch_;
  std::string stage_;
  bool is_told_ = false;                   // is there a line for this stage?
  double stage_began_ = 0, last_line_ = 0; // seconds
};

// For a person who looks at the standard error stream, or a file that it is written to.
Progress::Kind kind_of_progress(const std::ostream& err, bool is_quiet);

// From now on an interrupt (Ctrl-C) ends the computation in good order, with nothing written, or ends a search, of which the best so far is taken;
// a second one ends the program at once.
void stop_at_interrupt();
bool was_interrupted();

// Whether the interrupt is still to be heeded; after heed_interrupt() it is not any more: what is left to do is done.
bool is_interrupted();
void heed_interrupt();
bool is_interrupt_heeded();

struct Progress_visitor : CGAL::Conformal_equivalence::Default_visitor
{
  Progress* progress;
  CGAL::Conformal_equivalence::Stage stage = CGAL::Conformal_equivalence::Stage::IMPORT;
  double first_residual = 0;

  explicit Progress_visitor(Progress& progress) : progress(&progress) {}

  void on_stage(CGAL::Conformal_equivalence::Stage next);
  void on_iteration(std::size_t iteration, double residual);
  void on_progress(CGAL::Conformal_equivalence::Stage next, std::size_t number, double measure);
  bool go_further() { return ! is_interrupted(); }
};

} // namespace flattening

#endif // FLATTEN_MESH_PROGRESS_H
