// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SVG_OPTIONS_H
#define FLATTEN_MESH_SVG_OPTIONS_H

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace flattening {

// A view of the unit sphere along the z-axis, as a disk about `centre` in the layout: from the positive z-axis or, with the x-axis to the left, from
// the negative one.
struct Hemisphere
{
  std::array<double, 2> centre = {{0, 0}};
  bool is_back = false;
};

// How `write_SVG()` draws.
struct SVG_options
{
  // What stands over the colours of the legend.
  std::string legend = "u";
  // Whether a checkerboard lies over the triangles, its squares along the axes of the layout.
  bool checkerboard = true;
  // The side of a square; 0 chooses a round number such that about 20 squares lie along the layout.
  double square = 0;
  // The symmetry n of a seamless layout (see `Tiling`). Its tiles are drawn under the edges: for n = 2 and 4 unit squares with the
  // integers in their centres, for n = 3 and 6 regular hexagons about the points of Z + Z e^{i pi / 3}, and none for any other n.
  // Where tiles would take more than 1000 lines, larger squares are drawn, each of an odd number of tiles along its side; and no hexagons.
  int tiles = 0;
  // The longer side of the drawing.
  double size = 1000;
  // Up to this many faces the edges are drawn, apart from very short ones;
  std::size_t maximum_number_of_faces_with_edges = 20000;

  // By position in edges(tm): edges that are not drawn. Empty: there are none.
  std::vector<bool> hidden_edges;
  // up to this many the triangles are drawn as such; those of larger meshes become an image of pixels.
  std::size_t maximum_number_of_drawn_faces = 250000;
  // Whether the two sides of each seam path are drawn in a colour of their own. A seam is an interior edge of the mesh
  // whose two sides lie apart in the layout. A path of them ends where another number of seam edges than two meet, at the
  // border of the mesh, and at cones (if these are drawn).
  // Beside them is the number of the path, if there is room.
  bool seams = true;
  // Whether a dot is drawn at each corner of a cone: an interior vertex of the mesh whose angles in the layout do not sum
  // up to 2 pi within 1e-6 and the rounding of the coordinates. Switch it off for a layout in charts: at their common
  // borders angles sum up to anything.
  bool cones = true;
  // The length of a unit of the layout in millimetres, which gives the drawing its size; 0: it has none.
  double millimetres = 0;
  // Circles that are drawn, too, each by its centre and its radius in the layout.
  std::vector<std::array<double, 3> > circles;
  // Pictures of the unit sphere, on which lines of latitude and longitude are drawn.
  std::vector<Hemisphere> hemispheres;
};

} // namespace flattening

#endif // FLATTEN_MESH_SVG_OPTIONS_H
