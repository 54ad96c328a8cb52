// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What a compiler can tell of the parameters of a door, in one line: a map that is none, or
// has other keys; a forgotten `std::ref`; a named parameter that this door does not read.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_PARAMETER_CHECKS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_PARAMETER_CHECKS_H

#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <type_traits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// ---- Property maps

template <typename Map, typename = void>
struct Is_property_map : public std::false_type {};

template <typename Map>
struct Is_property_map<Map, std::void_t<typename boost::property_traits<Map>::category> > : public std::true_type {};

// Is `Map` a property map that takes keys of this type? Where the type of its keys is `void` it takes all.
template <typename Map, typename Key>
constexpr bool takes_keys()
{
  if constexpr(Is_property_map<Map>::value)
  {
    typedef typename boost::property_traits<Map>::key_type Map_key;
    return std::is_void<Map_key>::value || std::is_convertible<Key, Map_key>::value;
  }
  else
    return false;
}

// What follows is instantiated in static_assert(Check_...::value), which never fails itself: what is refused is said before.

// Refuses what is no map of the halfedges of a mesh, when it is instantiated.
template <typename HalfedgeMap, typename TriangleMesh>
struct Check_halfedge_map
{
  static_assert(Is_property_map<HalfedgeMap>::value,
                "coordinates are written to a property map; for a std::map, see boost::make_assoc_property_map()");
  static_assert(!Is_property_map<HalfedgeMap>::value
                || takes_keys<HalfedgeMap, typename boost::graph_traits<TriangleMesh>::halfedge_descriptor>(),
                "coordinates are written by corner: the keys of the property map must be the halfedges of the mesh, not its vertices");
  static constexpr bool value = true;
};

// Refuses what is no map of the vertices of a mesh, when it is instantiated.
template <typename VertexMap, typename TriangleMesh>
struct Check_vertex_map
{
  static_assert(Is_property_map<VertexMap>::value,
                "results are written to a property map; for a std::map, see boost::make_assoc_property_map()");
  static_assert(!Is_property_map<VertexMap>::value
                || takes_keys<VertexMap, typename boost::graph_traits<TriangleMesh>::vertex_descriptor>(),
                "results are written by vertex: the keys of the property map must be the vertices of the mesh");
  static constexpr bool value = true;
};

// ---- Named parameters

// What a named parameter is; `OTHER` is not looked at.
enum class Parameter_kind { OTHER, VERTEX_MAP, EDGE_MAP, FACE_MAP, REFERENCE };

template <typename Tag> inline constexpr Parameter_kind kind_of = Parameter_kind::OTHER;
#define CGAL_set_kind_of_named_parameter(X, KIND) \
  template <> inline constexpr Parameter_kind kind_of<CGAL::internal_np::X> = Parameter_kind::KIND;
CGAL_set_kind_of_named_parameter(conformal_cone_angle_t, VERTEX_MAP)
CGAL_set_kind_of_named_parameter(conformal_border_angle_t, VERTEX_MAP)
CGAL_set_kind_of_named_parameter(conformal_prescribed_u_t, VERTEX_MAP)
CGAL_set_kind_of_named_parameter(conformal_initial_u_t, VERTEX_MAP)
CGAL_set_kind_of_named_parameter(conformal_u_t, VERTEX_MAP)
CGAL_set_kind_of_named_parameter(conformal_weight_t, VERTEX_MAP)
CGAL_set_kind_of_named_parameter(conformal_edge_length_t, EDGE_MAP)
CGAL_set_kind_of_named_parameter(conformal_scaled_length_t, EDGE_MAP)
CGAL_set_kind_of_named_parameter(conformal_edge_is_seam_t, EDGE_MAP)
CGAL_set_kind_of_named_parameter(conformal_seam_weight_t, EDGE_MAP)
CGAL_set_kind_of_named_parameter(conformal_input_face_t, FACE_MAP)
CGAL_set_kind_of_named_parameter(conformal_report_t, REFERENCE)
CGAL_set_kind_of_named_parameter(conformal_common_refinement_t, REFERENCE)
CGAL_set_kind_of_named_parameter(conformal_spherical_refinement_t, REFERENCE)
#undef CGAL_set_kind_of_named_parameter

// The tags of the named parameters of this package that a door reads.
template <typename... Tags>
struct Parameter_list
{
  template <typename Tag>
  static constexpr bool contains = (std::is_same<Tag, Tags>::value || ...);
};

// Refuses a parameter that is not read, or not what it has to be, when it is instantiated. Those of CGAL are not checked.
template <typename Tag, bool is_read, typename Given, typename TriangleMesh>
struct Check_parameter {};

#define CGAL_add_named_parameter(X, Y, Z)                                                                               \
  template <bool is_read, typename Given, typename TriangleMesh>                                                        \
  struct Check_parameter<CGAL::internal_np::X, is_read, Given, TriangleMesh>                                            \
  {                                                                                                                     \
    typedef boost::graph_traits<TriangleMesh> Graph_traits;                                                             \
    static constexpr Parameter_kind kind = kind_of<CGAL::internal_np::X>;                                               \
    static constexpr bool is_map = Is_property_map<Given>::value;                                                       \
    static_assert(is_read, "the named parameter " #Z "() is not read by this function");                                \
    static_assert(kind == Parameter_kind::OTHER || kind == Parameter_kind::REFERENCE || is_map,                         \
                  #Z "() takes a property map, by value; for a std::map, see boost::make_assoc_property_map()");        \
    static_assert(kind != Parameter_kind::VERTEX_MAP || !is_map                                                         \
                  || takes_keys<Given, typename Graph_traits::vertex_descriptor>(),                                     \
                  #Z "() takes a property map whose keys are the vertices of the mesh");                                \
    static_assert(kind != Parameter_kind::EDGE_MAP || !is_map                                                           \
                  || takes_keys<Given, typename Graph_traits::edge_descriptor>(),                                       \
                  #Z "() takes a property map whose keys are the edges of the mesh");                                   \
    static_assert(kind != Parameter_kind::FACE_MAP || !is_map                                                           \
                  || takes_keys<Given, typename Graph_traits::face_descriptor>(),                                       \
                  #Z "() takes a property map whose keys are the faces of the mesh");                                   \
    static_assert(kind != Parameter_kind::REFERENCE || Reference_parameter<Given>::value,                               \
                  #Z "() is written to: hand the object over by std::ref()");                                           \
  };
#include <CGAL/Conformal_equivalence/internal/parameters_interface.h>
#undef CGAL_add_named_parameter

// Instantiates the check of each parameter of a pack. `TriangleMesh` is the mesh whose elements are the keys of the maps.
template <typename List, typename TriangleMesh, typename NamedParameters>
struct Check_pack : public Check_pack<List, TriangleMesh, typename NamedParameters::base> {};

template <typename List, typename TriangleMesh, typename T, typename Tag, typename Base>
struct Check_pack<List, TriangleMesh, CGAL::internal_np::Named_params_impl<T, Tag, Base> >
{
  static constexpr bool value = sizeof(Check_parameter<Tag, List::template contains<Tag>, T, TriangleMesh>) > 0
                             && Check_pack<List, TriangleMesh, Base>::value;
};

template <typename List, typename TriangleMesh>
struct Check_pack<List, TriangleMesh, CGAL::internal_np::No_property>
{
  static constexpr bool value = true;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_PARAMETER_CHECKS_H
