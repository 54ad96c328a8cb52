// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_MESSAGES_H
#define FLATTEN_MESH_MESSAGES_H

#include <CGAL/number_type_config.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace flattening {

// The command line is wrong: exit status 2.
struct Usage_error : std::runtime_error { using std::runtime_error::runtime_error; };

// The input or the computation is: exit status 1.
struct Failure : std::runtime_error { using std::runtime_error::runtime_error; };

template <typename... Parts>
std::string text(const Parts&... parts)
{
  std::ostringstream out;
  out.precision(7);
  (out << ... << parts);
  return out.str();
}

template <typename... Parts>
[[noreturn]] void fail(const Parts&... parts) { throw Failure(text(parts...)); }

// A message is one line, whatever values and names of files it quotes.
inline std::string one_line(std::string message)
{
  for(char& c : message)
    if(static_cast<unsigned char>(c) < 0x20)
      c = '?';
  return message;
}

inline double in_degrees(double radians)
{
  const double degrees = radians / CGAL_PI * 180, nearest = std::round(degrees * 1e6) / 1e6;
  return std::abs(degrees - nearest) < 1e-9 ? nearest : degrees; // 90, and not 90.00000000000001
}

} // namespace flattening

#endif // FLATTEN_MESH_MESSAGES_H
