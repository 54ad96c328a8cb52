// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// check_flattening INPUT.off|.obj OUTPUT.obj [--free-border] [--cross-ratio T] [--border T] [--weights T]
// Exit status: 0 the output is a discretely conformal flattening of the input, 1 it is
// not, 2 something cannot be read. See include/check_flattening.h.

#include "include/check_flattening.h"

#include <exception>
#include <iostream>
#include <string>
#include <vector>

int main(int argc, char* argv[])
{
  std::vector<std::string> files;
  checking::Tolerances tolerances;
  try
  {
    for(int i = 1; i < argc; ++i)
    {
      const std::string argument = argv[i];
      const auto number = [&] { return std::stold(++i < argc ? argv[i] : ""); };
      if(argument == "--free-border")
        tolerances.border_keeps_its_lengths = false;
      else if(argument == "--cross-ratio")
        tolerances.cross_ratio = number();
      else if(argument == "--border")
        tolerances.border_scale = number();
      else if(argument == "--weights")
        tolerances.weights = number();
      else
        files.push_back(argument);
    }
    if(files.size() != 2)
    {
      std::cerr << "check_flattening INPUT.off|.obj OUTPUT.obj [--free-border] [--cross-ratio T] [--border T] [--weights T]\n";
      return 2;
    }
    const checking::Verdict verdict =
      checking::check_flattening(checking::read_surface(files[0]), checking::read_surface(files[1]), tolerances);
    std::cout << verdict;
    return verdict.is_good() ? 0 : 1;
  }
  catch(const std::exception& e)
  {
    std::cerr << "check_flattening: " << e.what() << '\n';
    return 2;
  }
}
