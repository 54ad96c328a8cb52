// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/layout_files.h"
#include "../include/flatten_mesh/color_scale.h"
#include "../include/flatten_mesh/layout_outline.h"
#include "../include/flatten_mesh/seamless.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace flattening {

Pattern texture_pattern(const Options& options)
{
  if(! options.seamless)
    return Pattern::CHECKERBOARD;
  return has_hexagons(static_cast<int>(options.quanta_of_turn)) ? Pattern::HEXAGON_TILES : Pattern::SQUARE_TILES;
}

double texture_repetitions(const Result& result)
{
  const Layout_box box = layout_box(result.mesh, result.uv);
  const double longest = (std::max)(box.x.upper - box.x.lower, box.y.upper - box.y.lower);
  return longest > 0 && std::isfinite(longest) ? 0.5 / round_number_below(longest / 14) : 1;
}

void write_layout_files(const Options& options, const Given_surface& given, const Result& result, Output_files& files)
{
  if(! options.flat.empty())
    files.write(options.flat, [&](std::ostream& out) { return write_flat_OBJ(out, given, result); });
  if(! options.dxf.empty())
    files.write(options.dxf, [&](std::ostream& out) { return write_DXF(out, result, options.true_scale > 0 ? options.true_scale : 1, options.dxf); });
  if(options.glb.empty() && options.ply.empty())
    return;
  const Split_surface surface(result, options.target == Target::SPHERE);
  if(! options.glb.empty())
    files.write(options.glb, [&](std::ostream& out)
    {
      return write_GLB(out, given, surface, {texture_pattern(options), texture_repetitions(result)}, options.projective, options.glb);
    });
  if(! options.ply.empty())
    files.write(options.ply, [&](std::ostream& out) { return write_PLY(out, given, surface); });
}

} // namespace flattening
