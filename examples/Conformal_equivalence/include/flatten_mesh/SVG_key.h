// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What stands beside a drawing: the colours, and what dots and lines are.

#ifndef FLATTEN_MESH_SVG_KEY_H
#define FLATTEN_MESH_SVG_KEY_H

#include "color_scale.h"
#include "page_text.h"
#include "Robust_range.h"
#include "SVG_frame.h"

#include <cstddef>
#include <string>
#include <vector>

namespace flattening {

class SVG_key
{
public:
  static constexpr double width = 200;

  // `title` stands over the colours, which are spread over the range.
  SVG_key(const std::string& title, const Robust_range& range) : title_(title), range_(range) {}

  void add_note(const std::string& note) { notes_.push_back(note); }
  void explain_seams() { has_seams_ = true; }
  void explain_cones() { has_cones_ = true; }

  double height() const
  {
    return top_of_notes + line * static_cast<double>(notes_.size() + has_seams_ + has_cones_);
  }

  // At the place `x`, from the top of the drawing.
  void write(Text_buffer& out, double x) const
  {
    out << "<g id=\"legend\"><text x=\"" << x << "\" y=\"20\">" << escaped_for_xml(title_)
        << "</text>\n<defs><linearGradient id=\"colors\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">";
    for(int i = 0; i <= 8; ++i)
      out << "<stop offset=\"" << i / 8. << "\" stop-color=\"" << hexadecimal(sequential_color(i / 8.)) << "\"/>";
    out << "</linearGradient></defs>\n<rect x=\"" << x << "\" y=\"" << top_of_bar
        << "\" width=\"24\" height=\"" << height_of_bar << "\" fill=\"url(#colors)\"/>\n";
    if(! range_.empty())
    {
      write_end(out, x, top_of_bar + 12, 20, range_.upper, range_.number_above, " above");
      write_end(out, x, top_of_bar + height_of_bar, -20, range_.lower, range_.number_below, " below");
    }
    double y = top_of_notes;
    for(const std::string& note : notes_)
      write_note(out, x, y += line, note);
    if(has_seams_)
    {
      write_note(out, x + 30, y += line, "both sides of a seam");
      out << "<path d=\"M" << x << ' ' << y - 5 << "h22\" stroke=\"#" << categorical_color(0) << "\" stroke-width=\"4\" stroke-linecap=\"round\"/>\n";
    }
    if(has_cones_)
    {
      write_note(out, x + 30, y += line, "a cone");
      out << "<circle cx=\"" << x + 12 << "\" cy=\"" << y - 5 << "\" r=\"6\" fill=\"#111\" stroke=\"#fff\" stroke-width=\"1.5\"/>\n";
    }
    out << "</g>\n";
  }

private:
  static constexpr double top_of_bar = 50, height_of_bar = 256, top_of_notes = 320, line = 20;

  // One end of the range and, on the next line inwards, how many triangles are beyond.
  static void write_end(Text_buffer& out, double x, double y, double step, double value, std::size_t number_beyond, const char* where)
  {
    out << "<text x=\"" << x + 30 << "\" y=\"" << y << "\">" << short_text(value) << "</text>\n";
    if(number_beyond != 0)
      write_note(out, x + 30, y + step, std::to_string(number_beyond) + where);
  }

  static void write_note(Text_buffer& out, double x, double y, const std::string& note)
  {
    out << "<text x=\"" << x << "\" y=\"" << y << "\" font-size=\"13\">" << escaped_for_xml(note) << "</text>\n";
  }

  std::string title_;
  Robust_range range_;
  std::vector<std::string> notes_;
  bool has_seams_ = false, has_cones_ = false;
};

} // namespace flattening

#endif // FLATTEN_MESH_SVG_KEY_H
