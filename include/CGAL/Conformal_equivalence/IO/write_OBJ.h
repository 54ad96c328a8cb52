// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file IO/write_OBJ.h
/// A mesh with its layout as texture coordinates, as Wavefront OBJ. \cgal's own
/// writer has no texture coordinates. With the projective weights of the paper's
/// section 3.4 the coordinates are homogeneous, and a program that divides them
/// at each pixel shows the projective interpolation.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_IO_WRITE_OBJ_H
#define CGAL_CONFORMAL_EQUIVALENCE_IO_WRITE_OBJ_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/IO/corner_values.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>
#include <CGAL/Conformal_equivalence/internal/IO/Text_buffer.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <iomanip>
#include <locale>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

template <typename TriangleMesh, typename VertexPointMap, typename VertexNumberMap>
void write_obj_vertices(Text_buffer& out, const TriangleMesh& tm, const VertexPointMap& vpm,
                        VertexNumberMap number)
{
  std::size_t n = 0;
  for(auto v : vertices(tm))
  {
    const auto& p = get(vpm, v);
    out << "v " << CGAL::to_double(p.x()) << ' ' << CGAL::to_double(p.y())
        << ' ' << CGAL::to_double(p.z()) << '\n';
    put(number, v, ++n);
  }
}

// A number, with as many digits as it takes to read it back.
template <typename Number>
void write_obj_number(Text_buffer& out, const Number& x)
{
  if constexpr(std::is_arithmetic<Number>::value)
    out << x;
  else
  {
    std::ostringstream digits;
    digits.imbue(std::locale::classic());
    digits << std::setprecision(2 + static_cast<int>(precision_in_bits(x) * .30103)) << x;
    out << digits.str();
  }
}

// Affine texture coordinates, or homogeneous ones where `weights` is a map.
template <typename TriangleMesh, typename HalfedgeUVMap, typename WeightMap, typename HalfedgeNumberMap>
void write_obj_texture_coordinates(Text_buffer& out, const TriangleMesh& tm, const HalfedgeUVMap& uv,
                                   const WeightMap& weights, HalfedgeNumberMap number)
{
  for(auto h : number_corner_values(tm, uv, number))
  {
    const auto p = corner_value(uv, h);
    typedef std::decay_t<decltype(p[0])> Number;
    const auto write = [&](char before, const Number& x) { write_obj_number(out << before, x); };
    out << "vt";
    if constexpr(std::is_same<WeightMap, internal_np::Param_not_found>::value)
    {
      write(' ', p[0]);
      write(' ', p[1]);
    }
    else
    {
      const Number w(CGAL::to_double(get(weights, target(h, tm))));
      write(' ', p[0] * w);
      write(' ', p[1] * w);
      write(' ', w);
    }
    out << '\n';
  }
}

template <typename TriangleMesh, typename VertexNumberMap, typename HalfedgeNumberMap>
void write_obj_faces(Text_buffer& out, const TriangleMesh& tm,
                     VertexNumberMap vertex_number, HalfedgeNumberMap corner_number)
{
  for(auto f : faces(tm))
  {
    out << 'f';
    for(auto h : CGAL::halfedges_around_face(halfedge(f, tm), tm))
      out << ' ' << get(vertex_number, target(h, tm)) << '/' << get(corner_number, h) + 1;
    out << '\n';
  }
}

} // namespace internal

namespace IO {

/// \ingroup PkgConformalEquivalenceIO
/// The material that an OBJ file names: the material library (a file beside the
/// OBJ file) and the material in it. Nothing is named
/// if `file` is empty.
struct OBJ_material
{
  std::string file;            ///< name of the file, without a folder
  std::string name = "layout"; ///< name of the material
};

/*!
\ingroup PkgConformalEquivalenceIO

writes `tm`, with the layout `uv` as texture coordinates, as Wavefront OBJ.

The vertices come in the order of `vertices(tm)`, isolated ones included, the faces in that
of `faces(tm)`. Each distinct value among the corners of a vertex becomes one line `vt`, so
that a vertex inside the layout has one and a vertex on a seam has several. Numbers
are written with as many digits (at most 17) as it takes to read the same `double` back,
whatever the settings of the stream; texture coordinates of a type with more digits (`long double`, or a
floating-point number of Boost.Multiprecision) with as many as it takes for that type.

\tparam TriangleMesh a model of `FaceListGraph`
\tparam HalfedgeUVMap a model of `ReadablePropertyMap` with
        `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` as key type and a `%Point_2` as value type
\tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"

\param out the output stream
\param tm a mesh
\param uv the layout: `uv[h]` is the place of the corner of `target(h, tm)` in `face(h, tm)`;
       border halfedges are not read
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
\param material the material to name in the file

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of the vertices}
    \cgalParamType{a model of `ReadablePropertyMap` from vertices to `%Point_3`}
    \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
  \cgalParamNEnd
  \cgalParamNBegin{projective_weight_map}
    \cgalParamDescription{weights \f$w\f$: with them the lines `vt` hold the homogeneous
                          coordinates \f$(uw, vw, w)\f$. Scale the weights so that the largest is 1.}
    \cgalParamType{a model of `ReadablePropertyMap` from vertices to `double`}
    \cgalParamDefault{none: affine coordinates \f$(u, v)\f$}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return `true` iff the stream is good after writing

Takes linear time (quadratic in the number of distinct values at a single vertex).
Springborn, Schroeder, Pinkall 2008, section 3.4.
*/
template <typename TriangleMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters>
bool write_OBJ(std::ostream& out, const TriangleMesh& tm, HalfedgeUVMap uv,
               const NamedParameters& np = parameters::default_values(),
               const OBJ_material& material = OBJ_material())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;

  const auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                    get_const_property_map(CGAL::vertex_point, tm));
  const auto weights = get_parameter(np, internal_np::conformal_weight);
  const auto vertex_number = get(CGAL::dynamic_vertex_property_t<std::size_t>(), tm);
  const auto corner_number = get(CGAL::dynamic_halfedge_property_t<std::size_t>(), tm);

  {
    internal::Text_buffer buffer(out);
    if(! material.file.empty())
      buffer << "mtllib " << material.file << '\n';
    internal::write_obj_vertices(buffer, tm, vpm, vertex_number);
    internal::write_obj_texture_coordinates(buffer, tm, uv, weights, corner_number);
    if(! material.file.empty())
      buffer << "usemtl " << material.name << '\n';
    internal::write_obj_faces(buffer, tm, vertex_number, corner_number);
  }
  out.flush();
  return out.good();
}

/// \ingroup PkgConformalEquivalenceIO
/// writes the file `file_name`; see the function above. Returns `false`, too, if
/// the file cannot be opened.
template <typename TriangleMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters>
bool write_OBJ(const std::string& file_name, const TriangleMesh& tm, HalfedgeUVMap uv,
               const NamedParameters& np = parameters::default_values(),
               const OBJ_material& material = OBJ_material())
{
  std::ofstream out(file_name, std::ios::binary);
  return out.good() && write_OBJ(out, tm, uv, np, material);
}

} // namespace IO
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_IO_WRITE_OBJ_H
