// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_BINARY_TEXT_H
#define FLATTEN_MESH_BINARY_TEXT_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace flattening {

// Appends the bytes of an unsigned integer, the lowest first, whatever the order of the machine.
template <typename Unsigned>
void append_bytes_of_integer(std::string& bytes, Unsigned x)
{
  for(std::size_t i = 0; i < sizeof x; ++i)
    bytes += static_cast<char>((x >> (8 * i)) & 255);
}

inline void append_little_endian(std::string& bytes, std::uint32_t x) { append_bytes_of_integer(bytes, x); }

// Floating-point numbers as IEEE 754 has them.
inline void append_little_endian(std::string& bytes, float x)
{
  std::uint32_t bits;
  static_assert(sizeof bits == sizeof x, "float has 32 bits");
  std::memcpy(&bits, &x, sizeof x);
  append_bytes_of_integer(bytes, bits);
}

inline void append_little_endian(std::string& bytes, double x)
{
  std::uint64_t bits;
  static_assert(sizeof bits == sizeof x, "double has 64 bits");
  std::memcpy(&bits, &x, sizeof x);
  append_bytes_of_integer(bytes, bits);
}

} // namespace flattening

#endif // FLATTEN_MESH_BINARY_TEXT_H
