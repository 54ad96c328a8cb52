// Flattens a triangle mesh: the package's main job as a command.
// `flatten_mesh --help` tells how.

#include "include/flatten_mesh/flatten_mesh.h"
#include "include/flatten_mesh/Progress.h"

#include <iostream>

int main(int argc, char* argv[])
{
  flattening::stop_at_interrupt();
  return flatten_mesh(argc, argv, std::cout, std::cerr);
}
