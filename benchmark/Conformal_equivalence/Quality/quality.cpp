// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How good the layouts of one mesh are that this package and CGAL's parameterizers make:
//
//   quality MESH [METHOD...]
//
// MESH as for `performance`; methods `ours`, `lscm`, `arap`, `dcm` unless named. Prints a row of a
// Markdown table for each, `quality --header` the head of the table. Ends with status 2 if
// MESH is no disk.

#include "../include/methods.h"
#include "../include/table.h"

#include <CGAL/exceptions.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace benchmarks;

const std::vector<std::string> columns = {
  "mesh", "vertices", "method", "Newton steps", "max &#124;u&#124;", "mean qc", "max qc", "flips", "injective",
  "border error", "layout error" };

std::vector<std::string> failure(const std::vector<std::string>& head, std::string why)
{
  std::vector<std::string> row = head;
  row.push_back(why.substr(0, why.find(';'))); // without the elements at fault
  row.resize(columns.size());
  return row;
}

std::vector<std::string> row_of(const std::string& specification, const std::string& method)
{
  Mesh mesh = make_mesh(specification);
  const std::vector<std::string> head = { name_of(specification), std::to_string(num_vertices(mesh)), method };
  const UV_map uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv", Point_2(0, 0)).first;
  Result result;
  try
  {
    result = run_method(method, mesh, uv);
  }
  catch(const CGAL::Failure_exception& error)
  {
    return failure(head, "exception: " + error.expression());
  }
  if(!result.is_success)
    return failure(head, result.message);

  const bool is_ours = method.compare(0, 4, "ours") == 0;
  const Quality quality = measure(mesh, uv);
  std::vector<std::string> row = head;
  row.push_back(is_ours ? std::to_string(result.statistics.number_of_iterations) : "");
  row.push_back(is_ours ? to_text(result.largest_u, 4) : "");
  row.push_back(to_text(quality.mean_qc, 6));
  row.push_back(to_text(quality.max_qc, 4));
  row.push_back(std::to_string(quality.flips));
  row.push_back(to_string(quality.injectivity));
  row.push_back(to_text(quality.border_error, 2));
  row.push_back(is_ours ? to_text(result.layout_length_error, 2) : "");
  return row;
}

int run(const std::string& specification, std::vector<std::string> methods)
{
  if(!is_disk(make_mesh(specification)))
    return 2;
  if(methods.empty())
    methods = { "ours", "lscm", "arap", "dcm" };
  for(const std::string& method : methods)
    print_row(row_of(specification, method));
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if(!arguments.empty() && arguments[0] == "--header")
  {
    print_head(columns);
    return EXIT_SUCCESS;
  }
  try
  {
    if(arguments.empty())
      return run("terrain:10000", {});
    return run(arguments[0], std::vector<std::string>(arguments.begin() + 1, arguments.end()));
  }
  catch(const std::exception& error)
  {
    std::cerr << "quality: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
