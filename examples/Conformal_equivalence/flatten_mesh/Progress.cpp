// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/Progress.h"
#include "../include/flatten_mesh/figures.h"
#include "../include/flatten_mesh/messages.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <iostream>
#include <string>

#if defined(__unix__) || defined(__APPLE__)
#  include <unistd.h>
#endif

namespace flattening {

namespace {

const double patience = 2;         // seconds in which nothing is said where no terminal is
const double seconds_to_next = 10; // between lines of one stage, and between those of different ones: components may have many short stages
const double seconds_to_other = 1;

volatile std::sig_atomic_t number_of_interrupts = 0;
bool is_heeded = false;

void note_interrupt(int signal)
{
  number_of_interrupts = 1;
  std::signal(signal, SIG_DFL);
}

std::string bar(double part)
{
  const int width = 20, done = int(std::lround(width * (std::min)(1., part)));
  return part < 0 ? "" : " [" + std::string(std::size_t(done), '#') + std::string(std::size_t(width - done), '.') + "]";
}

} // namespace

Progress::~Progress()
{
  if(kind_ == Kind::ONE_LINE)
    err_ << "\r\033[K" << std::flush;
}

void Progress::begin(const std::string& stage)
{
  if(stage == stage_)
    return;
  stage_ = stage;
  stage_began_ = watch_.seconds();
  is_told_ = false;
  show("", -1);
}

void Progress::show(const std::string& details, double part)
{
  const double now = watch_.seconds();
  if(kind_ == Kind::ONE_LINE)
  {
    err_ << "\r\033[K" << stage_ << bar(part) << details;
    if(now - stage_began_ >= 1)
      err_ << ", " << std::lround(now - stage_began_) << " s";
    err_ << std::flush;
  }
  else if(kind_ == Kind::LINES && now >= patience && now >= last_line_ + (is_told_ ? seconds_to_next : seconds_to_other))
  {
    err_ << "flatten_mesh: " << stage_ << details << ", " << std::lround(now) << " s" << std::endl;
    last_line_ = now;
    is_told_ = true;
  }
}

Progress::Kind kind_of_progress(const std::ostream& err, bool is_quiet)
{
  if(is_quiet || &err != &std::cerr)
    return Progress::Kind::NOTHING;
#if defined(__unix__) || defined(__APPLE__)
  if(isatty(STDERR_FILENO))
    return Progress::Kind::ONE_LINE;
#endif
  return Progress::Kind::LINES;
}

void stop_at_interrupt()
{
  number_of_interrupts = 0;
  is_heeded = false;
  std::signal(SIGINT, note_interrupt);
}

bool was_interrupted() { return number_of_interrupts != 0; }

bool is_interrupted() { return was_interrupted() && ! is_heeded; }

void heed_interrupt() { is_heeded = true; }

bool is_interrupt_heeded() { return is_heeded; }

void Progress_visitor::on_stage(CGAL::Conformal_equivalence::Stage next)
{
  stage = next;
  first_residual = 0;
  progress->begin(CGAL::Conformal_equivalence::stage_name(stage));
}

// Newton's method gains digits: what part of them it has is how far it is.
void Progress_visitor::on_iteration(std::size_t iteration, double residual)
{
  const double digits = 12;
  first_residual = (std::max)(first_residual, residual);
  const double part = residual > 0 ? std::log10(first_residual / residual) / (digits + std::log10((std::max)(first_residual, 1e-11))) : 1;
  progress->show(text(": Newton step ", iteration, ", residual ", residual), (std::max)(0., part));
}

// Flips are a part of what is going on; a search may have solved for a metric in between.
void Progress_visitor::on_progress(CGAL::Conformal_equivalence::Stage next, std::size_t number, double measure)
{
  using CGAL::Conformal_equivalence::Stage;
  if(next == Stage::FLIP)
    return progress->show(text(": flipping edges, ", count(number, "flip", "flips"), ", ", measure, " edges to look at"), -1);
  stage = next;
  progress->begin(CGAL::Conformal_equivalence::stage_name(stage));
  if(next == Stage::POSITIONS)
    return progress->show(text(": ", count(number, "choice", "choices"), ", about ", std::round(measure), " tiles"), -1);
  progress->show(text(": ", next == Stage::CORNERS ? count(number, "metric", "metrics") : count(number, "cone", "cones"), ", ", measure), -1);
}

} // namespace flattening
