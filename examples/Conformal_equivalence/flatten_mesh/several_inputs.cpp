// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/several_inputs.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/Progress.h"
#include "../include/flatten_mesh/report_entries.h"
#include "../include/flatten_mesh/write_outputs.h"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <ostream>
#include <string>
#include <vector>

namespace flattening {

namespace {

// Its name without folder and extension.
std::string name_of_input(const std::string& input)
{
  return is_standard_stream(input) ? "layout" : std::filesystem::path(input).stem().string();
}

std::string with_name(const std::string& pattern, const std::string& name)
{
  std::string file;
  for(std::size_t i = 0; i < pattern.size(); ++i)
    if(pattern[i] != '%')
      file += pattern[i];
    else if(i + 1 < pattern.size() && pattern[i + 1] == '%')
      file += pattern[++i];
    else
      file += name;
  return file;
}

// Throws a `Usage_error` if two outputs of all inputs have the same name, or one would overwrite an input. What else may be wrong with one of
// them is said when its turn comes.
void check_names(const Options& all, std::ostream& out)
{
  Output_files files(out);
  for(std::size_t i = 0; i < all.inputs.size(); ++i)
    try
    {
      Options options = options_of_input(all, i);
      if(options.is_report_joint)
        options.report.clear();
      announce_outputs(options, material_files(options), files);
    }
    catch(const Failure&) {}
  if(const Options first = options_of_input(all, 0); first.is_report_joint)
    files.announce(first.report);
  for(const std::string& input : all.inputs)
    if(! is_standard_stream(input) && files.is_announced(input))
      throw Usage_error("an output would overwrite the input " + input);
}

std::string message_of(const std::exception& e)
{
  return dynamic_cast<const std::bad_alloc*>(&e) != nullptr ? "out of memory" : one_line(e.what());
}

} // namespace

bool names_input(const std::string& file)
{
  return with_name(file, "a") != with_name(file, "b");
}

std::string literal_name(const std::string& file)
{
  std::string pattern;
  for(char c : file)
    pattern += c == '%' ? std::string("%%") : std::string(1, c);
  return pattern;
}

Options options_of_input(const Options& all, std::size_t i)
{
  Options options = all;
  options.input = all.inputs[i];
  options.is_report_joint = all.inputs.size() > 1 && ! all.report.empty() && ! names_input(all.report);
  for(std::string* file : places_of_outputs(options))
    *file = with_name(*file, name_of_input(options.input));
  return options;
}

bool run_each(const Options& all, const std::function<void(const Options&, Output_files&)>& run, std::ostream& out, std::ostream& err)
{
  check_names(all, out);
  const Options first = options_of_input(all, 0);
  Output_files joint_file(out);
  if(first.is_report_joint)
    joint_file.announce(first.report);

  std::vector<std::string> reports;
  bool are_all_done = true;
  for(std::size_t i = 0; i < all.inputs.size(); ++i)
  {
    const Options options = options_of_input(all, i);
    std::string report;
    Output_files files(out);
    if(options.is_report_joint)
      files.keep(options.report, report);
    try
    {
      if(was_interrupted())
        fail(options.input, ": interrupted");
      run(options, files);
    }
    catch(const std::exception& e)
    {
      are_all_done = false;
      err << "flatten_mesh: " << message_of(e) << std::endl;
      report = report_of_failure(options, message_of(e));
    }
    reports.push_back(report);
  }

  if(first.is_report_joint)
  {
    joint_file.write(first.report, [&](std::ostream& o) { return (o << joint_report(reports)).good(); });
    joint_file.commit();
    if(! all.quiet && ! is_standard_stream(first.report))
      out << "wrote " << first.report << '\n';
  }
  return are_all_done;
}

} // namespace flattening
