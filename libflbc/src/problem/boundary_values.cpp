// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/boundary_values.h"

#include <string>

#include "base/instantiate.h"
#include "base/messages.h"
#include "cage/facet_locator.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"

namespace flbc {
namespace {

constexpr double kDistanceTolerance = 1e-6;  // relative to cage size

// If cells are missing, all vertices of a facet may lie on the cage although the facet does not.
template <int Dim>
void check_boundary_facets(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                           const FacetLocator<Dim>& cage_facets, double tolerance) {
  for (Index f = 0; f < topology.num_facets(); ++f) {
    if (!topology.is_boundary(f)) continue;
    const Vector<Dim> center = centroid(mesh.points, topology.facets, f);
    if (cage_facets.nearest(center).distance <= tolerance) continue;
    throw InputError("the boundary " + std::string(Dim == 2 ? "edge" : "face") + " of cell " +
                     std::to_string(topology.sides(0, f)) + " of the domain mesh at " +
                     format_point(center) + " is not on the cage; the mesh must fill the cage");
  }
}

template <int Dim>
void find_control_vertices(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                           BoundaryValues<Dim>& boundary) {
  boundary.control_vertices.assign(cage.size(), -1);
  for (std::size_t b = 0; b < boundary.vertices.size(); ++b) {
    for (int k = 0; k < Dim; ++k) {
      if (boundary.values(k, b) != 1) continue;
      const Index i = boundary.control_points(k, b);
      Index& vertex = boundary.control_vertices[i];
      const auto distance = [&](Index v) {
        return (mesh.points.col(v) - cage.points.col(i)).norm();
      };
      if (vertex < 0 || distance(boundary.vertices[b]) < distance(vertex)) {
        vertex = boundary.vertices[b];
      }
    }
  }
  for (Index i = 0; i < cage.size(); ++i) {
    if (boundary.control_vertices[i] < 0) {
      throw InputError("control point " + std::to_string(i) + " at " +
                       format_point(cage.points.col(i)) +
                       " is not a vertex of the domain mesh; the mesh must be made from this cage");
    }
  }
}

}  // namespace

template <int Dim>
BoundaryValues<Dim> boundary_values(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                    const MeshTopology<Dim>& topology) {
  const double tolerance = kDistanceTolerance * bounding_box_diagonal(cage.points);
  const FacetLocator<Dim> facets(cage, tolerance);
  const auto on_boundary = boundary_vertices(topology, mesh.num_vertices());

  BoundaryValues<Dim> boundary;
  boundary.boundary_index.assign(mesh.num_vertices(), -1);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (!on_boundary[v]) continue;
    boundary.boundary_index[v] = static_cast<Index>(boundary.vertices.size());
    boundary.vertices.push_back(v);
  }
  boundary.control_points.resize(Dim, boundary.vertices.size());
  boundary.values.resize(Dim, boundary.vertices.size());

  for (std::size_t b = 0; b < boundary.vertices.size(); ++b) {
    const Vector<Dim> point = mesh.points.col(boundary.vertices[b]);
    const auto nearest = facets.nearest(point);
    if (!(nearest.distance <= tolerance)) {
      throw InputError("boundary vertex " + std::to_string(boundary.vertices[b]) +
                       " of the domain mesh at " + format_point(point) + " is not on the cage");
    }
    boundary.control_points.col(b) = cage.facets.col(nearest.facet);
    boundary.values.col(b) = nearest.coordinates;
  }
  check_boundary_facets(mesh, topology, facets, 2 * tolerance);
  find_control_vertices(cage, mesh, boundary);
  return boundary;
}

FLBC_INSTANTIATE_FUNCTION(boundary_values)

template <int Dim>
void snap_to_cage(const Cage<Dim>& cage, const MeshTopology<Dim>& topology, double tolerance,
                  DomainMesh<Dim>& mesh) {
  if (!(tolerance >= 0)) throw OptionError("the tolerance of snap_to_cage() must be 0 or more");
  constexpr double kExact = 1e-12;
  const double size = bounding_box_diagonal(cage.points);
  const FacetLocator<Dim> locator(cage, tolerance * size);
  const auto on_boundary = boundary_vertices(topology, mesh.num_vertices());
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (!on_boundary[v]) continue;
    Vector<Dim> point = mesh.points.col(v);
    Eigen::Index nearest = 0;
    const double distance = (cage.points.colwise() - point).colwise().norm().minCoeff(&nearest);
    if (distance <= tolerance * size) {
      mesh.points.col(v) = cage.points.col(nearest);
      continue;
    }
    const auto place = locator.locate(point);
    if (place.facet < 0 || place.distance <= kExact * size) continue;
    point.setZero();
    for (int k = 0; k < Dim; ++k) {
      point += place.coordinates[k] * cage.points.col(cage.facets(k, place.facet));
    }
    mesh.points.col(v) = point;
  }
}

FLBC_INSTANTIATE_FUNCTION(snap_to_cage)

}  // namespace flbc
