// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/gradients.h"

#include <string>

#include "base/instantiate.h"
#include "base/weight_columns.h"
#include "coordinates/place_on_cage.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "flbc/interpolate.h"
#include "mesh/cell_geometry.h"
#include "mesh/vertex_cells.h"

namespace flbc {
namespace {

// Adds w_i g^T, for all i, to the gradients of a point.
template <int Dim>
void add_outer(const WeightMatrix& weights, Index vertex, const Vector<Dim>& g,
               Eigen::VectorXd& sum) {
  sum.reshaped(Dim, weights.rows()) += g * weights.col(vertex).transpose();
}
template <int Dim>
void add_outer(const SparseWeights& weights, Index vertex, const Vector<Dim>& g,
               Eigen::VectorXd& sum) {
  weights.visit(vertex, [&](Index i, double weight) { sum.segment<Dim>(Dim * i) += weight * g; });
}

template <int Dim, class Weights>
void add_cell_gradients(const DomainMesh<Dim>& mesh, const Weights& weights, Index cell,
                        const CellGeometry<Dim>& geometry, double factor, Eigen::VectorXd& sum) {
  for (int k = 0; k <= Dim; ++k) {
    const Vector<Dim> g = factor * geometry.hat_gradients.col(k);
    add_outer<Dim>(weights, mesh.cells(k, cell), g, sum);
  }
}

template <class Weights>
Index num_rows(const Weights& weights, int dim) {
  return static_cast<Index>(dim * num_control_points(weights));
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim> jacobian(const WeightMatrix& gradients, Index point,
                                         const PointList<Dim>& pose) {
  return pose * gradients.col(point).reshaped(Dim, pose.cols()).transpose();
}
template <int Dim>
Eigen::Matrix<double, Dim, Dim> jacobian(const SparseWeights& gradients, Index point,
                                         const PointList<Dim>& pose) {
  Eigen::Matrix<double, Dim, Dim> sum = Eigen::Matrix<double, Dim, Dim>::Zero();
  gradients.visit(point, [&](Index row, double derivative) {
    sum.col(row % Dim) += derivative * pose.col(row / Dim);
  });
  return sum;
}

}  // namespace

template <int Dim, class Weights>
Weights vertex_gradients(const DomainMesh<Dim>& mesh, const Weights& weights) {
  const VertexCells around(mesh);
  const Index rows = num_rows(weights, Dim);
  return weights_of_points<Weights>(rows, mesh.num_vertices(), [&](Index v) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows);
    double measure = 0;
    for (const Index cell : around.cells_of(v)) {
      const auto geometry = cell_geometry(mesh, cell);
      add_cell_gradients(mesh, weights, cell, geometry, geometry.measure, sum);
      measure += geometry.measure;
    }
    sum /= measure;
    return sum;
  });
}

template <int Dim, class Weights>
Weights gradients_at(const DomainMesh<Dim>& mesh, const Weights& weights,
                     const std::vector<Location<Dim>>& places, GradientKind kind) {
  const Index rows = num_rows(weights, Dim);
  const auto count = static_cast<Index>(places.size());
  if (kind == GradientKind::kSmooth) {
    const auto at_vertices = vertex_gradients(mesh, weights);
    return weights_of_points<Weights>(
        rows, count, [&](Index p) { return interpolate(mesh, at_vertices, places[p]); });
  }
  return weights_of_points<Weights>(rows, count, [&](Index p) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows);
    const Index cell = places[p].cell;
    add_cell_gradients(mesh, weights, cell, cell_geometry(mesh, cell), 1, sum);
    return sum;
  });
}

template <int Dim>
std::vector<Location<Dim>> places_in_mesh(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                          const Placement<Dim>& placement) {
  auto places = placement.places;
  std::vector<Index> missing;
  for (std::size_t p = 0; p < places.size(); ++p) {
    if (places[p].cell < 0) missing.push_back(static_cast<Index>(p));
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

template <int Dim, class Weights>
Eigen::MatrixXd jacobians(const Weights& gradients, const PointList<Dim>& control_points) {
  const auto rows = num_control_points(gradients);
  if (rows != Dim * control_points.cols()) {
    throw InputError("gradients of " + std::to_string(control_points.cols()) +
                     " control points have " + std::to_string(Dim * control_points.cols()) +
                     " rows, not " + std::to_string(rows));
  }
  return weights_of_points<WeightMatrix>(
      Dim * Dim, static_cast<Index>(num_points(gradients)), [&](Index p) -> Eigen::VectorXd {
        return jacobian<Dim>(gradients, p, control_points).reshaped();
      });
}

#define FLBC_INSTANTIATE(Dim, Weights)                                            \
  template Weights vertex_gradients(const DomainMesh<Dim>&, const Weights&);      \
  template Weights gradients_at(const DomainMesh<Dim>&, const Weights&,           \
                                const std::vector<Location<Dim>>&, GradientKind); \
  template Eigen::MatrixXd jacobians(const Weights&, const PointList<Dim>&);
FLBC_INSTANTIATE(2, WeightMatrix)
FLBC_INSTANTIATE(3, WeightMatrix)
FLBC_INSTANTIATE(2, SparseWeights)
FLBC_INSTANTIATE(3, SparseWeights)
#undef FLBC_INSTANTIATE
FLBC_INSTANTIATE_FUNCTION(places_in_mesh)

}  // namespace flbc
