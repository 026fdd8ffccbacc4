// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/messages.h"
#include "base/stopwatch.h"
#include "cage/facet_geometry.h"
#include "cage/point_in_cage.h"
#include "flbc/bounding_box.h"
#include "flbc/cage_facts.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"
#include "meshing/meshing_common.h"
#include "meshing/tetgen/flat_parts.h"
#include "meshing/tetgen/tetgen_run.h"
#include "meshing/vertex_count_search.h"

namespace flbc {

namespace {

constexpr double kCountTolerance = 0.10;  // documented in MeshingOptions

constexpr double kRadiusEdgeRatio = 1.414;  // TetGen terminates for ratios above sqrt(2)

// Makes a mesh with bounds on the radius-edge ratio and the volume of cells.
using MeshMaker = std::function<DomainMesh<3>(double ratio, double largest_volume)>;

// Exponent of vertex count over volume bound, for meshes of about ten thousand vertices.
constexpr double kCountExponent = 0.8;

// The volume bound of cells for a number of vertices. Per unit of 1 / length^3, TetGen needs 0.22
// vertices in the volume, and 1.2 on the surface per unit of 1 / length^2; good shapes need about
// twice the coarsest mesh. Measured on 12 cages of 2,000 to 40,000 vertices: 87% are within 10%.
double guess_volume_bound(const Cage<3>& cage, double volume, Index coarsest, Index vertices) {
  const double area = area_of(cage.points, cage.facets);
  const double wanted = std::max(0.25 * vertices, vertices - 2.0 * coarsest);
  double density = std::cbrt(wanted / (0.22 * volume));  // 1 / length; too large without surface
  for (int k = 0; k < 20; ++k) {                         // Newton's method
    const double count = density * density * (0.22 * volume * density + 1.2 * area);
    density -= (count - wanted) / (density * (0.66 * volume * density + 2.4 * area));
  }
  return 1 / (density * density * density);
}

// Treatment of cage edges between coplanar facets.
enum class CoplanarFacets {
  kJoin,  // edges are lost, but TetGen rarely fails
  kKeep   // edges are kept, but TetGen may fail or not terminate
};

// p: fill the facets, and join facets at a flat angle; M: join none; q: bound the ratio of
// circumradius to shortest edge; a: bound the volume; J: keep unused points, so that input points
// keep their indices; Q: print nothing; S: maximum number of added points. Without Y, TetGen may
// add points on cage facets and edges, which good cells need.
std::string quality_switches(CoplanarFacets coplanar, double ratio, double largest_volume,
                             Index most_points) {
  char text[128];
  const char* merging = coplanar == CoplanarFacets::kKeep ? "M" : "";
  int length = std::snprintf(text, sizeof(text), "p%.9gq%gQJS%d%s", 180 - kCoplanarAngle, ratio,
                             most_points, merging);
  if (largest_volume > 0) {
    length += std::snprintf(text + length, sizeof(text) - length, "a%.17g", largest_volume);
  }
  return std::string(text, length);
}

// For each region between shells, the centroid of the largest cell, which is least affected by
// rounding.
std::map<Index, Vector<3>> points_in_regions(const TetgenOutput& filled) {
  std::map<Index, std::pair<double, Vector<3>>> largest;
  for (Index cell = 0; cell < filled.mesh.num_cells(); ++cell) {
    const Vector<3> center = centroid(filled.mesh.points, filled.mesh.cells, cell);
    const double volume = std::abs(signed_measure(filled.mesh, cell));
    auto& entry = largest.try_emplace(filled.regions[cell], 0.0, center).first->second;
    if (volume > entry.first) entry = {volume, center};
  }
  std::map<Index, Vector<3>> points;
  for (const auto& [region, entry] : largest) points.emplace(region, entry.second);
  return points;
}

// TetGen fills everything that the outermost shell encloses. A first coarse mesh identifies
// cavities, so later runs leave them empty.
PointList<3> find_cavities(const Cage<3>& cage, const Patience& patience) {
  const std::vector<Index> shells = facet_shells(cage);
  PointList<3> cavities(3, 0);
  if (*std::max_element(shells.begin(), shells.end()) == 0) return cavities;
  const TetgenOutput filled = run_tetgen({cage.points, cage.facets, cavities}, "pAQJ", patience);
  const CageLocator<3> locator(cage, 0);
  for (const auto& [region, point] : points_in_regions(filled)) {
    if (locator.locate(point) != Containment::kOutside) continue;
    cavities.conservativeResize(3, cavities.cols() + 1);
    cavities.rightCols<1>() = point;
  }
  return cavities;
}

[[noreturn]] void refuse_unused(const Cage<3>& cage, const PointList<3>& input, Index vertex) {
  const bool is_control_point = vertex < cage.size();
  throw InputError("TetGen left " +
                   (is_control_point ? "control point " + std::to_string(vertex)
                                     : "embedded point " + std::to_string(vertex - cage.size())) +
                   " at " + format_point(input.col(vertex)) +
                   " out of the mesh; it is too close to another point or facet");
}

// Removes points without a cell; every input point must have a cell.
DomainMesh<3> compact(const Cage<3>& cage, const PointList<3>& input, DomainMesh<3> mesh) {
  std::vector<Index> new_number(std::size_t(mesh.num_vertices()), -1);
  for (Index vertex : mesh.cells.reshaped()) new_number[vertex] = 0;
  Index count = 0;
  for (Index vertex = 0; vertex < mesh.num_vertices(); ++vertex) {
    if (new_number[vertex] < 0) {
      if (vertex < input.cols()) refuse_unused(cage, input, vertex);
      continue;
    }
    mesh.points.col(count) = mesh.points.col(vertex);
    new_number[vertex] = count++;
  }
  mesh.points.conservativeResize(3, count);
  for (Index& vertex : mesh.cells.reshaped()) vertex = new_number[vertex];
  return mesh;
}

// The cells of a regular cage are all halved at the same volume bound, so the count jumps. A
// different shape bound then gives counts in between.
DomainMesh<3> refine_to_count(const VertexCountGoal<3>& goal, double first_bound,
                              DomainMesh<3> coarsest, const MeshMaker& make_mesh) {
  DomainMesh<3> mesh = std::move(coarsest);
  for (double ratio : {kRadiusEdgeRatio, 1.3, 1.6, 1.2, 1.8}) {
    mesh = search_vertex_count<3>(goal, std::move(mesh), first_bound, kCountExponent,
                                  [&](double bound) { return make_mesh(ratio, bound); });
    if (goal.is_met(mesh)) break;
  }
  return mesh;
}

// Without a limit, well-shaped cells in a thin wall exhaust memory.
constexpr Index kMostPoints = 1000000;

// The cage to fill.
struct Task {
  const Cage<3>& cage;
  TetgenInput input;
  Index vertices;  // wanted; 0 = any
};

// \param patience  for each run of TetGen
DomainMesh<3> fill(const Task& task, CoplanarFacets coplanar, const Patience& patience) {
  // TetGen, if it does not fail, makes the coarsest mesh at once. Others get the time for as many
  // vertices, and far more, unless TetGen does not terminate.
  const bool may_hang = coplanar == CoplanarFacets::kKeep;
  Patience time = patience;
  if (may_hang)
    time.seconds =
        std::min(time.seconds, 10 + 1e-3 * static_cast<double>(task.input.points.cols()));
  const Index most_points = std::max(kMostPoints, 4 * task.vertices);
  const DecimalUnit<3> unit(task.input.points);
  const auto make_mesh = [&](double ratio, double largest_volume) {
    const double volume = largest_volume / std::pow(unit.length(), 3);
    const std::string switches = quality_switches(coplanar, ratio, volume, most_points);
    DomainMesh<3> mesh = run_tetgen(task.input, switches, time).mesh;
    if (mesh.num_vertices() - task.input.points.cols() >= most_points) {
      throw InputError("well-shaped cells would need more than " + std::to_string(most_points) +
                       " vertices in this cage" + describe_thinnest(task.cage) +
                       "; move control points at thin places apart, or use another mesher");
    }
    peel_flat_cells(task.cage, static_cast<Index>(task.input.points.cols()), mesh);
    return compact(task.cage, task.input.points, std::move(mesh));
  };
  Stopwatch watch;
  DomainMesh<3> mesh = make_mesh(kRadiusEdgeRatio, 0);
  check_vertex_count(task.vertices, mesh.num_vertices(), kCountTolerance);
  if (may_hang) {
    const double ratio = static_cast<double>(task.vertices) / mesh.num_vertices();
    time.seconds = std::min(patience.seconds, 5 + 20 * watch.lap() * std::max(1.0, ratio));
  }
  const auto goal = VertexCountGoal<3>::of(task.vertices, kCountTolerance, mesh);
  if (task.vertices > mesh.num_vertices()) {
    const double bound = guess_volume_bound(task.cage, std::abs(total_measure(mesh)),
                                            mesh.num_vertices(), goal.before_refining());
    mesh = refine_to_count(goal, bound, std::move(mesh), make_mesh);
  }
  finish_mesh(mesh, static_cast<Index>(task.input.points.cols()));
  return goal.result(std::move(mesh));
}

// A mesh that also contains cage edges between coplanar facets; empty if TetGen fails. Without
// these edges, boundary values are not exactly linear along them, which is better than having no
// mesh.
DomainMesh<3> keep_coplanar_edges(const Task& task, const Patience& patience) {
  try {
    return fill(task, CoplanarFacets::kKeep, patience);
  } catch (const InputError&) {
  } catch (const OptionError&) {
  }
  return {};
}

// TetGen makes another mesh of a cage that is turned inward.
Cage<3> outward(Cage<3> cage) {
  const Vector<3> origin = cage.points.col(0);
  if (signed_measure<3>(cage, origin) < 0) cage.facets.row(1).swap(cage.facets.row(2));
  return cage;
}

}  // namespace

DomainMesh<3> tetrahedralize(const Cage<3>& given, const MeshingOptions<3>& options) {
  validate(given);
  const Cage<3> cage = outward(given);
  const PointList<3> points = collect_input_points(cage, options);
  const Patience patience{options.time_limit, options.poll};
  const Task task{cage, {points, cage.facets, find_cavities(cage, patience)}, options.vertices};

  DomainMesh<3> mesh;
  try {
    if (has_coplanar_facets(cage)) {
      mesh = keep_coplanar_edges(task, patience);
    }
    const bool has_count =
        mesh.num_vertices() > 0 &&
        (task.vertices == 0 || VertexCountGoal<3>{task.vertices, kCountTolerance}.is_met(mesh));
    if (!has_count) mesh = fill(task, CoplanarFacets::kJoin, patience);
  } catch (const InputError& error) {
    if (mesh.num_vertices() == 0) throw InputError(error.what() + describe_thinnest(cage));
  } catch (const TooFewVertices&) {  // joined facets of thin rods need more cells
    if (mesh.num_vertices() == 0) throw;
  }
  return mesh;
}

}  // namespace flbc
