// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SCANNER_H
#define FLATTEN_MESH_SCANNER_H

#include "messages.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <istream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace flattening {

// All that is left in a stream, of about so many bytes.
inline std::string read_stream(std::istream& in, const std::string& name, std::uintmax_t size = 0)
{
  std::string content;
  if(size < std::uintmax_t(1) << 40)
    content.reserve(static_cast<std::size_t>(size) + 1);
  char block[1 << 16];
  while(in.read(block, sizeof block), in.gcount() > 0)
    content.append(block, static_cast<std::size_t>(in.gcount()));
  if(in.bad())
    fail(name, ": cannot be read");
  return content;
}

// The whole content of a file; of the standard input for the name "-".
inline std::string read_file(const std::string& name)
{
  if(name == "-")
    return read_stream(std::cin, name);
  std::error_code ignored;
  if(std::filesystem::is_directory(name, ignored))
    fail(name, ": is a directory");
  std::ifstream in(name, std::ios::binary);
  if(! in)
    fail(name, ": cannot be opened: ", std::strerror(errno));
  const std::uintmax_t size = std::filesystem::file_size(name, ignored);
  return read_stream(in, name, ignored ? 0 : size);
}

// Reads words and numbers from a text, and knows the line it is in. Errors are
// reported as "FILE: line N: ...". Lines end with LF, CR LF or CR. A byte order mark before the text is passed over.
class Scanner
{
public:
  // `comment` begins a comment that ends with its line; a line that ends with `continuation` goes on in the next one. Zero: there are none.
  Scanner(std::string_view text, std::string file, char comment, char continuation = '\0')
    : text_(text), file_(std::move(file)), comment_(comment), continuation_(continuation)
  {
    const auto begins_with = [&](std::string_view mark) { return text_.substr(0, mark.size()) == mark; };
    if(begins_with("\xFE\xFF") || begins_with("\xFF\xFE"))
      fail(file_, ": is encoded in UTF-16 or UTF-32; convert it to UTF-8");
    if(begins_with("\xEF\xBB\xBF"))
      at_ = 3;
    while(! text_.empty() && (text_.back() == '\0' || text_.back() == '\x1a')) // padding, and the end of files of DOS
      text_.remove_suffix(1);
    at_ = (std::min)(at_, text_.size());
  }

  const std::string& file() const { return file_; }
  std::size_t line() const { return line_; }
  std::size_t position() const { return at_; }
  std::size_t size() const { return text_.size(); }

  bool at_end()
  {
    skip_space(true);
    return at_ == text_.size();
  }

  bool at_end_of_line()
  {
    skip_space(false);
    return at_ == text_.size() || is_end_of_line(at_);
  }

  // The next word, on whatever line; empty at the end of the text.
  std::string_view word()
  {
    skip_space(true);
    const std::size_t begin = at_;
    while(at_ < text_.size() && ! is_space(text_[at_]) && ! is_continued(at_) && ! (is_comment(at_) && ! is_special_number(at_)))
      ++at_;
    if(at_ > begin && is_continued(at_))
      require_end_of_word();
    return text_.substr(begin, at_ - begin);
  }

  // The next word of this line; empty if there is none.
  std::string_view word_in_line() { return at_end_of_line() ? std::string_view() : word(); }

  // What is left of this line, without the blanks around it; its parts, if it is continued, with one blank between.
  std::string rest_of_line()
  {
    std::string rest;
    for(skip_blanks(); at_ < text_.size() && ! is_end_of_line(at_); )
      if(is_continued(at_))
      {
        rest = without_blanks_at_end(rest) + ' ';
        pass_continuation();
        skip_blanks();
      }
      else
        rest += text_[at_++];
    return without_blanks_at_end(rest);
  }

  // Goes to the end of this line; if it is continued, to that of its last part.
  void skip_line()
  {
    while(at_ < text_.size() && ! is_end_of_line(at_))
      if(is_comment(at_))
        skip_comment();
      else if(is_continued(at_))
        pass_continuation();
      else
        ++at_;
  }

  // The next number; in the `..._in_line` forms it must be in this line.
  double number() { return value<double>("a number", word()); }
  double number_in_line() { return value<double>("a number", word_in_line()); }
  std::int64_t integer() { return value<std::int64_t>("an integer", word()); }
  std::int64_t integer_in_line() { return value<std::int64_t>("an integer", word_in_line()); }

  template <typename... Parts>
  [[noreturn]] void error(const Parts&... parts) const
  {
    fail(file_, ": line ", line_, ": ", parts...);
  }

  // Whole words only. Numbers beyond the range of double become infinite or zero.
  static bool parse(std::string_view w, double& x)
  {
    if(! w.empty() && w[0] == '+')
      w.remove_prefix(1);
    const std::from_chars_result r = std::from_chars(w.data(), w.data() + w.size(), x);
    if(r.ec == std::errc::result_out_of_range)
      x = std::strtod(std::string(w).c_str(), nullptr);
    return r.ec != std::errc::invalid_argument && r.ptr == w.data() + w.size();
  }

  static bool parse(std::string_view w, std::int64_t& n)
  {
    if(! w.empty() && w[0] == '+')
      w.remove_prefix(1);
    const std::from_chars_result r = std::from_chars(w.data(), w.data() + w.size(), n);
    return r.ec == std::errc() && r.ptr == w.data() + w.size();
  }

private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

  bool has(char c, std::size_t i) const { return i < text_.size() && text_[i] == c; }
  bool is_end_of_line(std::size_t i) const { return text_[i] == '\n' || (text_[i] == '\r' && ! has('\n', i + 1)); }
  bool is_comment(std::size_t i) const { return comment_ != '\0' && text_[i] == comment_; }

  bool is_continued(std::size_t i) const
  {
    return continuation_ != '\0' && has(continuation_, i) && (has('\n', i + 1) || has('\r', i + 1));
  }

  // Some programs write 1.#INF and 1.#QNAN; that is no 1 before a comment.
  bool is_special_number(std::size_t i) const { return i > 0 && text_[i - 1] == '.'; }

  // Goes behind the end of the line.
  void pass_continuation()
  {
    at_ += text_[at_ + 1] == '\r' && has('\n', at_ + 2) ? 3 : 2;
    ++line_;
  }

  // It is not said whether a word goes on in the next line.
  void require_end_of_word()
  {
    Scanner after(*this);
    after.pass_continuation();
    if(after.at_ < text_.size() && ! is_space(text_[after.at_]))
      error("the line is continued within a word");
  }

  void skip_comment() // whose end is not continued
  {
    while(at_ < text_.size() && ! is_end_of_line(at_))
      ++at_;
  }

  static std::string without_blanks_at_end(const std::string& words)
  {
    return words.substr(0, words.find_last_not_of(" \t\r\v\f") + 1);
  }

  void skip_blanks()
  {
    while(has(' ', at_) || has('\t', at_))
      ++at_;
  }

  template <typename Number>
  Number value(const char* kind, std::string_view w)
  {
    Number x = 0;
    if(! parse(w, x))
    {
      if(w.empty())
        error("expected ", kind, ", found the end of the ", at_ == text_.size() ? "file" : "line");
      error("expected ", kind, ", found '", printable(w), "'");
    }
    return x;
  }

public:
  // A word of a file, fit for a message.
  static std::string printable(std::string_view w)
  {
    std::string result(w.substr(0, 30));
    for(char& c : result)
      if(static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e)
        c = '?';
    return result;
  }

private:
  void skip_space(bool across_lines)
  {
    while(at_ < text_.size())
      if(is_end_of_line(at_))
      {
        if(! across_lines)
          return;
        ++line_;
        ++at_;
      }
      else if(is_comment(at_))
        skip_comment();
      else if(is_continued(at_))
        pass_continuation();
      else if(is_space(text_[at_]))
        ++at_;
      else
        return;
  }

  std::string_view text_;
  std::string file_;
  char comment_, continuation_;
  std::size_t at_ = 0, line_ = 1;
};

} // namespace flattening

#endif // FLATTEN_MESH_SCANNER_H
