// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/gradients.h"

#include <string>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "flbc/cell_locator.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"
#include "mesh/vertex_cells.h"
#include "placement/place_on_cage.h"

namespace flbc {
namespace {

template <int Dim>
Eigen::Matrix<double, Dim, Dim> jacobian(const SparseWeights& gradients, Index point,
                                         const PointList<Dim>& pose) {
  Eigen::Matrix<double, Dim, Dim> sum = Eigen::Matrix<double, Dim, Dim>::Zero();
  if (!gradients.has_weights(point)) return sum.setIdentity();
  gradients.visit(point, [&](Index row, double derivative) {
    sum.col(row % Dim) += derivative * pose.col(row / Dim);
  });
  return sum;
}

}  // namespace

template <int Dim>
SparseWeights vertex_gradients(const DomainMesh<Dim>& mesh, const SparseWeights& weights) {
  check_elements(mesh.points, mesh.cells, kMeshNames);
  check_size(weights, weights.num_control_points(), mesh.num_vertices());
  const VertexCells around(mesh);
  const Index rows = Dim * weights.num_control_points();
  return SparseWeights::of(rows, mesh.num_vertices(), [&](Index v) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows);
    double measure = 0;
    for (const Index cell : around.cells_of(v)) {
      const auto geometry = cell_geometry(mesh, cell);
      for (int k = 0; k <= Dim; ++k) {
        const Vector<Dim> g = geometry.measure * geometry.hat_gradients.col(k);
        weights.visit(mesh.cells(k, cell),
                      [&](Index i, double weight) { sum.segment<Dim>(Dim * i) += weight * g; });
      }
      measure += geometry.measure;
    }
    sum /= measure;
    return sum;
  });
}

template <int Dim>
SparseWeights gradients_at(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                           const std::vector<Location<Dim>>& places) {
  const auto at_vertices = vertex_gradients(mesh, weights);
  const Index rows = at_vertices.num_control_points();
  return SparseWeights::of(rows, static_cast<Index>(places.size()),
                           [&](Index p) -> Eigen::VectorXd {
                             if (places[p].cell < 0) return Eigen::VectorXd::Zero(rows);
                             return interpolate(mesh, at_vertices, places[p]);
                           });
}

template <int Dim>
std::vector<Location<Dim>> places_in_mesh(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                          const Placement<Dim>& placement) {
  check_placement(cage, placement);
  auto places = placement.places;
  std::vector<bool> is_still(places.size(), false);
  for (const auto& point : placement.outside) {
    is_still[point.point] = placement.policy == OutsidePoints::kKeep;
  }
  std::vector<Index> missing;
  for (std::size_t p = 0; p < places.size(); ++p) {
    if (places[p].cell < 0 && !is_still[p]) missing.push_back(static_cast<Index>(p));
  }
  if (missing.empty()) return places;
  PointList<Dim> nearest(Dim, static_cast<Eigen::Index>(missing.size()));
  Eigen::Index column = 0;
  for (const auto& point : nearest_on_cage(cage, placement.points, missing)) {
    nearest.col(column++) = place_on_cage(cage, point);
  }
  const auto found = locate_points(mesh, nearest);
  for (std::size_t k = 0; k < missing.size(); ++k) places[missing[k]] = found[k];
  return places;
}

template <int Dim>
Eigen::MatrixXd jacobians(const SparseWeights& gradients, const PointList<Dim>& control_points) {
  const Index rows = gradients.num_control_points();
  if (rows != Dim * control_points.cols()) {
    throw InputError("gradients of " + std::to_string(control_points.cols()) +
                     " control points have " + std::to_string(Dim * control_points.cols()) +
                     " rows, not " + std::to_string(rows));
  }
  Eigen::MatrixXd result(Dim * Dim, gradients.num_points());
  parallel_for(gradients.num_points(), [&](Index p) {
    result.col(p) = jacobian<Dim>(gradients, p, control_points).reshaped();
  });
  return result;
}

template <int Dim>
PointJacobians<Dim>::PointJacobians(const Cage<Dim>& cage, DomainMesh<Dim> mesh,
                                    const SparseWeights& weights, const Placement<Dim>& placement)
    : mesh_(std::move(mesh)),
      gradients_(vertex_gradients(mesh_, weights)),
      places_(places_in_mesh(cage, mesh_, placement)) {
}

template <int Dim>
Eigen::MatrixXd PointJacobians<Dim>::at(const PointList<Dim>& control_points) const {
  const auto at_vertices = jacobians(gradients_, control_points);
  Eigen::MatrixXd result(Dim * Dim, static_cast<Eigen::Index>(places_.size()));
  parallel_for(static_cast<Index>(places_.size()), [&](Index p) {
    const auto& [cell, coordinates] = places_[p];
    result.col(p) = Eigen::Matrix<double, Dim, Dim>::Identity().reshaped();
    if (cell >= 0) result.col(p) = at_vertices(Eigen::all, mesh_.cells.col(cell)) * coordinates;
  });
  return result;
}

template class PointJacobians<2>;
template class PointJacobians<3>;
FLBC_INSTANTIATE_FUNCTION(vertex_gradients)
FLBC_INSTANTIATE_FUNCTION(gradients_at)
FLBC_INSTANTIATE_FUNCTION(jacobians)
FLBC_INSTANTIATE_FUNCTION(places_in_mesh)

}  // namespace flbc
