// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_OUTPUT_FILES_H
#define FLATTEN_MESH_OUTPUT_FILES_H

#include "messages.h"
#include "Temporary_files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <random>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace flattening {

// What stands for the standard output, or input, where the name of a file is expected.
inline bool is_standard_stream(const std::string& file) { return file == "-"; }

// Files that appear together, whole, or not at all: each is written under another name
// beside its place, and renamed when all are there. (What is no regular file,
// such as a device, is written in place.) If the program is interrupted, nothing is left of them.
class Output_files
{
public:
  // What is written to "-" goes to `standard_output` in the end.
  explicit Output_files(std::ostream& standard_output) : standard_output_(standard_output) {}
  Output_files(const Output_files&) = delete;
  Output_files& operator=(const Output_files&) = delete;

  ~Output_files()
  {
    for(const Entry& e : entries_)
      remove_temporary(e);
  }

  // What is written to this file is kept in `content` instead. To be said before it is announced.
  void keep(const std::string& path, std::string& content)
  {
    kept_path_ = path;
    kept_content_ = &content;
  }

  // Whether this is a file that was announced, under any name.
  bool is_announced(const std::string& path) const
  {
    return std::any_of(entries_.begin(), entries_.end(), [file = target(path)](const Entry& e) { return e.target == file; });
  }

  // Announces a file, and makes sure that it can be written. Nothing is left of the trial.
  void announce(const std::string& path)
  {
    if(is_kept(path))
      return;
    Entry entry{path, is_standard_stream(path) ? path : target(path), "", ""};
    for(const Entry& e : entries_)
      if(e.target == entry.target)
        throw Usage_error(text("two outputs have the same name ", path));
    if(! is_standard_stream(path))
      find_place(entry);
    entries_.push_back(entry);
  }

  // Takes back the announcement of a file that will not be written.
  void withdraw(const std::string& path)
  {
    entries_.erase(std::remove_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.path == path; }), entries_.end());
  }

  // `write(out)` returns whether it succeeded.
  template <typename Write>
  void write(const std::string& path, Write write)
  {
    if(is_kept(path))
      return keep(write);
    Entry& entry = *find(path);
    errno = 0;
    if(is_standard_stream(path))
    {
      std::ostringstream out;
      if(! write(out))
        fail("cannot write to the standard output", reason());
      entry.content = out.str();
      return;
    }
    if(! entry.temporary.empty())
      remove_if_interrupted(entry.temporary);
    std::ofstream out(entry.temporary.empty() ? entry.target : entry.temporary, std::ios::binary);
    const bool is_written = out.good() && write(out) && out.flush().good();
    out.close();
    if(! is_written || out.fail())
      fail("cannot write ", path, reason());
  }

  // Puts all files in their places.
  void commit()
  {
    for(std::size_t i = 0; i < entries_.size(); ++i)
    {
      Entry& entry = entries_[i];
      if(is_standard_stream(entry.path) && ! (standard_output_ << entry.content).flush().good())
        fail("cannot write to the standard output", reason());
      if(entry.temporary.empty())
        continue;
      std::error_code error;
      std::filesystem::rename(entry.temporary, entry.target, error);
      if(error)
      {
        for(std::size_t j = 0; j < i; ++j)
          if(is_regular(entries_[j].target))
            remove(entries_[j].target);
        fail("cannot write ", entry.path, ": ", error.message());
      }
      forget_temporary_file(entry.temporary);
      entry.temporary.clear();
    }
  }

private:
  struct Entry { std::string path, target, temporary, content; };

  // Where a file is written first, if not in its place.
  static void find_place(Entry& entry)
  {
    std::error_code ignored;
    if(std::filesystem::is_directory(entry.target, ignored))
      fail("cannot write ", entry.path, ": it is a directory");
    if(! exists(entry.target) || is_regular(entry.target))
      entry.temporary = temporary_name(entry.target);
    try_to_open(entry);
  }

  static void remove_temporary(const Entry& entry)
  {
    if(entry.temporary.empty())
      return;
    remove(entry.temporary);
    forget_temporary_file(entry.temporary);
  }

  bool is_kept(const std::string& path) const { return kept_content_ != nullptr && path == kept_path_; }

  template <typename Write>
  void keep(Write write)
  {
    std::ostringstream out;
    if(! write(out))
      fail("cannot write ", kept_path_);
    *kept_content_ = out.str();
  }

  static std::string reason() { return errno ? text(": ", std::strerror(errno)) : std::string(); }

  static bool exists(const std::string& path)
  {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
  }

  static bool is_regular(const std::string& path)
  {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
  }

  static void remove(const std::string& path)
  {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }

  // the file behind symbolic links
  static std::string target(const std::string& path)
  {
    if(exists(path) && ! is_regular(path))
      return path;
    std::error_code error;
    const std::filesystem::path p = std::filesystem::weakly_canonical(path, error);
    return error ? path : p.string();
  }

  static std::string temporary_name(const std::string& path)
  {
    std::random_device random;
    std::string name;
    do
      name = text(path, ".part", random());
    while(exists(name));
    return name;
  }

  static void try_to_open(const Entry& entry)
  {
    if(entry.temporary.empty())
      return; // opening a pipe, for example, would have consequences
    errno = 0;
    if(exists(entry.target) && ! std::ofstream(entry.target, std::ios::app).good())
      fail("cannot write ", entry.path, reason());
    remove_if_interrupted(entry.temporary);
    const bool is_good = std::ofstream(entry.temporary).good();
    const std::string why = reason();
    remove_temporary(entry);
    if(! is_good)
      fail("cannot write ", entry.path, why);
  }

  Entry* find(const std::string& path)
  {
    for(Entry& e : entries_)
      if(e.path == path)
        return &e;
    return nullptr;
  }

  std::ostream& standard_output_;
  std::vector<Entry> entries_;
  std::string kept_path_;
  std::string* kept_content_ = nullptr;
};

} // namespace flattening

#endif // FLATTEN_MESH_OUTPUT_FILES_H
