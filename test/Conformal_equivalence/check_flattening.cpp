// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// check_flattening INPUT.off|.obj OUTPUT.obj [--cones FILE] [--free-border] [--cross-ratio T] [--two-sides T]
//                  [--border T] [--weights T] [--angle T] [--sphere | --disk] [--barycentre T] [--flips] [--lost N]
// check_flattening INPUT.off|.obj OUTPUT.obj --seamless [2 | 3 | 4 | 6]
// FILE has a line `vertex-index angle-in-degrees` or `vertex-index free` for each cone, counted from 0; # begins a comment.
// --sphere: the vertices of the output are points of the unit sphere; --disk: the layout is inscribed to the unit circle. Both may be of a
// refinement of the input. --flips: edges were flipped on the way, so that cross ratios are not those of the input. --lost N: exactly N
// triangles are not positive.
// --seamless N: the layout is one of tiles with rotations by multiples of 2 pi / N (4 if it is not given), which is checked exactly;
// for 3 and 6 its coordinates are those of the lattice. Such a layout may have been deformed: nothing else is checked.
// Exit status: 0 the output is a discretely conformal flattening, or map to the sphere or the disk, or a seamless layout, of the input, 1 it is
// not, 2 something cannot be read. See include/check_flattening.h, include/check_image.h and include/check_seams.h.

#include "include/check_flattening.h"
#include "include/check_image.h"
#include "include/check_seams.h"

#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
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

int report(const checking::Verdict& verdict)
{
  std::cout << verdict;
  return verdict.is_good() ? 0 : 1;
}

int check_disk(const checking::Surface& input, const checking::Surface& output, checking::Tolerances tolerances,
               const checking::Image_tolerances& image)
{
  const checking::Image_verdict verdict = checking::check_disk(input, output, image);
  std::cout << verdict;
  if(verdict.is_refined || ! verdict.is_good())
    return verdict.is_good() ? 0 : 1;
  tolerances.border_keeps_its_lengths = false;
  tolerances.lost_triangles = image.lost_triangles;
  if(image.edges_were_flipped)
    tolerances.cross_ratio = tolerances.weights = std::numeric_limits<checking::Real>::infinity();
  return report(checking::check_flattening(input, output, tolerances));
}

int main(int argc, char* argv[])
{
  std::vector<std::string> files;
  checking::Tolerances tolerances;
  checking::Image_tolerances image;
  bool is_sphere = false, is_disk = false;
  int symmetry = 0; // of a seamless layout
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
      else if(argument == "--sphere")
        is_sphere = true;
      else if(argument == "--disk")
        is_disk = true;
      else if(argument == "--seamless")
      {
        const std::string number = i + 1 < argc ? argv[i + 1] : "";
        const bool is_given = ! number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
        symmetry = is_given ? std::stoi(number) : 4;
        i += is_given;
      }
      else if(argument == "--barycentre")
        image.barycentre = number();
      else if(argument == "--flips")
        image.edges_were_flipped = true;
      else if(argument == "--lost")
        tolerances.lost_triangles = image.lost_triangles = std::stoul(value());
      else
        files.push_back(argument);
    }
    if(files.size() != 2)
    {
      std::cerr << "check_flattening INPUT.off|.obj OUTPUT.obj [--cones FILE] [--free-border] [--cross-ratio T] [--two-sides T]"
                   " [--border T] [--weights T] [--angle T] [--sphere | --disk] [--barycentre T] [--flips] [--lost N] [--seamless [N]]\n";
      return 2;
    }
    const checking::Surface input = checking::read_surface(files[0]), output = checking::read_surface(files[1]);
    if(symmetry != 0)
    {
      const checking::Seam_verdict verdict = checking::check_seams(input, output, symmetry);
      std::cout << verdict;
      return verdict.is_good() ? 0 : 1;
    }
    if(is_sphere)
    {
      const checking::Image_verdict verdict = checking::check_sphere(input, output, image);
      std::cout << verdict;
      return verdict.is_good() ? 0 : 1;
    }
    if(is_disk)
      return check_disk(input, output, tolerances, image);
    return report(checking::check_flattening(input, output, tolerances, cones));
  }
  catch(const std::exception& e)
  {
    std::cerr << "check_flattening: " << e.what() << '\n';
    return 2;
  }
}
