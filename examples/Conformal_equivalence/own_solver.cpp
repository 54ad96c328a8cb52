#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <Eigen/SparseLU>

#include <cstddef>
#include <functional>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;

namespace SMP = CGAL::Surface_mesh_parameterization;
namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

//! [part]
// A model of SparseLinearAlgebraWithFactorTraits_d of our own: one of CGAL's, which says
// what it is asked for.
typedef CGAL::Eigen_sparse_matrix<double>::EigenType         Eigen_matrix;
typedef CGAL::Eigen_solver_traits<Eigen::SparseLU<Eigen_matrix, Eigen::COLAMDOrdering<int> > > Base_solver;

struct Talkative_solver : public Base_solver
{
  bool factor(const Matrix& A, NT& D)
  {
    std::cout << "  factorizing " << A.row_dimension() << " x " << A.column_dimension() << std::endl;
    return Base_solver::factor(A, D);
  }
};

// A model of ConformalEquivalenceVisitor that tells the progress and stops after some steps.
struct Progress_visitor
{
  std::size_t most_steps;
  std::size_t steps = 0;

  void on_stage(CE::Stage stage) { std::cout << "stage " << static_cast<int>(stage) << std::endl; }
  void on_iteration(std::size_t step, double residual)
  {
    steps = step;
    std::cout << "  step " << step << ": residual " << residual << std::endl;
  }
  bool go_further() { return steps < most_steps; }
};

SMP::Error_code flatten(Mesh& sm, Progress_visitor& visitor)
{
  const halfedge_descriptor bhd = PMP::longest_border(sm).first;
  auto uv = sm.add_property_map<vertex_descriptor, Point_2>("v:uv").first;
  CE::Flattening_report<Mesh> report;
  SMP::Conformal_equivalence_parameterizer_3<Mesh, Talkative_solver> parameterizer(
    params::flattening_report(std::ref(report)).visitor(std::ref(visitor)));
  //! [part]
  const SMP::Error_code e = SMP::parameterize(sm, parameterizer, bhd, uv);
  std::cout << CE::message(report) << std::endl;
  return e;
}

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/nefertiti.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }
  if(PMP::longest_border(sm).first == Mesh::null_halfedge())
  {
    std::cerr << "The mesh has no border: " << filename << std::endl;
    return EXIT_FAILURE;
  }
  Progress_visitor patient{100}, impatient{2};
  if(flatten(sm, patient) != SMP::OK)
    return EXIT_FAILURE;
  return flatten(sm, impatient) != SMP::OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
