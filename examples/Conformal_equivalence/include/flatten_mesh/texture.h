// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The pictures that show a layout on its surface, made to be repeated in unit steps of texture coordinates: what other programs do without any
// option. A checkerboard for most layouts; for seamless ones what fits across seams.

#ifndef FLATTEN_MESH_TEXTURE_H
#define FLATTEN_MESH_TEXTURE_H

#include "PNG.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flattening {

enum class Pattern
{
  CHECKERBOARD, // two by two squares in a step, a corner of them at the origin
  SQUARE_TILES, // the same, a square in the middle of each tile, which is a step wide: has the symmetries of the square lattice
  HEXAGON_TILES // a hexagon with its rim: has the symmetries of the hexagonal lattice, in its coordinates (a, b)
};

const std::array<unsigned char, 3> texture_light = {{245, 245, 240}}, texture_dark = {{70, 110, 160}};

// From texture_light to texture_dark, in even steps.
inline std::vector<Palette_image::Color> texture_palette(std::size_t number_of_colors)
{
  std::vector<Palette_image::Color> palette;
  for(std::size_t i = 0; i < number_of_colors; ++i)
  {
    Palette_image::Color color{{0, 0, 0, 255}};
    const double t = double(i) / double(number_of_colors - 1);
    for(std::size_t k = 0; k < 3; ++k)
      color[k] = static_cast<unsigned char>(std::lround((1 - t) * texture_light[k] + t * texture_dark[k]));
    palette.push_back(color);
  }
  return palette;
}

// `squares` by `squares` of them, an even number, each of `pixels` by `pixels`, moved by `shift` pixels to the left and down.
inline Palette_image checkerboard(std::uint32_t squares, std::uint32_t pixels, std::uint32_t shift = 0)
{
  Palette_image image(squares * pixels, squares * pixels, texture_palette(2));
  for(std::uint32_t y = 0; y < image.height; ++y)
    for(std::uint32_t x = 0; x < image.width; ++x)
      image.pixels[std::size_t(y) * image.width + x] = ((x + shift) / pixels + (y + 2 * pixels - shift) / pixels) % 2;
  return image;
}

// The distance of the point a + b e^{i pi / 3} from the nearest point of the lattice, in the norm whose balls are its hexagons: from 0 to 1/2, which
// it is on the sides of the tiles.
inline double distance_from_hexagonal_lattice(double a, double b)
{
  double least = 1;
  const double x = std::floor(a), y = std::floor(b);
  for(double i : {0., 1.})
    for(double j : {0., 1.})
    {
      // scalar products with the three directions that are normal to the sides, e^{i k pi / 3}
      const double s = a - (x + i), t = b - (y + j);
      least = (std::min)(least, (std::max)({std::abs(s + t / 2), std::abs(s / 2 + t), std::abs(s - t) / 2}));
    }
  return least;
}

// The hexagons about the points of the lattice, in the coordinates (a, b): dark, with a light rim. Rows of pixels begin at the top,
// where b is largest.
inline Palette_image hexagon_tile()
{
  const std::uint32_t side = 256, samples = 3;
  const double rim = 0.06;
  const std::size_t shades = 16;
  Palette_image image(side, side, texture_palette(shades));
  for(std::uint32_t y = 0; y < side; ++y)
    for(std::uint32_t x = 0; x < side; ++x)
    {
      std::size_t dark = 0;
      for(std::uint32_t i = 0; i < samples; ++i)
        for(std::uint32_t j = 0; j < samples; ++j)
          dark += distance_from_hexagonal_lattice((x + (i + .5) / samples) / side, 1 - (y + (j + .5) / samples) / side) < 0.5 - rim;
      image.pixels[std::size_t(y) * side + x] = static_cast<unsigned char>(dark * (shades - 1) / (samples * samples));
    }
  return image;
}

// A picture that covers a unit square of texture coordinates; a checkerboard is in it `repetitions` times in each direction.
inline Palette_image texture_image(Pattern pattern, std::uint32_t repetitions = 1)
{
  const std::uint32_t squares = 2 * repetitions, pixels = (std::min)((std::max)(320 / squares, 4u), 64u);
  switch(pattern)
  {
    case Pattern::SQUARE_TILES:  return checkerboard(2, 64, 32);
    case Pattern::HEXAGON_TILES: return hexagon_tile();
    default:                     return checkerboard(squares, pixels);
  }
}

} // namespace flattening

#endif // FLATTEN_MESH_TEXTURE_H
