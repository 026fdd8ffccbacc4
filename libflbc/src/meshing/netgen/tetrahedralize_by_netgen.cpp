// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "base/messages.h"
#include "base/stopwatch.h"
#include "cage/oriented_cage.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "meshing/meshing_common.h"
#include "meshing/netgen/netgen_run.h"
#include "meshing/surface_subdivision.h"
#include "meshing/vertex_count_search.h"

namespace flbc {

namespace {

constexpr double kCountTolerance = 0.10;  // promised by MeshingOptions

// How the vertex count falls with the longest edge: by the square on the surface, by the third
// power inside.
constexpr double kCountExponent = 2.4;

// The facets of a cage are kept, so the mesh's volume is the cage's up to rounding.
constexpr double kVolumeTolerance = 1e-9;
// Netgen would take minutes for as many, and a mesh of 5,000,000 vertices has a quarter of them.
constexpr std::size_t kMaxSurfacePoints = 1'000'000;

// A cage to be filled.
struct Task {
  OrientedCage<3> oriented;
  double size;  // of the cage
  double time_limit;
};

double surface_area(const Cage<3>& cage) {
  double area = 0;
  for (Index t = 0; t < cage.facets.cols(); ++t) {
    const Vector<3> a = cage.points.col(cage.facets(0, t));
    const Vector<3> b = cage.points.col(cage.facets(1, t));
    const Vector<3> c = cage.points.col(cage.facets(2, t));
    area += (b - a).cross(c - a).norm() / 2;
  }
  return area;
}

// The longest edge with which about so many vertices are to be expected: 3.2 per squared edge of
// surface and 1.3 per cubed edge of volume, as measured on cages of animals.
double guess_longest_edge(const Task& task, Index vertices) {
  const double area = surface_area(task.oriented.cage), volume = task.oriented.measure;
  double finest = 0, coarsest = task.size;
  for (int step = 0; step < 60; ++step) {
    const double edge = (finest + coarsest) / 2;
    const double count = 3.2 * area / (edge * edge) + 1.3 * volume / (edge * edge * edge);
    (count > vertices ? finest : coarsest) = edge;
  }
  return coarsest;
}

void check_surface_is_kept(const Task& task, const Cage<3>& surface, const DomainMesh<3>& mesh) {
  const bool has_points = mesh.num_vertices() >= surface.size() &&
                          mesh.points.leftCols(surface.size()) == surface.points;
  double volume = 0;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    volume += std::abs(signed_measure(mesh, cell));
  }
  if (has_points && std::abs(volume / task.oriented.measure - 1) <= kVolumeTolerance) return;
  throw InputError("Netgen did not fill the cage: its volume is " +
                   format_number(task.oriented.measure) + ", that of the cells " +
                   format_number(volume));
}

DomainMesh<3> fill_once(const Task& task, const Cage<3>& surface, double longest, double seconds) {
  DomainMesh<3> mesh = run_netgen(surface, longest, seconds, task.time_limit);
  check_surface_is_kept(task, surface, mesh);
  return mesh;
}

// Netgen fails on some surfaces and not on others of the same shape: coarse triangles on thin walls
// are the worst. \param longest  edges to try in turn, all within one limit of time
DomainMesh<3> fill_by_first(const Task& task, const std::vector<double>& longest) {
  Stopwatch watch;
  double left = task.time_limit;
  for (std::size_t k = 0;; ++k) {
    // Where this has too many points, shorter edges would have still more.
    const auto surface = subdivide_surface(task.oriented.cage, longest[k], kMaxSurfacePoints);
    try {
      return fill_once(task, surface, longest[k], left);
    } catch (const InputError&) {
      left -= watch.lap();
      if (k + 1 == longest.size() || left <= 0) throw;
    }
  }
}

DomainMesh<3> fill(const Task& task, double longest) {
  return fill_by_first(task, {longest, 0.9 * longest, 0.75 * longest});
}

DomainMesh<3> fill_coarsely(const Task& task) {
  std::vector<double> longest{task.size};
  for (int halving = 0; halving < 5; ++halving) longest.push_back(longest.back() / 2);
  return fill_by_first(task, longest);
}

DomainMesh<3> fill_with(const Task& task, Index vertices, bool roughly) {
  if (vertices == 0) return fill_coarsely(task);
  const double first = guess_longest_edge(task, vertices);
  DomainMesh<3> mesh = fill(task, first);
  if (roughly) return mesh;
  VertexCountGoal goal;
  goal.vertices = vertices;
  goal.good_enough = kCountTolerance;
  goal.max_runs = 4;
  const double ratio = double(mesh.num_vertices()) / vertices;
  mesh = search_vertex_count<3>(goal, std::move(mesh), first * std::pow(ratio, 1 / kCountExponent),
                                kCountExponent,
                                [&](double longest) { return fill(task, longest); });
  // Regular surfaces are all divided at the same length, so that the count jumps; that is no reason
  // to refuse.
  if (mesh.num_vertices() > (1 + kCountTolerance) * vertices) {
    check_vertex_count(vertices, fill_coarsely(task).num_vertices(), kCountTolerance);
  }
  return mesh;
}

}  // namespace

DomainMesh<3> tetrahedralize_by_netgen(const Cage<3>& cage, const MeshingOptions<3>& options) {
  validate(cage);
  collect_input_points(cage, options);  // checks the options
  if (options.embedded_points.cols() > 0) {
    throw OptionError("Netgen cannot make given points vertices of its mesh (--embed, --mesher)");
  }
  const Task task{orient(cage), bounding_box_diagonal(cage.points), options.time_limit};
  DomainMesh<3> mesh = fill_with(task, options.vertices, options.roughly);
  finish_mesh(mesh, cage.size());
  return mesh;
}

}  // namespace flbc
