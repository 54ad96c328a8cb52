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
  explicit Text_buffer(std::ostream& out) : out_(out), text_(block_size) {}
  ~Text_buffer() { flush(); }
  Text_buffer(const Text_buffer&) = delete;
  Text_buffer& operator=(const Text_buffer&) = delete;

  Text_buffer& operator<<(char c)
  {
    make_room();
    text_[size_++] = c;
    return *this;
  }

  Text_buffer& operator<<(const char* text) { return append(text, std::strlen(text)); }
  Text_buffer& operator<<(const std::string& text) { return append(text.data(), text.size()); }

  template <typename Number, typename = std::enable_if_t<std::is_arithmetic<Number>::value> >
  Text_buffer& operator<<(Number x)
  {
    make_room();
    const std::to_chars_result end =
      std::to_chars(text_.data() + size_, text_.data() + text_.size(), x);
    size_ = static_cast<std::size_t>(end.ptr - text_.data());
    return *this;
  }

  Text_buffer& append(const char* text, std::size_t size)
  {
    if(size > block_size)
    {
      flush();
      out_.write(text, static_cast<std::streamsize>(size));
      return *this;
    }
    if(size_ + size > text_.size())
      flush();
    std::memcpy(text_.data() + size_, text, size);
    size_ += size;
    return *this;
  }

  void flush()
  {
    out_.write(text_.data(), static_cast<std::streamsize>(size_));
    size_ = 0;
  }

private:
  static constexpr std::size_t block_size = 1 << 16;
  static constexpr std::size_t longest_number = 64;

  void make_room()
  {
    if(size_ + longest_number > text_.size())
      flush();
  }

  std::ostream& out_;
  std::vector<char> text_;
  std::size_t size_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IO_TEXT_BUFFER_H
