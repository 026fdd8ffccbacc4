// SPDX-License-Identifier: BSD-3-Clause
// Where the splitting on supports starts from, and what it hands on.
#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/cell_geometry.h"
#include "problem/boundary_flux.h"
#include "solver/supports/support_splitting.h"
#include "solver/warm_start/flux_length.h"

namespace flbc::supports {

// a = sigma w on the lists, boundary rows included.
template <class Scalar, class Stored, int Dim>
void SupportSplitting<Scalar, Stored, Dim>::set_weights(const VectorsAt<1>& weights) {
  const auto num_interior = static_cast<Index>(data_.vertices.size());
#pragma omp parallel for schedule(static)
  for (Index row = 0; row < lists_.num_rows(); ++row) {
    Eigen::VectorXd numbers;
    if (row < num_interior) {
      numbers = weights(data_.vertices[row]);
    } else {
      numbers = Eigen::VectorXd::Zero(n_);
      problem_.boundary.scatter(row - num_interior, numbers);
    }
    const std::size_t start = lists_.starts[row];
    for (Index j = 0; j < lists_.counts[row]; ++j) {
      extrapolated_[start + j] = static_cast<Scalar>(sigma() * numbers[lists_.items[start + j]]);
    }
  }
  // Weights cut off have to come back elsewhere in the row.
  std::fill_n(residual_.data(), residual_.size(), Scalar(0));
  pass_rows(kernel_.correct);
  std::copy_n(extrapolated_.data(), relaxed_.size(), relaxed_.data());
}

template <class Scalar, class Stored, int Dim>
void SupportSplitting<Scalar, Stored, Dim>::set_cell_dual(const VectorsAt<Dim>& flux_density) {
  const auto num_patches = static_cast<Index>(patches_.patches.size());
#pragma omp parallel
  {
    AlignedArray<Scalar> rows(Dim * (padded(static_cast<std::size_t>(n_)) + kRowLanes));
#pragma omp for schedule(static)
    for (Index p = 0; p < num_patches; ++p) {
      const Patch& patch = patches_.patches[p];
      for (Index k = patch.first_cell; k < patch.end_cell; ++k) {
        const Index s = patches_.cell_index[k];
        const double scale = compact::dual_scale(problem_, metric_, unit_, s);
        const Eigen::Matrix<double, Eigen::Dynamic, Dim> density = flux_density(s);
        for (std::size_t j = 0; j < patch.stride; ++j) {
          const Index i = patches_.items[patch.first_item + j];
          for (int d = 0; d < Dim; ++d) {
            rows[d * patch.stride + j] =
                i < n_ ? static_cast<Scalar>(scale * density(i, d)) : Scalar(0);
          }
        }
        kernel_.encode(
            rows.data(),
            cell_dual_.data() + Dim * (patch.first_number + (k - patch.first_cell) * patch.stride),
            Dim * patch.stride);
      }
    }
  }
}

template <class Scalar, class Stored, int Dim>
void SupportSplitting<Scalar, Stored, Dim>::set_vertex_dual(const VectorsAt<1>& vertex_dual) {
  const std::size_t num_rows = has_vertex_dual() ? data_.vertices.size() : 0;
#pragma omp parallel for schedule(static)
  for (std::size_t row = 0; row < num_rows; ++row) {
    const std::size_t start = lists_.starts[row];
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(n_);
    if (vertex_dual) numbers = vertex_dual(data_.vertices[row]);
    for (Index j = 0; j < lists_.counts[row]; ++j) {
      vertex_dual_[start + j] = static_cast<Scalar>(sigma() * numbers[lists_.items[start + j]]);
      residual_[start + j] = data_.vertex_metric[row] * vertex_dual_[start + j];
    }
  }
}

// As in CompactSplitting: what the duals would do to the weights is taken from W instead.
template <class Scalar, class Stored, int Dim>
void SupportSplitting<Scalar, Stored, Dim>::start_from_duals(const VectorsAt<1>& weights,
                                                             const VectorsAt<Dim>& flux_density,
                                                             const VectorsAt<1>& vertex_dual) {
  set_weights(weights);
  set_cell_dual(flux_density);
  set_vertex_dual(vertex_dual);
  pass_cells(false, 0);
  collect_divergence();
  multigrid_.cycle(residual_.data());
  pass_rows(kernel_.correct);
  for (std::size_t k = 0; k < relaxed_.size(); ++k) {
    relaxed_[k] = 2 * relaxed_[k] - extrapolated_[k];
  }
  pass_rows(kernel_.w_step);
}

// A vertex's numbers for all control points, zero outside its support.
template <class Scalar, class Stored, int Dim>
template <class NumberAt>
Eigen::VectorXd SupportSplitting<Scalar, Stored, Dim>::spread(Index vertex,
                                                              const NumberAt& number_at) const {
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(n_);
  const Index row = data_.row_of[vertex];
  const std::size_t start = lists_.starts[row];
  for (Index j = 0; j < lists_.counts[row]; ++j) {
    numbers[lists_.items[start + j]] = number_at(start + j);
  }
  return numbers;
}

// Boundary values are known better than single precision holds them.
template <class Scalar, class Stored, int Dim>
SparseWeights SupportSplitting<Scalar, Stored, Dim>::sparse_weights() const {
  std::vector<std::int64_t> starts{0};
  std::vector<std::uint32_t> control_points;
  std::vector<double> values;
  const auto add = [&](Index i, double weight) {
    if (weight == 0) return;
    control_points.push_back(static_cast<std::uint32_t>(i));
    values.push_back(weight);
  };
  Eigen::VectorXd given(n_);
  for (Index v = 0; v < problem_.mesh.num_vertices(); ++v) {
    const auto list = supports_.of(v);
    if (problem_.boundary.is_interior(v)) {
      Index place = 0;
      for (const ControlPoint i : list) add(i, weight(v, place++));
    } else {
      given.setZero();
      problem_.boundary.scatter(problem_.boundary.boundary_index[v], given);
      for (const ControlPoint i : list) add(i, given[i]);
    }
    starts.push_back(static_cast<std::int64_t>(values.size()));
  }
  return {n_, std::move(starts), std::move(control_points), std::move(values)};
}

template <class Scalar, class Stored, int Dim>
Eigen::VectorXd SupportSplitting<Scalar, Stored, Dim>::weights_at(Index vertex) const {
  return spread(vertex, [&](std::size_t place) { return weight_at(place); });
}

template <class Scalar, class Stored, int Dim>
Eigen::VectorXd SupportSplitting<Scalar, Stored, Dim>::vertex_dual_at(Index vertex) const {
  return spread(vertex, [&](std::size_t place) {
    const double difference =
        static_cast<double>(extrapolated_[place]) - static_cast<double>(relaxed_[place]);
    return (vertex_dual_[place] - 0.5 * difference) / sigma();
  });
}

template <class Scalar, class Stored, int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> SupportSplitting<Scalar, Stored, Dim>::flux_density(
    Index cell) const {
  if (is_boundary_cell(problem_, cell)) return boundary_flux_density(problem_, cell);
  Eigen::Matrix<double, Eigen::Dynamic, Dim> density =
      Eigen::Matrix<double, Eigen::Dynamic, Dim>::Zero(n_, Dim);
  const Index k = patches_.place_of_cell[cell];
  const Patch& patch = patches_.patches[k / kPatchCells];
  AlignedArray<Scalar> rows(Dim * patch.stride);
  const std::size_t first = patch.first_number + (k - patch.first_cell) * patch.stride;
  kernel_.decode(cell_dual_.data() + Dim * first, rows.data(), Dim * patch.stride);
  const double scale = 1 / compact::dual_scale(problem_, metric_, unit_, cell);
  for (std::size_t j = 0; j < patch.stride; ++j) {
    const Index i = patches_.items[patch.first_item + j];
    if (i >= n_) break;
    for (int d = 0; d < Dim; ++d) density(i, d) = scale * rows[d * patch.stride + j];
  }
  // Relaxed duals may be longer.
  shorten_to(problem_.phi, cell, density);
  return density;
}

#define FLBC_INSTANTIATE(Scalar, Stored, Dim)                                                  \
  template SparseWeights SupportSplitting<Scalar, Stored, Dim>::sparse_weights() const;        \
  template void SupportSplitting<Scalar, Stored, Dim>::start_from_duals(                       \
      const VectorsAt<1>&, const VectorsAt<Dim>&, const VectorsAt<1>&);                        \
  template Eigen::VectorXd SupportSplitting<Scalar, Stored, Dim>::weights_at(Index) const;     \
  template Eigen::VectorXd SupportSplitting<Scalar, Stored, Dim>::vertex_dual_at(Index) const; \
  template Eigen::Matrix<double, Eigen::Dynamic, Dim>                                          \
      SupportSplitting<Scalar, Stored, Dim>::flux_density(Index) const;
FLBC_INSTANTIATE(float, compact::Half, 2)
FLBC_INSTANTIATE(float, compact::Half, 3)
FLBC_INSTANTIATE(float, float, 2)
FLBC_INSTANTIATE(float, float, 3)
FLBC_INSTANTIATE(double, double, 2)
FLBC_INSTANTIATE(double, double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::supports
