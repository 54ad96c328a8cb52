// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The material of the OBJ file: a picture that repeats, which shows the layout on the surface.

#ifndef FLATTEN_MESH_WRITE_MATERIAL_H
#define FLATTEN_MESH_WRITE_MATERIAL_H

#include "page_text.h"
#include "PNG.h"

#include <ostream>
#include <string>

namespace flattening {

// What the materials of this program begin with; what follows is the texture.
inline std::string material_beginning(const std::string& name)
{
  return "newmtl " + name + "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd ";
}

// Writes a material library with one material called `name`, matt and white, with the picture in the file `texture` on it. It has none of the
// options that move or scale the picture: programs read them in different ways, or not at all. Returns `true` iff the stream is good after writing.
inline bool write_MTL(std::ostream& out, const std::string& name, const std::string& texture)
{
  {
    Text_buffer buffer(out);
    buffer << material_beginning(name) << texture << '\n';
  }
  out.flush();
  return out.good();
}

// The stream must be binary. Returns `true` iff it is good after writing.
inline bool write_PNG(std::ostream& out, const Palette_image& image)
{
  const std::string file = png_file(image);
  out.write(file.data(), static_cast<std::streamsize>(file.size()));
  out.flush();
  return out.good();
}

} // namespace flattening

#endif // FLATTEN_MESH_WRITE_MATERIAL_H
