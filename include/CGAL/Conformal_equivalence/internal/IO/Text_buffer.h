// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IO_TEXT_BUFFER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IO_TEXT_BUFFER_H

#include <charconv>
#include <cstddef>
#include <cstring>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Text on its way to a stream, in large blocks. Independent of the stream's
// precision, flags and locale: a number of type `double` is written with the
// fewest digits (at most 17) that read back as the same number.
class Text_buffer
{
public:
  explicit Text_buffer(std::ostream& out) : m_out(out), m_text(block_size) {}
  ~Text_buffer() { flush(); }
  Text_buffer(const Text_buffer&) = delete;
  Text_buffer& operator=(const Text_buffer&) = delete;

  Text_buffer& operator<<(char c)
  {
    make_room();
    m_text[m_size++] = c;
    return *this;
  }

  Text_buffer& operator<<(const char* text) { return append(text, std::strlen(text)); }
  Text_buffer& operator<<(const std::string& text) { return append(text.data(), text.size()); }

  template <typename Number, typename = std::enable_if_t<std::is_arithmetic<Number>::value> >
  Text_buffer& operator<<(Number x)
  {
    make_room();
    const std::to_chars_result end =
      std::to_chars(m_text.data() + m_size, m_text.data() + m_text.size(), x);
    m_size = static_cast<std::size_t>(end.ptr - m_text.data());
    return *this;
  }

  Text_buffer& append(const char* text, std::size_t size)
  {
    if(size > block_size)
    {
      flush();
      m_out.write(text, static_cast<std::streamsize>(size));
      return *this;
    }
    if(m_size + size > m_text.size())
      flush();
    std::memcpy(m_text.data() + m_size, text, size);
    m_size += size;
    return *this;
  }

  void flush()
  {
    m_out.write(m_text.data(), static_cast<std::streamsize>(m_size));
    m_size = 0;
  }

private:
  static constexpr std::size_t block_size = 1 << 16;
  static constexpr std::size_t longest_number = 64;

  void make_room()
  {
    if(m_size + longest_number > m_text.size())
      flush();
  }

  std::ostream& m_out;
  std::vector<char> m_text;
  std::size_t m_size = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IO_TEXT_BUFFER_H
