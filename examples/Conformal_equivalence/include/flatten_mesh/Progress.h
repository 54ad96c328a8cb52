// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_PROGRESS_H
#define FLATTEN_MESH_PROGRESS_H

#include <CGAL/Conformal_equivalence/options.h>

#include <cstddef>
#include <ostream>
#include <string>

namespace flattening {

// Shows on a terminal how far the computation is, in one line that is wiped out at the end.
class Progress
{
public:
  Progress(std::ostream& err, bool is_shown) : err_(err), is_shown_(is_shown) {}
  ~Progress() { show(""); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& line)
  {
    if(is_shown_)
      err_ << "\r\033[K" << line << std::flush;
  }

private:
  std::ostream& err_;
  bool is_shown_;
};

// Whether `err` is the standard error stream, and a person looks at it.
bool is_terminal(const std::ostream& err);

struct Progress_visitor : CGAL::Conformal_equivalence::Default_visitor
{
  Progress* progress;

  explicit Progress_visitor(Progress& progress) : progress(&progress) {}

  void on_stage(CGAL::Conformal_equivalence::Stage stage);
  void on_iteration(std::size_t iteration, double residual);
};

} // namespace flattening

#endif // FLATTEN_MESH_PROGRESS_H
