// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/gradient/gradient_admm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/flush_denormals.h"
#include "base/instantiate.h"
#include "base/parallel.h"
#include "mesh/cell_geometry.h"

namespace flbc::gradient {
namespace {

// Calls `body(begin, end)` for blocks of [0, count) in parallel. Every step flushes denormal
// numbers, because they are slow, and because all steps must agree for bit-identical results.
template <class Body>
void parallel_blocks(Index count, const Body& body) {
  parallel_for(count, [&](Index begin, Index end) {
    const FlushDenormals scope;
    body(begin, end);
  });
}

}  // namespace

template <class Scalar, int Dim>
GradientAdmm<Scalar, Dim>::GradientAdmm(const LbcProblem<Dim>& problem, double penalty,
                                        double relaxation, const std::vector<Period<Dim>>& periods)
    : problem_(problem),
      kernel_(select_kernel<Kernel<Scalar, Dim>>()),
      n_(problem.num_control_points()),
      stride_(padded(static_cast<std::size_t>(n_))),
      penalty_(penalty),
      relaxation_(relaxation),
      num_periods_(periods.size()),
      M_(Dim + 2 + static_cast<double>(periods.size())) {
  const auto cells = static_cast<std::size_t>(problem.mesh.num_cells());
  const auto facets = static_cast<std::size_t>(problem.topology.num_facets());
  gradient_ = AlignedArray<Scalar>(cells * Dim * stride_);
  extrapolated_ = AlignedArray<Scalar>(cells * Dim * stride_);
  tv_dual_ = AlignedArray<Scalar>(cells * Dim * stride_);
  facet_dual_ = AlignedArray<Scalar>(facets * (Dim - 1) * stride_);
  data_ = make_constraint_data<Scalar>(problem, penalty, stride_);
  period_dual_ = AlignedArray<Scalar>(periods.size() * stride_);
  period_values_ = AlignedArray<double>(periods.size() * stride_);
  for (std::size_t p = 0; p < periods.size(); ++p) {
    for (const double number : periods[p].field.reshaped()) {
      period_fields_.push_back(static_cast<Scalar>(number));
    }
    std::copy_n(periods[p].values.data(), n_, period_values_.data() + p * stride_);
  }
  cell_pass_ = make_cell_pass(problem.mesh, problem.topology, omp_get_max_threads());
  for (const auto& part : cell_pass_.parts) {
    slots_.emplace_back(static_cast<std::size_t>(part.num_slots) * Dim * stride_);
  }
  cell_change_.resize(cells);
  facet_change_.resize(facets);
}

// The dual step of the period constraints. The field has norm 1, so the dual grows by the
// violation.
template <class Scalar, int Dim>
double GradientAdmm<Scalar, Dim>::update_periods() {
  double change = 0;
  const Index num_cells = problem_.mesh.num_cells();
  for (std::size_t p = 0; p < num_periods_; ++p) {
    const Scalar* fields = period_fields_.data() + p * num_cells * Dim;
    const Eigen::ArrayXd zero = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(stride_));
    const Eigen::ArrayXd sums = parallel_sum(num_cells, zero, [&](Index begin, Index end) {
      Eigen::ArrayXd sum = zero;
      for (Index row = begin * Dim; row < end * Dim; ++row) {
        const Scalar* gradients = extrapolated_.data() + row * stride_;
        for (std::size_t i = 0; i < stride_; ++i) {
          sum[i] += static_cast<double>(fields[row]) * static_cast<double>(gradients[i]);
        }
      }
      return sum;
    });
    for (std::size_t i = 0; i < stride_; ++i) {
      const double step = period_values_[p * stride_ + i] - sums[i];
      period_dual_[p * stride_ + i] += static_cast<Scalar>(relaxation_ * step);
      change += step * step;
    }
  }
  return change;
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_least_norm() {
  parallel_for(problem_.mesh.num_cells(), [&](Index s) {
    for (int d = 0; d < Dim; ++d) {
      const std::size_t row = (static_cast<std::size_t>(s) * Dim + d) * stride_;
      for (std::size_t i = 0; i < stride_; ++i) {
        Scalar value = 0;
        for (int k = 0; k <= Dim; ++k)
          value += data_.target[d * (Dim + 1) + k] * data_.basis[k * stride_ + i];
        gradient_[row + i] = extrapolated_[row + i] = value;
      }
    }
  });
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_weights(const WeightMatrix& weights) {
  parallel_for(problem_.mesh.num_cells(), [&](Index s) {
    const auto gradient =
        weight_gradients(problem_.mesh, s, cell_geometry(problem_.mesh, s), weights);
    for (int d = 0; d < Dim; ++d) {
      const std::size_t row = (static_cast<std::size_t>(s) * Dim + d) * stride_;
      for (Index i = 0; i < n_; ++i) {
        gradient_[row + i] = extrapolated_[row + i] = static_cast<Scalar>(gradient(i, d));
      }
    }
  });
}

// A pass takes the G-step of one iteration and the duals of the next one together. With periods, a
// sum over all cells is needed in between.
template <class Scalar, int Dim>
Change GradientAdmm<Scalar, Dim>::iterate(int count) {
  const auto arrays = make_arrays();
  if (num_periods_ > 0) {
    Change change;
    for (int k = 0; k < count; ++k) {
      xyz_steps(arrays);
      const double period_change = update_periods();
      change = g_step(arrays);
      change.dual = noted_change() + period_change;
    }
    return change;
  }
  xyz_steps(arrays);
  for (int k = 1; k < count; ++k) pass(arrays, k == count - 1);
  Change change = g_step(arrays);
  change.dual = noted_change();
  return change;
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::xyz_steps(const Arrays<Scalar, Dim>& arrays) {
  parallel_blocks(problem_.topology.num_facets(),
                  [&](Index begin, Index end) { kernel_.xy_step(arrays, begin, end); });
  parallel_blocks(problem_.mesh.num_cells(),
                  [&](Index begin, Index end) { kernel_.z_step(arrays, begin, end); });
}

template <class Scalar, int Dim>
Change GradientAdmm<Scalar, Dim>::g_step(const Arrays<Scalar, Dim>& arrays) {
  return parallel_sum(problem_.mesh.num_cells(), Change{}, [&](Index begin, Index end) {
    const FlushDenormals scope;
    return kernel_.g_step(arrays, begin, end);
  });
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::pass(const Arrays<Scalar, Dim>& arrays, bool note) {
  const auto num_parts = static_cast<Index>(cell_pass_.parts.size());
  parallel_for(
      num_parts,
      [&](Index p) {
        const FlushDenormals scope;
        (note ? kernel_.pass_and_note : kernel_.pass)(arrays, cell_pass_.parts[p].path(),
                                                      slots_[p].data());
      },
      2);
  parallel_blocks(static_cast<Index>(cell_pass_.seams.size()), [&](Index begin, Index end) {
    kernel_.listed_xy_step(arrays, cell_pass_.seams.data() + begin, end - begin, note);
  });
}

template <class Scalar, int Dim>
double GradientAdmm<Scalar, Dim>::noted_change() const {
  const auto sum_of = [](const std::vector<double>& changes) {
    return parallel_sum(static_cast<Index>(changes.size()), 0.0, [&](Index begin, Index end) {
      return std::accumulate(changes.begin() + begin, changes.begin() + end, 0.0);
    });
  };
  return sum_of(facet_change_) + sum_of(cell_change_);
}

template <class Scalar, int Dim>
Residuals GradientAdmm<Scalar, Dim>::residuals(const Change& change) const {
  // The duals of the paper, updated with the new G, differ from these duals by G_before - G. That
  // difference is orthogonal to the result of the G-step
  // (docs/explanation/method/gradient_admm.md), so Pythagoras applies.
  const double primal = relaxation_ == 1 ? change.dual - M_ * change.lead : change.dual;
  return {std::sqrt(std::max(primal, 0.0)), penalty_ * std::sqrt(M_ * change.gradient)};
}

template <class Scalar, int Dim>
double GradientAdmm<Scalar, Dim>::num_residual_components() const {
  return static_cast<double>(n_) * Dim * M_ * problem_.mesh.num_cells();
}

template <class Scalar, int Dim>
CellFieldView<Scalar, Dim> GradientAdmm<Scalar, Dim>::flux() const {
  using Rows = Eigen::Map<Eigen::Array<Scalar, Dim, Eigen::Dynamic, Eigen::RowMajor>>;
  using ConstRows = Eigen::Map<const Eigen::Array<Scalar, Dim, Eigen::Dynamic, Eigen::RowMajor>>;
  using ConstRow = Eigen::Map<const Eigen::Array<Scalar, 1, Eigen::Dynamic>>;
  const auto columns = static_cast<Eigen::Index>(stride_);
  flux_ = AlignedArray<Scalar>(tv_dual_.size());
  parallel_for(problem_.mesh.num_cells(), [&](Index s) {
    const std::size_t block = static_cast<std::size_t>(s) * Dim * stride_;
    Rows flux(flux_.data() + block, Dim, columns);
    flux = ConstRows(extrapolated_.data() + block, Dim, columns) -
           ConstRows(tv_dual_.data() + block, Dim, columns);
    const auto length =
        flux.square().colwise().sum().sqrt().max(std::numeric_limits<Scalar>::min());
    const ConstRow radius(data_.radius.data() + s * stride_, columns);
    const Scalar theta = data_.smoothing[s];
    const Eigen::Array<Scalar, 1, Eigen::Dynamic> shrink =
        static_cast<Scalar>(penalty_) *
        (theta + (Scalar(1) - theta) * (radius / length).min(Scalar(1)));
    flux.rowwise() *= shrink;
  });
  return {flux_.data(), stride_, n_};
}

template <class Scalar, int Dim>
double GradientAdmm<Scalar, Dim>::state_scalars_per_cell() const {
  const std::size_t numbers =
      gradient_.size() + extrapolated_.size() + tv_dual_.size() + facet_dual_.size();
  return static_cast<double>(numbers) / static_cast<double>(stride_) / problem_.mesh.num_cells();
}

template <class Scalar, int Dim>
Arrays<Scalar, Dim> GradientAdmm<Scalar, Dim>::make_arrays() {
  Arrays<Scalar, Dim> arrays;
  arrays.stride = stride_;
  arrays.gradient = gradient_.data();
  arrays.extrapolated = extrapolated_.data();
  arrays.tv_dual = tv_dual_.data();
  arrays.period_dual = period_dual_.data();
  arrays.facet_dual = facet_dual_.data();
  arrays.cell_change = cell_change_.data();
  arrays.facet_change = facet_change_.data();
  arrays.radius = data_.radius.data();
  arrays.smoothing = data_.smoothing.data();
  arrays.boundary_slope = data_.boundary_slope.data();
  arrays.tangents = data_.tangents.data();
  arrays.sides = problem_.topology.sides.data();
  arrays.boundary_index = data_.boundary_index.data();
  arrays.cell_facets = problem_.topology.cell_facets.data();
  arrays.period_fields = period_fields_.data();
  arrays.num_periods = num_periods_;
  arrays.num_cells = static_cast<std::size_t>(problem_.mesh.num_cells());
  arrays.inverse_M = static_cast<Scalar>(1 / M_);
  arrays.basis = data_.basis.data();
  arrays.target = data_.target.data();
  arrays.relaxation = static_cast<Scalar>(relaxation_);
  return arrays;
}

FLBC_INSTANTIATE_SCALAR_CLASS(GradientAdmm)

}  // namespace flbc::gradient
