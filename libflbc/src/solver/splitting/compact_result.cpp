// SPDX-License-Identifier: BSD-3-Clause
// What the compact splitting hands back.
#include <algorithm>
#include <cmath>

#include "mesh/cell_geometry.h"
#include "problem/boundary_flux.h"
#include "solver/splitting/compact_splitting.h"
#include "solver/warm_start/flux_length.h"

namespace flbc::compact {

template <class Scalar, class Stored, int Dim>
WeightMatrix CompactSplitting<Scalar, Stored, Dim>::weights() const {
  WeightMatrix weights(n_, problem_.mesh.num_vertices());
#pragma omp parallel
  {
    AlignedArray<Scalar> numbers(stride_);
#pragma omp for schedule(static)
    for (std::size_t row = 0; row < data_.vertices.size(); ++row) {
      read_vertex(data_.vertices[row], numbers.data());
      for (Index i = 0; i < n_; ++i) weights(i, data_.vertices[row]) = numbers[i];
    }
  }
  // Boundary values are known better than single precision holds them.
  problem_.boundary.impose_on(weights);
  return weights;
}

template <class Scalar, class Stored, int Dim>
Eigen::VectorXd CompactSplitting<Scalar, Stored, Dim>::weights_at(Index vertex) const {
  AlignedArray<Scalar> numbers(stride_);
  read_vertex(vertex, numbers.data());
  return Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>(numbers.data(), n_)
      .template cast<double>();
}

template <class Scalar, class Stored, int Dim>
Eigen::VectorXd CompactSplitting<Scalar, Stored, Dim>::vertex_dual_at(Index vertex) const {
  Eigen::VectorXd dual(n_);
  const auto row = static_cast<std::size_t>(data_.row_of[vertex]);
  const auto v = static_cast<std::size_t>(vertex);
  for (Index i = 0; i < n_; ++i) {
    const double difference = static_cast<double>(extrapolated_[row * stride_ + i]) -
                              static_cast<double>(relaxed_[v * stride_ + i]);
    dual[i] = (vertex_dual_[v * stride_ + i] - 0.5 * difference) / sigma();
  }
  return dual;
}

template <class Scalar, class Stored, int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> CompactSplitting<Scalar, Stored, Dim>::flux_density(
    Index cell) const {
  if (is_boundary_cell(problem_, cell)) return boundary_flux_density(problem_, cell);
  AlignedArray<Scalar> rows(Dim * stride_);
  for (int d = 0; d < Dim; ++d) {
    slices_.for_each(static_cast<std::size_t>(cell) * Dim + d,
                     static_cast<std::size_t>(problem_.mesh.num_cells()) * Dim,
                     [&](std::size_t begin, std::size_t width, std::size_t place) {
                       kernel_.decode(cell_dual_.data() + place, rows.data() + d * stride_ + begin,
                                      width);
                     });
  }
  const double scale = 1 / dual_scale(problem_, metric_, unit_, cell);
  Eigen::Matrix<double, Eigen::Dynamic, Dim> density(n_, Dim);
  for (int d = 0; d < Dim; ++d) {
    for (Index i = 0; i < n_; ++i) density(i, d) = scale * rows[d * stride_ + i];
  }
  shorten_to(problem_.phi, cell, density);
  return density;
}

template <class Scalar, class Stored, int Dim>
CellFieldView<Scalar, Dim> CompactSplitting<Scalar, Stored, Dim>::flux() {
  flux_ = AlignedArray<Scalar>(static_cast<std::size_t>(problem_.mesh.num_cells()) * Dim * stride_);
  std::vector<Scalar> scale(problem_.mesh.num_cells());
  for (std::size_t s = 0; s < scale.size(); ++s) {
    scale[s] = static_cast<Scalar>(std::sqrt(metric_.cell[static_cast<Index>(s)]) / unit_);
  }
  set_boundary_flux();
#pragma omp parallel
  for_slices(arrays(), [&](const State& slice, Columns columns) {
    kernel_.flux(slice, columns, scale.data(), flux_.data());
  });
  return {flux_.data(), stride_, n_};
}

template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::set_boundary_flux() {
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    if (!is_boundary_cell(problem_, s)) continue;
    const Eigen::Matrix<double, Eigen::Dynamic, Dim> flux =
        cell_geometry(problem_.mesh, s).measure * boundary_flux_density(problem_, s);
    for (int d = 0; d < Dim; ++d) {
      std::transform(flux.col(d).begin(), flux.col(d).end(),
                     flux_.data() + (static_cast<std::size_t>(s) * Dim + d) * stride_,
                     [](double number) { return static_cast<Scalar>(number); });
    }
  }
}

#define FLBC_INSTANTIATE(Scalar, Stored, Dim)                                                  \
  template WeightMatrix CompactSplitting<Scalar, Stored, Dim>::weights() const;                \
  template Eigen::VectorXd CompactSplitting<Scalar, Stored, Dim>::weights_at(Index) const;     \
  template Eigen::VectorXd CompactSplitting<Scalar, Stored, Dim>::vertex_dual_at(Index) const; \
  template Eigen::Matrix<double, Eigen::Dynamic, Dim>                                          \
      CompactSplitting<Scalar, Stored, Dim>::flux_density(Index) const;                        \
  template CellFieldView<Scalar, Dim> CompactSplitting<Scalar, Stored, Dim>::flux();
FLBC_INSTANTIATE(float, Half, 2)
FLBC_INSTANTIATE(float, Half, 3)
FLBC_INSTANTIATE(float, float, 2)
FLBC_INSTANTIATE(float, float, 3)
FLBC_INSTANTIATE(double, double, 2)
FLBC_INSTANTIATE(double, double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::compact
