// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file read_conditions.h
/// Conditions on a mesh, as property maps describe them: borders, cones, and vertices where the scale factor is prescribed (sections 4.1,
/// 4.2 and 5 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_READ_CONDITIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_READ_CONDITIONS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Doors/vertex_condition.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// reads the conditions at the vertices of an imported mesh from property maps.
///
/// \param mesh the mesh, with status `OK`
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
/// \param missing receives the unconstrained border vertices for which there is no angle, because
///        `vertex_is_constrained_map` is given and `border_angle_map` is not
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{border_angle_map}
///     \cgalParamDescription{the angle sums at border vertices, in radians: pi is straight}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type convertible to `double`}
///     \cgalParamDefault{none: the border is natural, it keeps its lengths}
///   \cgalParamNEnd
///   \cgalParamNBegin{cone_angle_map}
///     \cgalParamDescription{the angle sums at interior vertices, in radians}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type convertible to `double`}
///     \cgalParamDefault{2 pi everywhere}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_is_constrained_map}
///     \cgalParamDescription{`true` where the logarithmic scale factor u is fixed, and the angle free}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `bool`}
///     \cgalParamDefault{`true` at border vertices if `border_angle_map` is absent, `false` everywhere otherwise}
///     \cgalParamExtra{If it is given, it alone decides.}
///   \cgalParamNEnd
///   \cgalParamNBegin{prescribed_log_scale_factor_map}
///     \cgalParamDescription{u where it is fixed}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type convertible to `double`}
///     \cgalParamDefault{0 everywhere}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the conditions. Linear time.
template <typename TriangleMesh, typename NT, typename NamedParameters = parameters::Default_named_parameters>
Conformal_conditions<NT> read_conditions(const Imported_mesh<TriangleMesh, NT>& mesh,
                                         std::vector<std::uint32_t>& missing,
                                         const NamedParameters& np = parameters::default_values())
{
  const Intrinsic_triangulation<NT>& t = mesh.triangulation;
  Conformal_conditions<NT> conditions(t);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && !internal::set_condition(mesh, v, np, conditions))
      missing.push_back(v);
  return conditions;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_READ_CONDITIONS_H
