#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;

typedef CE::Intrinsic_triangulation<double>                  Triangulation;
typedef std::vector<double>                                  Vector;

// The right-hand side of the flow du/dt = -K: the curvature of the metric with the scale
// factors u, in the interior; on the border u stays as it is.
Vector velocity(const Triangulation& t, const Vector& u)
{
  Vector v = CE::discrete_curvatures(CE::apply_log_scale_factors(t, u));
  for(Triangulation::Index i = 0; i < v.size(); ++i)
    v[i] = t.is_border_vertex(i) ? 0 : -v[i];
  return v;
}

Vector sum(const Vector& x, double a, const Vector& y)
{
  Vector z(x);
  for(std::size_t i = 0; i < z.size(); ++i)
    z[i] += a * y[i];
  return z;
}

double size(const Vector& x)
{
  double largest = 0;
  for(double e : x)
    largest = (std::max)(largest, std::abs(e));
  return largest;
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
  const CE::Imported_mesh<Mesh> mesh = CE::import_mesh(sm);
  if(mesh.status != CE::Status::OK)
  {
    std::cerr << CE::message(mesh.status) << std::endl;
    return EXIT_FAILURE;
  }
  const Triangulation& t = mesh.triangulation;

  // Heun's method. A step is taken if the velocity changes by at most half of it.
  Vector u(t.number_of_vertices(), 0), v = velocity(t, u);
  double time = 0, step = 0.1;
  std::size_t number_of_steps = 0;
  while(size(v) > 1e-11 && number_of_steps < 1000000)
  {
    const Vector v_ahead = velocity(t, sum(u, step, v));
    if(size(sum(v_ahead, -1, v)) > size(v) / 2)
    {
      step /= 2;
      continue;
    }
    u = sum(sum(u, step / 2, v), step / 2, v_ahead);
    v = velocity(t, u);
    time += step;
    step *= 1.1;
    ++number_of_steps;
  }
  std::cout << "flow: curvature " << size(v) << " at time " << time << ", after "
            << number_of_steps << " steps" << std::endl;

  //! [part]
  // Newton's method on the energy of which the flow is the gradient flow.
  const auto metric = CE::compute_conformal_metric(t, CE::Conformal_conditions<double>(t));
  //! [part]
  if(!metric)
  {
    std::cerr << CE::message(metric.status) << std::endl;
    return EXIT_FAILURE;
  }
  const double difference = size(sum(u, -1, metric.log_scale_factors));
  std::cout << "solver: curvature " << metric.statistics.residual << " after "
            << metric.statistics.number_of_iterations << " Newton steps" << std::endl;
  std::cout << "largest difference of u: " << difference << std::endl;
  return difference < 1e-8 ? EXIT_SUCCESS : EXIT_FAILURE;
}
