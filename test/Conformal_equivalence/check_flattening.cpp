// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// check_flattening INPUT.off|.obj OUTPUT.obj [--cones FILE] [--free-border] [--cross-ratio T] [--two-sides T]
//                  [--border T] [--weights T] [--angle T]
// FILE has a line `vertex-index angle-in-degrees` or `vertex-index free` for each cone, counted from 0; # begins a comment.
// Exit status: 0 the output is a discretely conformal flattening of the input, 1 it is
// not, 2 something cannot be read. See include/check_flattening.h.

#include "include/check_flattening.h"

#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

checking::Cones read_cones(const std::string& file)
{
  std::ifstream in(file);
  if(! in)
    throw std::runtime_error("cannot open " + file);
  return checking::read_cones(in);
}

int main(int argc, char* argv[])
{
  std::vector<std::string> files;
  checking::Tolerances tolerances;
  checking::Cones cones;
  try
  {
    for(int i = 1; i < argc; ++i)
    {
      const std::string argument = argv[i];
      const auto value = [&] { return std::string(++i < argc ? argv[i] : ""); };
      const auto number = [&] { return std::stold(value()); };
      if(argument == "--free-border")
        tolerances.border_keeps_its_lengths = false;
      else if(argument == "--cones")
        cones = read_cones(value());
      else if(argument == "--cross-ratio")
        tolerances.cross_ratio = number();
      else if(argument == "--two-sides")
        tolerances.two_sides = number();
      else if(argument == "--angle")
        tolerances.angle = number();
      else if(argument == "--border")
        tolerances.border_scale = number();
      else if(argument == "--weights")
        tolerances.weights = number();
      else
        files.push_back(argument);
    }
    if(files.size() != 2)
    {
      std::cerr << "check_flattening INPUT.off|.obj OUTPUT.obj [--cones FILE] [--free-border] [--cross-ratio T] [--two-sides T]"
                   " [--border T] [--weights T] [--angle T]\n";
      return 2;
    }
    const checking::Verdict verdict =
      checking::check_flattening(checking::read_surface(files[0]), checking::read_surface(files[1]), tolerances, cones);
    std::cout << verdict;
    return verdict.is_good() ? 0 : 1;
  }
  catch(const std::exception& e)
  {
    std::cerr << "check_flattening: " << e.what() << '\n';
    return 2;
  }
}
