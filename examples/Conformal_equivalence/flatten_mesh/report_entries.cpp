// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/report_entries.h"

#include <CGAL/Conformal_equivalence/version.h>
#include <CGAL/version.h>

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
#  include <nlohmann/json.hpp>
#endif

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
namespace {

nlohmann::ordered_json json_options(const Options& options)
{
  auto json = nlohmann::ordered_json::object();
  for(const Given_option& option : options.given)
  {
    const nlohmann::ordered_json value = option.value ? nlohmann::ordered_json(*option.value) : nlohmann::ordered_json(true);
    if(! json.contains(option.name))
      json[option.name] = value;
    else if(json[option.name].is_array())
      json[option.name].push_back(value);
    else
      json[option.name] = nlohmann::ordered_json::array({json[option.name], value});
  }
  return json;
}

} // namespace

void begin_report(const Options& options, nlohmann::ordered_json& report)
{
  report["program"] = "flatten_mesh";
  report["version"] = CGAL_CONFORMAL_EQUIVALENCE_VERSION;
  report["cgal"] = CGAL_VERSION_STR;
  report["input"] = options.input;
  report["options"] = json_options(options);
}

std::string report_of_failure(const Options& options, const std::string& message)
{
  nlohmann::ordered_json report;
  begin_report(options, report);
  report["status"] = "FAILED";
  report["message"] = message;
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}
#else
std::string report_of_failure(const Options&, const std::string&) { return std::string(); }
#endif

std::string joint_report(const std::vector<std::string>& reports)
{
  std::string joint;
  for(const std::string& report : reports)
    joint += (joint.empty() ? "[\n" : ",\n") + report.substr(0, report.find_last_not_of('\n') + 1);
  return joint + "\n]\n";
}

} // namespace flattening
