// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/splitting/compact_splitting.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/flush_denormals.h"
#include "base/instantiate.h"
#include "base/padded_rows.h"
#include "base/parallel.h"
#include "flbc/harmonic.h"
#include "mesh/cell_geometry.h"
#include "problem/boundary_flux.h"
#include "solver/plan/constants.h"

namespace flbc::compact {

template <class Scalar, int Dim>
CompactSplitting<Scalar, Dim>::CompactSplitting(const LbcProblem<Dim>& problem,
                                                splitting::Metric metric,
                                                const Parameters& parameters,
                                                const Kernel<Scalar, Dim>& kernel)
    : Base(problem, std::move(metric), parameters, kernel),
      stride_(padded(static_cast<std::size_t>(n_))),
      slices_(stride_, omp_get_max_threads()),
      solver_(splitting::system_matrix(problem, metric_), stride_, parameters.linear_solver) {
  data_ = make_rows_and_cells<Scalar>(problem, metric_, solver_.position());
  rows_ = {static_cast<std::size_t>(problem.mesh.num_vertices()) * stride_,
           data_.vertices.size() * stride_, metric_.vertex.size() > 0};
  P_ = AlignedArray<Scalar>(data_.cells.size() * Dim * stride_);
  set_constraints(problem, stride_, data_);
  set_radii();
}

template <class Scalar, int Dim>
auto CompactSplitting<Scalar, Dim>::arrays() -> State {
  State arrays{};
  arrays.stride = stride_;
  arrays.num_cells = data_.cells.size();
  arrays.num_interior = data_.vertices.size();
  rows_.set(arrays);
  arrays.cell_dual = P_.data();
  arrays.cells = data_.cells.data();
  arrays.cell_index = data_.cell_index.data();
  arrays.radius = data_.radius.data();
  arrays.vertex_metric = data_.vertex_metric.data();
  arrays.basis = data_.basis.data();
  arrays.row_target = data_.row_target.data();
  arrays.difference = rows_.difference.data();
  arrays.sigma = static_cast<Scalar>(sigma());
  arrays.relaxation = static_cast<Scalar>(parameters_.relaxation);
  arrays.smoothing = static_cast<Scalar>(smoothing(problem_, this->penalty()));
  return arrays;
}

// Calls `body` for each slice of control points, in parallel.
template <class Scalar, int Dim>
template <class Body>
void CompactSplitting<Scalar, Dim>::for_slices(const State& state, const Body& body) const {
  const auto of_slice = [&](std::size_t k) {
    const FlushDenormals flush;
    const Slice slice = slices_[k];
    State part = state;
    part.cell_stride = slices_.stride_of(slice);
    part.cell_dual = state.cell_dual + slices_.offset_of(slice, state.num_cells * Dim);
    part.radius = state.radius + slices_.offset_of(slice, state.num_cells);
    body(part, Columns{slice.begin, slice.end});
  };
  parallel_for(slices_.size(), of_slice, 2);
}

// Each thread takes its slice of control points through the cells and the linear system.
template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::solve(SliceLoop loop, double relaxation) {
  auto state = arrays();
  state.relaxation = static_cast<Scalar>(relaxation);
  for_slices(state, [&](const State& slice, Columns columns) {
    loop(slice, columns);
    solver_.solve_slice(rows_.residual.data(), stride_, columns.begin, columns.end);
  });
}

template <class Scalar, int Dim>
double CompactSplitting<Scalar, Dim>::pass_rows(RowLoop loop) {
  constexpr Index kRowBlock = 256;
  const auto state = arrays();
  const auto num_rows = static_cast<Index>(data_.vertices.size());
  std::vector<double> changes((num_rows + kRowBlock - 1) / kRowBlock);
  const auto of_block = [&](std::size_t block) {
    const FlushDenormals flush;
    const Index begin = static_cast<Index>(block) * kRowBlock;
    changes[block] = loop(state, begin, std::min(num_rows, begin + kRowBlock));
  };
  parallel_for(changes.size(), of_block, 2);
  return std::accumulate(changes.begin(), changes.end(), 0.0);
}

template <class Scalar, int Dim>
splitting::CellResiduals CompactSplitting<Scalar, Dim>::cell_residuals(
    const AlignedArray<Scalar>& moved) {
  AlignedArray<double> motion(stride_), violation(stride_);
  for_slices(arrays(), [&](const State& slice, Columns columns) {
    kernel_.residuals(slice, columns, moved.data(), motion.data(), violation.data());
  });
  return {std::accumulate(motion.data(), motion.data() + n_, 0.0),
          std::accumulate(violation.data(), violation.data() + n_, 0.0)};
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::set_radii() {
  data_.radius = AlignedArray<Scalar>(data_.cells.size() * stride_);
  store_in_cells<1>(data_, slices_, data_.radius, [&](Index s) -> Eigen::VectorXd {
    return dual_scale(problem_, metric_, unit_, s) * problem_.phi.col(s).cwiseMax(kSmallestPhi);
  });
}

// ---- starts -------------------------------------------------------------------------------------

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::start(const Start<Dim>& start) {
  if (!start.is_cold()) {
    Base::start(start);
  } else if (parameters_.harmonic_cold) {
    start_from_weights(harmonic_coordinates(problem_));
  } else {
    start_from_harmonic(plan::kHarmonicSteps);
  }
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::start_from_weights(const WeightMatrix& weights) {
  this->set_weights([&](Index v) -> Eigen::VectorXd { return weights.col(v); });
  begin_from_weights();
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::start_from_harmonic(int steps) {
  this->set_weights([&](Index) -> Eigen::VectorXd { return Eigen::VectorXd::Zero(n_); });
  std::fill_n(rows_.residual.data(), rows_.residual.size(), Scalar(0));
  for (int step = 0; step < steps; ++step) {
    solve(kernel_.harmonic_residual, parameters_.relaxation);
    pass_rows(kernel_.correct);
  }
  begin_from_weights();
}

// From w in the rows of a: W = w, S = 0, P = grad w.
template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::begin_from_weights() {
  std::copy_n(rows_.a.data(), rows_.W.size(), rows_.W.data());
  std::fill_n(rows_.S.data(), rows_.S.size(), Scalar(0));
  for_slices(arrays(), kernel_.start_cell_dual);
  pass_rows(kernel_.w_step);
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::set_cell_dual(const VectorsAt<Dim>& flux_density) {
  store_in_cells<Dim>(data_, slices_, P_, [&](Index s) -> Vectors<Dim> {
    return dual_scale(problem_, metric_, unit_, s) * flux_density(s);
  });
}

// ---- results ------------------------------------------------------------------------------------

template <class Scalar, int Dim>
WeightMatrix CompactSplitting<Scalar, Dim>::all_weights() const {
  WeightMatrix weights(n_, problem_.mesh.num_vertices());
  parallel_for(data_.vertices.size(), [&](std::size_t row) {
    this->read_weights(data_.vertices[row], weights.col(data_.vertices[row]).data());
  });
  // Boundary values are known to higher than single precision.
  problem_.boundary.impose_on(weights);
  return weights;
}

template <class Scalar, int Dim>
Vectors<Dim> CompactSplitting<Scalar, Dim>::cell_dual(Index cell) const {
  const auto& cells = data_.cell_index;
  const auto k =
      static_cast<std::size_t>(std::lower_bound(cells.begin(), cells.end(), cell) - cells.begin());
  Vectors<Dim> dual(n_, Dim);
  for (int d = 0; d < Dim; ++d) {
    slices_.for_each(k * Dim + d, cells.size() * Dim,
                     [&](std::size_t begin, std::size_t width, std::size_t place) {
                       const auto end = std::min<std::size_t>(n_, begin + width);
                       for (auto i = begin; i < end; ++i) dual(i, d) = P_[place + i - begin];
                     });
  }
  return dual;
}

template <class Scalar, int Dim>
AlignedArray<Scalar> CompactSplitting<Scalar, Dim>::flux() const {
  const auto num_cells = static_cast<std::size_t>(problem_.mesh.num_cells());
  AlignedArray<Scalar> flux(num_cells * Dim * stride_);
  std::vector<Scalar> scale(num_cells);
  for (std::size_t s = 0; s < num_cells; ++s) {
    const auto cell = static_cast<Index>(s);
    scale[s] = static_cast<Scalar>(std::sqrt(metric_.cell[cell]) / unit_);
    if (!is_boundary_cell(problem_, cell)) continue;
    const Vectors<Dim> given =
        cell_geometry(problem_.mesh, cell).measure * boundary_flux_density(problem_, cell);
    for (int d = 0; d < Dim; ++d) {
      for (Index i = 0; i < n_; ++i) {
        flux[(s * Dim + d) * stride_ + i] = static_cast<Scalar>(given(i, d));
      }
    }
  }
  const State state = const_cast<CompactSplitting*>(this)->arrays();  // the loop only reads it
  for_slices(state, [&](const State& slice, Columns columns) {
    kernel_.flux(slice, columns, scale.data(), flux.data());
  });
  return flux;
}

template <class Scalar, int Dim>
Certificate CompactSplitting<Scalar, Dim>::certify(const WeightMatrix& weights,
                                                   Proof* proof) const {
  const auto p = flux();
  return flbc::certify(problem_, CellFieldView<Scalar, Dim>{p.data(), stride_, n_}, weights, proof);
}

template <class Scalar, int Dim>
void CompactSplitting<Scalar, Dim>::describe(SolveReport& report) const {
  const auto numbers = static_cast<double>(rows_.size() + P_.size());
  report.state_scalars_per_cell =
      numbers / static_cast<double>(stride_) / problem_.mesh.num_cells();
  report.penalty = this->penalty();
}

FLBC_INSTANTIATE_SCALAR_CLASS(CompactSplitting)

}  // namespace flbc::compact
