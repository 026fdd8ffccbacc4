// SPDX-License-Identifier: BSD-3-Clause
#include "solver/splitting/compact_splitting.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/flush_denormals.h"
#include "mesh/cell_geometry.h"
#include "solver/state_storage.h"

namespace flbc::compact {
namespace {

constexpr Index kRowBlock = 256;

}  // namespace

template <class Scalar, class Stored, int Dim>
CompactSplitting<Scalar, Stored, Dim>::CompactSplitting(
    const LbcProblem<Dim>& problem, splitting::Metric metric, double penalty, double relaxation,
    LinearSolver linear_solver, StateStorage* storage, const Kernel<Scalar, Stored, Dim>& kernel)
    : problem_(problem),
      kernel_(kernel),
      n_(problem.num_control_points()),
      stride_(padded(static_cast<std::size_t>(n_))),
      slices_(stride_, omp_get_max_threads(), storage != nullptr),
      metric_(std::move(metric)),
      unit_(radius_unit(problem, metric_)),
      penalty_(penalty),
      relaxation_(relaxation),
      solver_(splitting::system_matrix(problem, metric_), stride_, linear_solver),
      data_(make_compact_data(problem, metric_, solver_.position(), unit_, slices_, kernel_)) {
  const auto cells = static_cast<std::size_t>(problem.mesh.num_cells());
  const auto vertices = static_cast<std::size_t>(problem.mesh.num_vertices());
  relaxed_ = state_array<Scalar>(storage, StateArray::kRelaxedIterate, vertices, 1, stride_);
  cell_dual_ = state_array<Stored>(storage, StateArray::kSplittingState, cells, Dim, stride_);
  if (metric_.vertex.size() > 0) {
    vertex_dual_ =
        state_array<Scalar>(storage, StateArray::kNonNegativityDual, vertices, 1, stride_);
  }
  if (storage != nullptr) {
    stored_extrapolated_ = state_array<Scalar>(storage, StateArray::kIterate, vertices, 1, stride_);
  }
  extrapolated_ = AlignedArray<Scalar>(vertices * stride_);
  residual_ = AlignedArray<Scalar>(data_.vertices.size() * stride_);
}

template <class Scalar, class Stored, int Dim>
Arrays<Scalar, Stored, Dim> CompactSplitting<Scalar, Stored, Dim>::arrays() {
  State arrays;
  arrays.stride = stride_;
  arrays.cell_stride = stride_;
  arrays.num_cells = data_.cells.size();
  arrays.mesh_cells = static_cast<std::size_t>(problem_.mesh.num_cells());
  arrays.num_interior = data_.vertices.size();
  arrays.extrapolated = extrapolated_.data();
  arrays.relaxed = relaxed_.data();
  arrays.vertex_dual = vertex_dual_.data();
  arrays.cell_dual = cell_dual_.data();
  arrays.residual = residual_.data();
  arrays.violation = violation_.data();
  arrays.violation_sum = violation_sum_.data();
  arrays.cells = data_.cells.data();
  arrays.cell_index = data_.cell_index.data();
  arrays.vertices = data_.vertices.data();
  arrays.radius = data_.radius.data();
  arrays.vertex_metric = data_.vertex_metric.data();
  arrays.basis = data_.constraints.basis.data();
  arrays.row_target = data_.constraints.target.data();
  arrays.difference = difference_.data();
  arrays.sigma = static_cast<Scalar>(sigma());
  arrays.relaxation = static_cast<Scalar>(relaxation_);
  return arrays;
}

template <class Scalar, class Stored, int Dim>
Arrays<Scalar, Stored, Dim> CompactSplitting<Scalar, Stored, Dim>::in_slice(State state,
                                                                            Slice slice) const {
  state.cell_stride = slices_.stride_of(slice);
  state.cell_dual += slices_.offset_of(slice, state.mesh_cells * Dim);
  state.radius += slices_.offset_of(slice, state.num_cells);
  return state;
}

// Calls `body` for each slice of control points; to be called by all threads of a team.
template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::for_slices(
    const State& state, const std::function<void(const State&, Columns)>& body) {
  const FlushDenormals flush;
#pragma omp for schedule(static, 1)
  for (std::size_t k = 0; k < slices_.size(); ++k) {
    body(in_slice(state, slices_[k]), Columns{slices_[k].begin, slices_[k].end});
  }
}

// One pass: each thread takes its slice of control points through the cells and the linear system,
// then its share of the rows. Without a loop over cells there is no solve either.
template <class Scalar, class Stored, int Dim>
RowSums CompactSplitting<Scalar, Stored, Dim>::run(const State& state, SliceLoop cells,
                                                   RowLoop rows) {
  const auto num_rows = static_cast<Index>(data_.vertices.size());
  std::vector<RowSums> parts((num_rows + kRowBlock - 1) / kRowBlock);
#pragma omp parallel
  {
    const FlushDenormals flush;
    if (cells != nullptr) {
      for_slices(state, [&](const State& slice, Columns columns) {
        cells(slice, columns);
        solver_.solve_slice(residual_.data(), stride_, columns.begin, columns.end);
      });
    }
#pragma omp for schedule(static)
    for (std::size_t block = 0; block < parts.size(); ++block) {
      const Index begin = static_cast<Index>(block) * kRowBlock;
      parts[block] = rows(state, begin, std::min(num_rows, begin + kRowBlock));
    }
  }
  RowSums sums;
  for (const RowSums& part : parts) {
    sums.change += part.change;
    sums.violation += part.violation;
  }
  return sums;
}

template <class Scalar, class Stored, int Dim>
Step CompactSplitting<Scalar, Stored, Dim>::iterate() {
  return {run(arrays(), kernel_.z_step, kernel_.y_step).change / (sigma() * sigma())};
}

template <class Scalar, class Stored, int Dim>
Step CompactSplitting<Scalar, Stored, Dim>::iterate_measured() {
  set_difference();
  violation_ = AlignedArray<double>(stride_);
  violation_sum_ = AlignedArray<Scalar>(stride_);
  const RowSums sums = run(arrays(), kernel_.z_step_measured, kernel_.y_step_measured);
  const double of_cells = std::accumulate(violation_.data(), violation_.data() + n_, 0.0);
  const double scale = 1 / (sigma() * sigma());
  return {scale * sums.change, scale * (of_cells + sums.violation)};
}

// The W-step that y_step does in advance has to wait for the new penalty.
template <class Scalar, class Stored, int Dim>
Step CompactSplitting<Scalar, Stored, Dim>::iterate_and_adapt(double ratio, double largest) {
  auto state = arrays();
  state.vertex_dual = nullptr;
  const Step step{run(state, kernel_.z_step, kernel_.y_step).change / (sigma() * sigma())};
  adapt_penalty(ratio, largest);
  run(arrays(), nullptr, kernel_.w_step);
  return step;
}

// w - W, which is (a - W) / 2.
template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::set_difference() {
  if (difference_.size() == 0) difference_ = AlignedArray<Scalar>(extrapolated_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t row = 0; row < data_.vertices.size(); ++row) {
    const Scalar* relaxed = relaxed_.data() + data_.vertices[row] * stride_;
    for (std::size_t i = 0; i < stride_; ++i) {
      const std::size_t place = row * stride_ + i;
      difference_[place] = Scalar(0.5) * (extrapolated_[place] - relaxed[i]);
    }
  }
}

// In the units of the arrays the duals do not change, and w changes with sigma: w / f. The step
// w - W belongs to the duals.
template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::adapt_penalty(double ratio, double largest) {
  if (start_.size() == 0) return;
  set_difference();
  const std::size_t size = data_.vertices.size() * stride_;
  AlignedArray<Scalar> moved(extrapolated_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < size; ++k) moved[k] = extrapolated_[k] - difference_[k] - start_[k];
  AlignedArray<double> dual(stride_);
  AlignedArray<double> motion(stride_);
#pragma omp parallel
  for_slices(arrays(), [&](const State& slice, Columns columns) {
    kernel_.balance(slice, columns, moved.data(), dual.data(), motion.data());
  });
  const double dual2 = std::accumulate(dual.data(), dual.data() + n_, 0.0) + data_.boundary_dual2;
  const double motion2 = std::accumulate(motion.data(), motion.data() + n_, 0.0);
  if (!(dual2 > 0) || !(motion2 > 0)) return;
  const double factor = std::max(1 / (ratio * std::sqrt(dual2 / motion2)), penalty_ / largest);
  penalty_ /= factor;
  const auto shrink = static_cast<Scalar>(1 / factor);
#pragma omp parallel for schedule(static)
  for (std::size_t row = 0; row < data_.vertices.size(); ++row) {
    Scalar* relaxed = relaxed_.data() + data_.vertices[row] * stride_;
    for (std::size_t i = 0; i < stride_; ++i) {
      const std::size_t place = row * stride_ + i;
      const Scalar w = shrink * (extrapolated_[place] - difference_[place]);
      relaxed[i] = w - difference_[place];
      extrapolated_[place] = w + difference_[place];
      start_[place] *= shrink;
    }
  }
  set_boundary_rows();
}

template <class Scalar, class Stored, int Dim>
void CompactSplitting<Scalar, Stored, Dim>::read_vertex(Index vertex, Scalar* weights) const {
  const auto half = static_cast<Scalar>(0.5 / sigma());
  const Scalar* extrapolated =
      extrapolated_.data() + static_cast<std::size_t>(data_.row_of[vertex]) * stride_;
  const Scalar* relaxed = relaxed_.data() + static_cast<std::size_t>(vertex) * stride_;
  for (std::size_t i = 0; i < stride_; ++i) weights[i] = half * (extrapolated[i] + relaxed[i]);
}

template <class Scalar, class Stored, int Dim>
double CompactSplitting<Scalar, Stored, Dim>::state_scalars_per_cell() const {
  const std::size_t vertex_numbers =
      extrapolated_.size() + relaxed_.size() + vertex_dual_.size() + residual_.size();
  const double cell_numbers =
      static_cast<double>(cell_dual_.size()) * sizeof(Stored) / sizeof(Scalar);
  return (static_cast<double>(vertex_numbers) + cell_numbers) / static_cast<double>(stride_) /
         problem_.mesh.num_cells();
}

template class CompactSplitting<float, Half, 2>;
template class CompactSplitting<float, Half, 3>;
template class CompactSplitting<float, float, 2>;
template class CompactSplitting<float, float, 3>;
template class CompactSplitting<double, double, 2>;
template class CompactSplitting<double, double, 3>;

}  // namespace flbc::compact
