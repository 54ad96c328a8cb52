// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Tables in Markdown.

#ifndef CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_TABLE_H
#define CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_TABLE_H

#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace benchmarks {

typedef std::vector<std::string> Cells;

inline void print_row(const Cells& cells)
{
  for(const std::string& cell : cells)
    std::cout << "| " << cell << ' ';
  std::cout << '|' << std::endl;
}

inline void print_head(const Cells& columns)
{
  print_row(columns);
  print_row(Cells(columns.size(), "---"));
}

template <typename Number>
std::string to_text(const Number& x, int digits)
{
  std::ostringstream out;
  out << std::setprecision(digits) << x;
  return out.str();
}

// Of a file without its folder and ending, or a specification of benchmark_meshes.h.
inline std::string name_of(const std::string& specification)
{
  const std::string name = specification.substr(specification.find_last_of('/') + 1);
  return name.substr(0, name.rfind(".off"));
}

} // namespace benchmarks

#endif // CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_TABLE_H
