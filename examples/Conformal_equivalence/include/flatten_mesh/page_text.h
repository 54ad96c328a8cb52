// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Text and data in the forms that drawings and pages take.

#ifndef FLATTEN_MESH_PAGE_TEXT_H
#define FLATTEN_MESH_PAGE_TEXT_H

#include <CGAL/Conformal_equivalence/internal/IO/Text_buffer.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace flattening {

using CGAL::Conformal_equivalence::internal::Text_buffer;

// Binary data as text for a page: RFC 4648, section 4.
inline void write_base64(Text_buffer& out, const unsigned char* data, std::size_t size)
{
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for(std::size_t i = 0; i < size; i += 3)
  {
    const std::size_t n = size - i < 3 ? size - i : 3;
    const std::uint32_t bits = (std::uint32_t(data[i]) << 16)
                             | (n > 1 ? std::uint32_t(data[i+1]) << 8 : 0)
                             | (n > 2 ? std::uint32_t(data[i+2]) : 0);
    out << digits[bits >> 18] << digits[(bits >> 12) & 63]
        << (n > 1 ? digits[(bits >> 6) & 63] : '=') << (n > 2 ? digits[bits & 63] : '=');
  }
}

// Text as content of an XML or HTML element or attribute.
inline std::string escaped_for_xml(const std::string& text)
{
  std::string result;
  for(char c : text)
  {
    switch(c)
    {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default:
        if(static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n')
          result += c;
    }
  }
  return result;
}

} // namespace flattening

#endif // FLATTEN_MESH_PAGE_TEXT_H
