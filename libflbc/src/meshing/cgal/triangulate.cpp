// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "base/messages.h"
#include "base/stopwatch.h"
#include "flbc/errors.h"
#include "flbc/meshing.h"
#include "meshing/meshing_common.h"
#include "meshing/vertex_count_search.h"

namespace flbc {

namespace {

// Vertex information: its index in the resulting mesh.
struct VertexNumber {
  Index value = -1;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<VertexNumber, Kernel,
                                                CGAL::Delaunay_mesh_vertex_base_2<Kernel>>;
// Face information: its nesting level, the number of cage edges between it and the outside.
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using DataStructure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, DataStructure>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Mesher = CGAL::Delaunay_mesher_2<Triangulation, Criteria>;

constexpr double kShapeBound = 0.125;     // squared sine of the smallest angle wanted: 20.7 degrees
constexpr double kCountTolerance = 0.05;  // documented in MeshingOptions

// Larger minimal meshes, as for extremely thin cages, are rejected to limit time and memory.
constexpr std::size_t kMostByShape = 5000000;

// The constrained Delaunay triangulation of the input points and the cage edges.
Triangulation triangulate_input(const Cage<2>& cage, const PointList<2>& input) {
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> handles;
  Triangulation::Face_handle hint;
  for (Index i = 0; i < input.cols(); ++i) {
    handles.push_back(triangulation.insert(Kernel::Point_2(input(0, i), input(1, i)), hint));
    handles.back()->info().value = i;
    hint = handles.back()->face();
  }
  for (Index edge = 0; edge < cage.facets.cols(); ++edge) {
    triangulation.insert_constraint(handles[cage.facets(0, edge)], handles[cage.facets(1, edge)]);
  }
  return triangulation;
}

// Marks faces separated from the outside by an odd number of cage edges. Holes then need no seeds,
// and loops no orientation.
void mark_domain(Triangulation& triangulation) {
  constexpr int kUnknown = -1;
  for (auto face : triangulation.all_face_handles()) face->info() = kUnknown;
  std::deque<Triangulation::Face_handle> faces{triangulation.infinite_face()};
  faces.front()->info() = 0;
  while (!faces.empty()) {
    const Triangulation::Face_handle face = faces.front();
    faces.pop_front();
    face->set_in_domain(face->info() % 2 == 1);
    for (int side = 0; side < 3; ++side) {
      const Triangulation::Face_handle neighbour = face->neighbor(side);
      if (neighbour->info() != kUnknown) continue;
      const bool is_cage = face->is_constrained(side);
      neighbour->info() = face->info() + (is_cage ? 1 : 0);
      // 0-1 breadth-first search: each region is completed before the next one.
      is_cage ? faces.push_back(neighbour) : faces.push_front(neighbour);
    }
  }
}

// The faces inside, with the input points first.
DomainMesh<2> extract_mesh(Triangulation& triangulation, const PointList<2>& input) {
  DomainMesh<2> mesh;
  Index num_vertices = static_cast<Index>(input.cols());
  Index num_cells = 0;
  for (auto face : triangulation.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    ++num_cells;
    for (int k = 0; k < 3; ++k) {
      Index& number = face->vertex(k)->info().value;
      if (number < 0) number = num_vertices++;
    }
  }

  mesh.points.resize(2, num_vertices);
  mesh.cells.resize(3, num_cells);
  Index cell = 0;
  for (auto face : triangulation.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    for (int k = 0; k < 3; ++k) {
      const Index number = face->vertex(k)->info().value;
      const Kernel::Point_2& point = face->vertex(k)->point();
      mesh.points.col(number) << point.x(), point.y();
      mesh.cells(k, cell) = number;
    }
    ++cell;
  }
  mesh.points.leftCols(input.cols()) = input;
  return mesh;
}

// \param longest_edge  upper bound of edge lengths; 0 = none
DomainMesh<2> mesh_interior(const Cage<2>& cage, const PointList<2>& input, double longest_edge,
                            const MeshingOptions<2>& options) {
  Stopwatch watch;
  double seconds = 0;
  Triangulation triangulation = triangulate_input(cage, input);
  mark_domain(triangulation);
  Mesher mesher(triangulation, Criteria(kShapeBound, longest_edge));
  mesher.init(true);  // the domain is marked already
  // In steps, because the mesher has no size limit.
  const std::size_t limit = std::max(kMostByShape, 10 * static_cast<std::size_t>(options.vertices));
  while (mesher.try_one_step_refine_mesh()) {
    if (triangulation.number_of_vertices() > limit) {
      throw InputError("well-shaped triangles in this cage need more than " +
                       std::to_string(limit) +
                       " vertices; the cage is extremely thin somewhere, or points are extremely "
                       "close");
    }
    seconds += watch.lap();
    if (options.poll) options.poll();
    if (seconds > options.time_limit) {
      throw InputError(
          "CGAL was stopped at the time limit of " + format_number(options.time_limit) +
          " s (time_limit); raise the limit, ask for fewer vertices, or check the cage "
          "for places that are extremely thin");
    }
  }
  return extract_mesh(triangulation, input);
}

}  // namespace

DomainMesh<2> triangulate(const Cage<2>& cage, const MeshingOptions<2>& options) {
  validate(cage);
  const auto defects = find_self_intersections(cage, 1);
  if (!defects.empty()) throw InputError(defects.front().message);
  const PointList<2> input = collect_input_points(cage, options);

  const DecimalUnit<2> unit(cage.points);
  const auto scaled = unit.scaled(input);
  const auto make_mesh = [&](double longest_edge) {
    return mesh_interior(cage, scaled, longest_edge, options);
  };

  DomainMesh<2> mesh = make_mesh(0);
  check_vertex_count(options.vertices, mesh.num_vertices(), kCountTolerance);
  auto goal = VertexCountGoal<2>::of(options.vertices, kCountTolerance, mesh);
  if (options.vertices > mesh.num_vertices()) {
    // Assumes half as many vertices as triangles, and nearly equilateral triangles.
    const double first_bound = 1.6 * std::sqrt(total_measure(mesh) / goal.before_refining());
    mesh = search_vertex_count<2>(goal, std::move(mesh), first_bound, 2, make_mesh);
  }
  finish_mesh(mesh, static_cast<Index>(input.cols()));
  mesh.points = unit.restored(mesh.points, input);
  return goal.result(std::move(mesh));
}

}  // namespace flbc
