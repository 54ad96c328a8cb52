// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The material of the OBJ file: a checkerboard, which shows the layout on the surface.

#ifndef FLATTEN_MESH_WRITE_MATERIAL_H
#define FLATTEN_MESH_WRITE_MATERIAL_H

#include "page_text.h"
#include "PNG.h"

#include <cstdint>
#include <ostream>
#include <string>

namespace flattening {

// What the materials of this program begin with; what follows is the texture.
inline std::string material_beginning(const std::string& name)
{
  return "newmtl " + name + "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd ";
}

// Writes a material library with one material called `name`, matt and white, with the
// picture in the file `texture` on it, which is repeated `repetitions` times in a
// unit of the layout. Returns `true` iff the stream is good after writing.
inline bool write_MTL(std::ostream& out, const std::string& name, const std::string& texture,
                      double repetitions = 1)
{
  {
    Text_buffer buffer(out);
    buffer << material_beginning(name) << "-s " << repetitions << ' ' << repetitions << " 1 " << texture << '\n';
  }
  out.flush();
  return out.good();
}

// Writes a PNG picture of two by two squares of a checkerboard, made to be repeated.
// The stream must be binary. Returns `true` iff it is good after writing.
inline bool write_checkerboard_PNG(std::ostream& out)
{
  const std::uint32_t side = 64;
  Palette_image image(2 * side, 2 * side, {{{245, 245, 240, 255}}, {{70, 110, 160, 255}}});
  for(std::uint32_t y = 0; y < image.height; ++y)
    for(std::uint32_t x = 0; x < image.width; ++x)
      image.pixels[y * image.width + x] = (x / side + y / side) % 2;
  const std::string file = png_file(image);
  out.write(file.data(), static_cast<std::streamsize>(file.size()));
  out.flush();
  return out.good();
}

} // namespace flattening

#endif // FLATTEN_MESH_WRITE_MATERIAL_H
