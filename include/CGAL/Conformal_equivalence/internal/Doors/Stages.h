// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The steps of a computation on a mesh, one after the other. A step is done only if all went well before, which the report tells, and
// exhausted memory becomes a status.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_STAGES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_STAGES_H

#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <new>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The seconds of a stage among those of all stages.
inline double& seconds_of_stage(Stage stage, Statistics::Seconds& seconds)
{
  switch(stage)
  {
    case Stage::IMPORT: return seconds.import;
    case Stage::SOLVE:  return seconds.solve;
    case Stage::CUT:    return seconds.cut;
    case Stage::POSITIONS:
    case Stage::LAYOUT: return seconds.layout;
    case Stage::VERIFY:
    case Stage::PLACE:
    case Stage::CORNERS:
    case Stage::FLIP:   break;
  }
  return seconds.verify;
}

// Does some work, with the visitor told, and adds the seconds that it took.
template <typename Visitor, typename Work>
void timed(double& seconds, Stage stage, Visitor& visitor, Work work)
{
  const Stopwatch stopwatch;
  visitor.on_stage(stage);
  work();
  seconds += stopwatch.seconds();
}

// Does `work()`, if all went well before.
template <typename Report, typename Work>
void run_step(Report& report, Work work)
{
  if(!bool(report))
    return;
  try
  {
    work();
  }
  catch(const std::bad_alloc&)
  {
    report.status = Status::OUT_OF_MEMORY;
  }
}

// The same for a step that is a stage: the visitor is told, and the seconds are added to those of the stage.
template <typename Report, typename Work>
void run_stage(Stage stage, const Any_visitor& visitor, Report& report, Work work)
{
  run_step(report, [&]
  {
    double seconds = 0;
    timed(seconds, stage, visitor, work);
    seconds_of_stage(stage, report.statistics.seconds) += seconds; // `work` may have made the report anew
  });
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_STAGES_H
