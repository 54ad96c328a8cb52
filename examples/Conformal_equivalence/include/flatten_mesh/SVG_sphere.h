// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SVG_SPHERE_H
#define FLATTEN_MESH_SVG_SPHERE_H

#include "page_text.h"
#include "SVG_frame.h"
#include "SVG_options.h"

#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <vector>

namespace flattening {

// Lines of latitude and longitude, 30 degrees apart, about the z-axis; the axes; and which side of the sphere a view shows.
class SVG_sphere
{
  typedef std::array<double, 2> Point;

public:
  SVG_sphere(const SVG_frame& frame, const std::vector<Hemisphere>& hemispheres) : frame_(frame), hemispheres_(hemispheres) {}

  void write(Text_buffer& out) const
  {
    if(hemispheres_.empty())
      return;
    out << "<g id=\"graticule\" fill=\"none\" stroke=\"#fff\" stroke-opacity=\".7\">\n";
    for(const Hemisphere& h : hemispheres_)
      write_lines(out, h);
    out << "</g>\n<g id=\"axes\" font-size=\"14\">\n";
    for(const Hemisphere& h : hemispheres_)
      write_names(out, h);
    out << "</g>\n";
  }

private:
  void write_lines(Text_buffer& out, const Hemisphere& h) const
  {
    const Point c = frame_(h.centre);
    for(int latitude : {30, 60})
      out << "<circle cx=\"" << c[0] << "\" cy=\"" << c[1] << "\" r=\"" << std::cos(latitude * CGAL_PI / 180) * frame_.scale << "\"/>\n";
    out << "<path d=\"";
    for(int longitude = 0; longitude < 180; longitude += 30)
    {
      const double x = std::cos(longitude * CGAL_PI / 180), y = std::sin(longitude * CGAL_PI / 180);
      const Point p = frame_({{ h.centre[0] - x, h.centre[1] - y }}), q = frame_({{ h.centre[0] + x, h.centre[1] + y }});
      out << 'M' << p[0] << ' ' << p[1] << 'L' << q[0] << ' ' << q[1];
    }
    out << "\"/>\n";
  }

  void write_names(Text_buffer& out, const Hemisphere& h) const
  {
    const double right = h.is_back ? -1 : 1, rim = 0.94;
    write_name(out, {{ h.centre[0] + right * rim, h.centre[1] }}, "x");
    write_name(out, {{ h.centre[0] - right * rim, h.centre[1] }}, "\u2212x");
    write_name(out, {{ h.centre[0], h.centre[1] + rim }}, "y");
    write_name(out, {{ h.centre[0], h.centre[1] - rim }}, "\u2212y");
    write_name(out, h.centre, h.is_back ? "\u2212z" : "z");
    const Point top = frame_({{ h.centre[0], h.centre[1] + 1 }});
    out << "<text x=\"" << top[0] << "\" y=\"" << top[1] - 6 << "\" text-anchor=\"middle\">"
        << (h.is_back ? "back, seen from \u2212z" : "front, seen from z") << "</text>\n";
  }

  void write_name(Text_buffer& out, const Point& place, const char* name) const
  {
    const Point p = frame_(place);
    out << "<text x=\"" << p[0] << "\" y=\"" << p[1] + 5 << "\" " << text_with_halo << '>' << name << "</text>\n";
  }

  const SVG_frame& frame_;
  const std::vector<Hemisphere>& hemispheres_;
};

} // namespace flattening

#endif // FLATTEN_MESH_SVG_SPHERE_H
