// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/boundary_values.h"

#include <limits>
#include <string>

#include <Eigen/LU>

#include "base/messages.h"
#include "cage/facet_locator.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

constexpr double kDistanceTolerance = 1e-6;     // of the cage's size
constexpr double kCoordinateTolerance = 1e-12;  // below it a barycentric coordinate is rounding

// A cage facet, prepared for locating points on it.
template <int Dim>
struct LocatedFacet {
  Eigen::Matrix<double, Dim, Dim> corners;
  Vector<Dim> low, high;                               // bounding box, widened by the tolerance
  Eigen::Matrix<double, Dim - 1, Dim> to_barycentric;  // pseudo-inverse of the edge vectors
};

template <int Dim>
std::vector<LocatedFacet<Dim>> prepare_facets(const Cage<Dim>& cage, double tolerance) {
  std::vector<LocatedFacet<Dim>> facets(cage.facets.cols());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    auto& facet = facets[f];
    for (int k = 0; k < Dim; ++k) facet.corners.col(k) = cage.points.col(cage.facets(k, f));
    facet.low = facet.corners.rowwise().minCoeff().array() - tolerance;
    facet.high = facet.corners.rowwise().maxCoeff().array() + tolerance;
    Eigen::Matrix<double, Dim, Dim - 1> edges;
    for (int k = 1; k < Dim; ++k) edges.col(k - 1) = facet.corners.col(k) - facet.corners.col(0);
    facet.to_barycentric = (edges.transpose() * edges).inverse() * edges.transpose();
  }
  return facets;
}

// Coordinates of the point's projection on the facet's plane, with what is outside the facet or due
// to rounding cut off, so that a point on an edge or at a corner has exact zeros elsewhere.
template <int Dim>
Vector<Dim> barycentric_coordinates(const LocatedFacet<Dim>& facet, const Vector<Dim>& point) {
  Vector<Dim> coordinates;
  coordinates.template tail<Dim - 1>() = facet.to_barycentric * (point - facet.corners.col(0));
  coordinates[0] = 1 - coordinates.template tail<Dim - 1>().sum();
  for (double& c : coordinates) {
    if (c < kCoordinateTolerance) c = 0;
  }
  return coordinates / coordinates.sum();
}

// Where on the cage a point is.
template <int Dim>
struct Place {
  double distance = std::numeric_limits<double>::infinity();
  Index facet = -1;
  Vector<Dim> coordinates;
};

// \return facet -1 if the point is outside all bounding boxes
template <int Dim>
Place<Dim> nearest_place(const std::vector<LocatedFacet<Dim>>& facets, const Vector<Dim>& point) {
  Place<Dim> nearest;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto& facet = facets[f];
    if ((point.array() < facet.low.array()).any() || (point.array() > facet.high.array()).any()) {
      continue;
    }
    const Vector<Dim> coordinates = barycentric_coordinates(facet, point);
    const double distance = (facet.corners * coordinates - point).norm();
    if (distance < nearest.distance) nearest = {distance, static_cast<Index>(f), coordinates};
  }
  return nearest;
}

// All vertices of a facet may lie on the cage and the facet not: where cells are missing.
template <int Dim>
void check_boundary_facets(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                           const std::vector<LocatedFacet<Dim>>& cage_facets, double tolerance) {
  for (Index f = 0; f < topology.num_facets(); ++f) {
    if (!topology.is_boundary(f)) continue;
    Vector<Dim> center = Vector<Dim>::Zero();
    for (int k = 0; k < Dim; ++k) center += mesh.points.col(topology.facets(k, f)) / Dim;
    if (nearest_place(cage_facets, center).distance <= tolerance) continue;
    throw InputError("the boundary " + std::string(Dim == 2 ? "edge" : "face") + " of cell " +
                     std::to_string(topology.sides(0, f)) + " of the domain mesh at " +
                     format_point(center) +
                     " does not lie on the cage; the mesh must fill the cage");
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
      throw InputError(
          "control point " + std::to_string(i) + " at " + format_point(cage.points.col(i)) +
          " is no vertex of the domain mesh; the mesh must have been made of this cage");
    }
  }
}

}  // namespace

template <int Dim>
BoundaryValues<Dim> boundary_values(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                    const MeshTopology<Dim>& topology) {
  const double tolerance = kDistanceTolerance * bounding_box_diagonal(cage.points);
  const auto facets = prepare_facets(cage, tolerance);
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
    const auto nearest = nearest_place(facets, point);
    if (!(nearest.distance <= tolerance)) {
      throw InputError("boundary vertex " + std::to_string(boundary.vertices[b]) +
                       " of the domain mesh at " + format_point(point) +
                       " does not lie on the cage");
    }
    boundary.control_points.col(b) = cage.facets.col(nearest.facet);
    boundary.values.col(b) = nearest.coordinates;
  }
  check_boundary_facets(mesh, topology, facets, 2 * tolerance);
  find_control_vertices(cage, mesh, boundary);
  return boundary;
}

template BoundaryValues<2> boundary_values(const Cage<2>&, const DomainMesh<2>&,
                                           const MeshTopology<2>&);
template BoundaryValues<3> boundary_values(const Cage<3>&, const DomainMesh<3>&,
                                           const MeshTopology<3>&);

template <int Dim>
void snap_to_cage(const Cage<Dim>& cage, const MeshTopology<Dim>& topology, double tolerance,
                  DomainMesh<Dim>& mesh) {
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

template void snap_to_cage(const Cage<2>&, const MeshTopology<2>&, double, DomainMesh<2>&);
template void snap_to_cage(const Cage<3>&, const MeshTopology<3>&, double, DomainMesh<3>&);

}  // namespace flbc
