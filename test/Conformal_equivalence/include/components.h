// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Surfaces of several components, as one, and what the program makes of each of them.

#ifndef CONFORMAL_EQUIVALENCE_TEST_COMPONENTS_H
#define CONFORMAL_EQUIVALENCE_TEST_COMPONENTS_H

#include "check_flattening.h"
#include "program_runs.h"
#include "test_meshes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace program {

// The vertices and faces of all components in turn, so that those of each keep their order; the first vertex of all is isolated.
struct Mixture
{
  std::vector<testing::Soup> parts;
  testing::Soup soup;
  std::vector<std::vector<testing::Index> > vertices; // by part: those of the mixture
  std::vector<std::vector<std::size_t> > faces;       // by part

  explicit Mixture(const std::vector<testing::Soup>& given) : parts(given), vertices(given.size()), faces(given.size())
  {
    soup.points.push_back({{ 0, 0, 0 }});
    in_turn([](const testing::Soup& part) { return part.points.size(); }, [&](std::size_t i, std::size_t v)
    {
      vertices[i].push_back(testing::Index(soup.points.size()));
      soup.points.push_back(parts[i].points[v]);
    });
    in_turn([](const testing::Soup& part) { return part.triangles.size(); }, [&](std::size_t i, std::size_t f)
    {
      faces[i].push_back(soup.triangles.size());
      const auto& t = parts[i].triangles[f];
      soup.triangles.push_back({{ vertices[i][t[0]], vertices[i][t[1]], vertices[i][t[2]] }});
    });
  }

  // One component of what was made of the mixture, without refinement; texture coordinates are kept.
  checking::Surface part(const checking::Surface& whole, std::size_t i) const
  {
    checking::Surface result = whole;
    result.points.clear();
    result.faces.clear();
    result.corners.clear();
    for(testing::Index v : vertices[i])
      result.points.push_back(whole.points[v]);
    for(std::size_t f = 0; f < faces[i].size(); ++f)
    {
      const auto& t = parts[i].triangles[f];
      result.faces.push_back({{ t[0], t[1], t[2] }});
      if(! whole.corners.empty())
        result.corners.push_back(whole.corners[faces[i][f]]);
    }
    return result;
  }

  // Whether the faces of what was made are those of the mixture.
  bool has_faces_of(const checking::Surface& whole) const
  {
    return std::equal(whole.faces.begin(), whole.faces.end(), soup.triangles.begin(), soup.triangles.end(), [](const auto& a, const auto& b)
      { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; });
  }

private:
  template <typename Size, typename Use>
  void in_turn(Size size, Use use) const
  {
    bool is_done = false;
    for(std::size_t k = 0; ! is_done; ++k)
    {
      is_done = true;
      for(std::size_t i = 0; i < parts.size(); ++i)
        if(k < size(parts[i]))
        {
          is_done = false;
          use(i, k);
        }
    }
  }
};

// Small triangles of different shapes, each by itself.
inline std::vector<testing::Soup> single_triangles(std::size_t n)
{
  std::vector<testing::Soup> result;
  for(std::size_t i = 0; i < n; ++i)
    result.push_back(testing::one_triangle({{ 0, 0, double(i) }}, {{ 1, 0, double(i) }}, {{ .3, .5 + double(i % 7), double(i) }}));
  return result;
}

// Writes it as NAME, and runs the program, which succeeds.
inline Run run_on_mixture(const Folder& folder, const std::string& name, const testing::Soup& soup, const std::vector<std::string>& options)
{
  const Run r = run(with({write_off(folder, name + ".off", soup), "-o", folder / (name + ".obj")}, options));
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  return r;
}

} // namespace program

#endif // CONFORMAL_EQUIVALENCE_TEST_COMPONENTS_H
