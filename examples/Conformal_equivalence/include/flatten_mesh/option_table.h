// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The options as data. They are declared once, in options.cpp: the help text, the manual page and what shells complete are all made from that.

#ifndef FLATTEN_MESH_OPTION_TABLE_H
#define FLATTEN_MESH_OPTION_TABLE_H

#include <string>
#include <vector>

namespace flattening {

struct Option_entry
{
  std::string name;        // without the dashes
  std::string letter;      // the same with one dash; may be empty
  std::string value;       // what it takes, alternatives divided by '|'; empty for a switch
  std::string if_absent;   // the value that is meant then; may be empty
  std::string description;
  bool is_repeatable = false; // may it be given several times?
};

std::vector<Option_entry> option_table();

// What is said before the options.
extern const char* const synopsis;
extern const char* const introduction;
extern const char* const exit_status;

// The manual page, or what a shell needs to complete the options. Throws a `Usage_error` if `what` is none of them.
std::string printed_text(const std::string& what);

} // namespace flattening

#endif // FLATTEN_MESH_OPTION_TABLE_H
