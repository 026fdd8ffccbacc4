// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/active_splitting.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/flush_denormals.h"
#include "base/instantiate.h"
#include "base/padded_rows.h"
#include "base/parallel.h"
#include "problem/boundary_flux.h"
#include "solver/start/start.h"

namespace flbc::active_set {
namespace {

// The dense rows of a patch, for one thread.
template <class Scalar>
struct PatchRows {
  AlignedArray<Scalar> extrapolated, difference, residual, violation_sum;
  AlignedArray<double> violation, motion;
  std::vector<std::uint16_t> slot_of;

  PatchRows(std::size_t largest_block, std::size_t n, bool measures)
      : extrapolated(largest_block),
        difference(measures ? largest_block : 0),
        residual(largest_block),
        violation_sum(measures ? padded(n) : 0),
        violation(measures ? padded(n) : 0),
        motion(measures ? padded(n) : 0),
        slot_of(n + 1) {}
};

// The vertex of every row.
template <class Scalar, int Dim>
std::vector<Index> vertices_of_rows(const LbcProblem<Dim>& problem,
                                    const compact::CompactData<Scalar, Dim>& data) {
  auto vertices = data.vertices;
  const auto& boundary = problem.boundary.vertices;
  vertices.insert(vertices.end(), boundary.begin(), boundary.end());
  return vertices;
}

PackedLists lists_of(const ActiveLists& active, const std::vector<Index>& vertices,
                     ControlPoint n) {
  PackedLists lists;
  for (const Index v : vertices) lists.append(active.of(v), n);
  return lists;
}

}  // namespace

template <class Scalar, int Dim>
ActiveSplitting<Scalar, Dim>::ActiveSplitting(const LbcProblem<Dim>& problem,
                                              splitting::Metric metric, double penalty,
                                              double relaxation, bool half, ActiveLists active,
                                              const RowMatrix& system)
    : problem_(problem),
      loops_(half ? &select_kernel<compact::Kernel<Scalar, Dim>>().half
                  : &select_kernel<compact::Kernel<Scalar, Dim>>().exact),
      list_kernel_(select_kernel<Kernel<Scalar, Dim>>()),
      n_(problem.num_control_points()),
      metric_(std::move(metric)),
      unit_(compact::radius_unit(problem, metric_)),
      penalty_(penalty),
      relaxation_(relaxation),
      active_(std::move(active)),
      order_(sweep_order(system)),
      data_(compact::make_rows_and_cells<Scalar>(problem, metric_, order_.position, unit_)),
      lists_(lists_of(active_, vertices_of_rows(problem, data_), static_cast<ControlPoint>(n_))),
      bases_(row_bases<Scalar, Dim>(
          lists_, problem.cage.points,
          problem.mesh.points(Eigen::all, vertices_of_rows(problem, data_)), &targets_)),
      patches_(make_patches(problem, metric_, unit_, data_, lists_, *loops_)),
      multigrid_(system, order_, lists_, bases_, problem.cage.points, list_kernel_),
      rows_(lists_.size(), lists_.starts[data_.vertices.size()], metric_.vertex.size() > 0),
      left_(patches_.num_left),
      P_(Dim * patches_.radius.size()) {
}

template <class Scalar, int Dim>
compact::Arrays<Scalar, Dim> ActiveSplitting<Scalar, Dim>::patch_state(const Patch& patch) {
  State state{};
  state.stride = state.cell_stride = patch.stride;
  state.num_cells = static_cast<std::size_t>(patch.end_cell - patch.first_cell);
  state.num_interior = static_cast<std::size_t>(patch.num_interior);
  state.cell_dual = P_.data() + loops_->bytes * Dim * patch.first_number;
  state.cells = patches_.cells.data() + patch.first_cell;
  state.radius = patches_.radius.data() + loops_->bytes * patch.first_number;
  state.sigma = static_cast<Scalar>(sigma());
  state.smoothing = static_cast<Scalar>(compact::smoothing(problem_, penalty_));
  return state;
}

// Calls body(p, rows, state) for all patches, where `rows` has a of the rows of patch p.
template <class Scalar, int Dim>
template <class Body>
void ActiveSplitting<Scalar, Dim>::for_patches(bool measures, const Body& body) {
  const auto num_patches = static_cast<Index>(patches_.patches.size());
  const auto pass = [&](Index begin, Index end) {
    const FlushDenormals flush;
    PatchRows<Scalar> rows(patches_.largest_block, n_ + 1, measures);
    for (Index p = begin; p < end; ++p) {
      const Patch& patch = patches_.patches[p];
      for (std::size_t j = 0; j < patch.stride; ++j) {
        rows.slot_of[patches_.items[patch.first_item + j]] = static_cast<std::uint16_t>(j);
      }
      auto state = patch_state(patch);
      state.extrapolated = rows.extrapolated.data();
      state.residual = rows.residual.data();
      state.difference = rows.difference.data();
      state.violation = rows.violation.data();
      state.violation_sum = rows.violation_sum.data();
      gather(patch, rows.slot_of, rows_.a, patch.num_rows, rows.extrapolated);
      if (measures) {
        std::fill_n(rows.difference.data(), patch.num_rows * patch.stride, Scalar(0));
        gather(patch, rows.slot_of, rows_.difference, patch.num_interior, rows.difference);
        std::fill_n(rows.violation.data(), rows.violation.size(), 0.0);
        std::fill_n(rows.motion.data(), rows.motion.size(), 0.0);
      }
      body(p, rows, state);
    }
  };
  parallel_for(num_patches, pass, 2);
}

// Copies the first `count` rows of a patch into a block of dense rows.
template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::gather(const Patch& patch,
                                          const std::vector<std::uint16_t>& slot_of,
                                          const AlignedArray<Scalar>& numbers, Index count,
                                          AlignedArray<Scalar>& block) const {
  list_kernel_.gather(lists_.view(), patches_.rows.data() + patch.first_row, count, slot_of.data(),
                      numbers.data(), patch.stride, block.data());
}

// Z-steps of all cells; stores the divergence of each patch for collection.
// \return the squared violation of z = grad w, if measured
template <class Scalar, int Dim>
double ActiveSplitting<Scalar, Dim>::pass_cells(bool measures, double relaxation) {
  std::vector<double> violations(patches_.patches.size(), 0);
  const Lists lists = lists_.view();
  for_patches(measures, [&](Index p, PatchRows<Scalar>& rows, State& state) {
    const Patch& patch = patches_.patches[p];
    state.relaxation = static_cast<Scalar>(relaxation);
    std::fill_n(state.residual, patch.num_interior * patch.stride, Scalar(0));
    (measures ? loops_->z_step_measured : loops_->z_step)(state, {0, patch.stride});
    violations[p] = std::accumulate(rows.violation.data(),
                                    rows.violation.data() + (measures ? patch.stride : 0), 0.0);
    list_kernel_.scatter(lists, patches_.rows.data() + patch.first_row, patch.num_interior,
                         rows.slot_of.data(), state.residual, patch.stride,
                         patches_.leaves.data() + patch.first_row, left_.data());
  });
  return std::accumulate(violations.begin(), violations.end(), 0.0);
}

template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::collect_divergence() {
  const auto num_rows = static_cast<Index>(data_.vertices.size());
  parallel_for(num_rows, [&](Index row) {
    Scalar* residual = rows_.residual.data() + lists_.starts[row];
    const std::size_t length = lists_.starts[row + 1] - lists_.starts[row];
    for (const std::size_t place : patches_.left.of(row)) {
      for (std::size_t j = 0; j < length; ++j) residual[j] += left_[place + j];
    }
  });
}

template <class Scalar, int Dim>
compact::Arrays<Scalar, Dim> ActiveSplitting<Scalar, Dim>::row_state(Index row) {
  const std::size_t start = lists_.starts[row];
  State state{};
  state.stride = lists_.starts[row + 1] - start;
  rows_.set(state, start);
  state.vertex_metric = has_vertex_dual() ? data_.vertex_metric.data() + row : nullptr;
  state.basis = bases_.data() + (Dim + 1) * start;
  state.row_target = targets_.data() + static_cast<std::size_t>(row) * (Dim + 1);
  state.sigma = static_cast<Scalar>(sigma());
  state.relaxation = static_cast<Scalar>(relaxation_);
  return state;
}

template <class Scalar, int Dim>
compact::RowSums ActiveSplitting<Scalar, Dim>::pass_rows(RowLoop loop) {
  const auto num_rows = static_cast<Index>(data_.vertices.size());
  return parallel_sum(num_rows, compact::RowSums{}, [&](Index begin, Index end) {
    const FlushDenormals flush;
    compact::RowSums sums;
    for (Index row = begin; row < end; ++row) sums += loop(row_state(row), 0, 1);
    return sums;
  });
}

// As in CompactSplitting.
template <class Scalar, int Dim>
Step ActiveSplitting<Scalar, Dim>::iterate(bool measures, splitting::Due due) {
  if (measures) rows_.set_difference();
  const double of_cells = pass_cells(measures, relaxation_);
  collect_divergence();
  multigrid_.cycle(rows_.residual.data());
  const auto sums = rows_.with_dual(due != splitting::Due::kNothing, measures, [&] {
    return pass_rows(measures ? loops_->y_step_measured : loops_->y_step);
  });
  const double scale = 1 / (sigma() * sigma());
  return {scale * sums.change, measures ? scale * (of_cells + sums.violation) : -1};
}

template <class Scalar, int Dim>
splitting::BalanceLengths ActiveSplitting<Scalar, Dim>::lengths_since_start() {
  const auto moved = rows_.moved();
  std::vector<splitting::BalanceLengths> parts(patches_.patches.size());
  for_patches(true, [&](Index p, PatchRows<Scalar>& rows, const State& state) {
    const Patch& patch = patches_.patches[p];
    std::fill_n(rows.extrapolated.data(), patch.num_rows * patch.stride, Scalar(0));
    gather(patch, rows.slot_of, moved, patch.num_interior, rows.extrapolated);
    loops_->balance(state, {0, patch.stride}, rows.extrapolated.data(), rows.violation.data(),
                    rows.motion.data());
    const auto total = [&](const AlignedArray<double>& numbers) {
      return std::accumulate(numbers.data(), numbers.data() + patch.stride, 0.0);
    };
    parts[p] = {total(rows.violation), total(rows.motion)};
  });
  splitting::BalanceLengths lengths{data_.boundary_dual2, 0};
  for (const auto& part : parts) {
    lengths.dual2 += part.dual2;
    lengths.motion2 += part.motion2;
  }
  return lengths;
}

// As in CompactSplitting.
template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::set_penalty(double penalty) {
  const auto factor = static_cast<Scalar>(penalty / penalty_);
  penalty_ = penalty;
  rows_.scale_interior(factor);
  for (std::size_t k = rows_.W.size(); k < rows_.a.size(); ++k) rows_.a[k] *= factor;
  pass_rows(loops_->w_step);
}

// As in CompactSplitting.
template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::store_in_single() {
  const std::size_t size = Dim * patches_.num_numbers;
  AlignedArray<unsigned char> exact(size * sizeof(Scalar));
  loops_->decode(P_.data(), 0, reinterpret_cast<Scalar*>(exact.data()), size);
  P_ = std::move(exact);
  loops_ = &select_kernel<compact::Kernel<Scalar, Dim>>().exact;
  set_radii(problem_, metric_, unit_, *loops_, patches_);
}

template <class Scalar, int Dim>
Scalar ActiveSplitting<Scalar, Dim>::weight_at(std::size_t place) const {
  return static_cast<Scalar>(0.5 / sigma()) * (rows_.a[place] + rows_.W[place]);
}

// Writes the values of a vertex for all control points; zero for inactive pairs.
template <class Scalar, int Dim>
template <class NumberAt>
void ActiveSplitting<Scalar, Dim>::spread(Index vertex, const NumberAt& number_at,
                                          double* numbers) const {
  std::fill_n(numbers, n_, 0.0);
  const Index row = data_.row_of[vertex];
  const std::size_t start = lists_.starts[row];
  for (Index j = 0; j < lists_.counts[row]; ++j) {
    numbers[lists_.items[start + j]] = number_at(start + j);
  }
}

template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::read_weights(Index vertex, double* weights) const {
  spread(
      vertex, [this](std::size_t place) { return weight_at(place); }, weights);
}

template <class Scalar, int Dim>
double ActiveSplitting<Scalar, Dim>::state_scalars_per_cell() const {
  const std::size_t numbers = rows_.size() + left_.size() + bases_.size();
  const double cell_numbers = static_cast<double>(P_.size()) / sizeof(Scalar);
  return (static_cast<double>(numbers) + cell_numbers) / n_ / problem_.mesh.num_cells();
}

// a = sigma w on the lists, boundary rows included.
template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::set_weights(const VectorsAt<1>& weights) {
  const auto of_vertex = with_known_values(problem_, weights);
  parallel_for(problem_.mesh.num_vertices(), [&](Index v) {
    const Eigen::VectorXd numbers = of_vertex(v);
    const Index row = data_.row_of[v];
    const std::size_t start = lists_.starts[row];
    for (Index j = 0; j < lists_.counts[row]; ++j) {
      rows_.a[start + j] = static_cast<Scalar>(sigma() * numbers[lists_.items[start + j]]);
    }
  });
  // Truncated weights must be compensated elsewhere in the row.
  std::fill_n(rows_.residual.data(), rows_.residual.size(), Scalar(0));
  pass_rows(loops_->correct);
  std::copy_n(rows_.a.data(), rows_.W.size(), rows_.W.data());
}

template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::set_cell_dual(const VectorsAt<Dim>& flux_density) {
  store_in_cells<Dim>(patches_, *loops_, n_, P_, [&](Index s) {
    const double scale = compact::dual_scale(problem_, metric_, unit_, s);
    return [scale, density = flux_density(s)](Index i, int d) { return scale * density(i, d); };
  });
}

template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::set_vertex_dual(const VectorsAt<1>& vertex_dual) {
  const std::size_t num_rows = has_vertex_dual() ? data_.vertices.size() : 0;
  parallel_for(num_rows, [&](std::size_t row) {
    const std::size_t start = lists_.starts[row];
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(n_);
    if (vertex_dual) numbers = vertex_dual(data_.vertices[row]);
    for (Index j = 0; j < lists_.counts[row]; ++j) {
      rows_.S[start + j] = static_cast<Scalar>(sigma() * numbers[lists_.items[start + j]]);
      rows_.residual[start + j] = data_.vertex_metric[row] * rows_.S[start + j];
    }
  });
}

// As in CompactSplitting: subtracts the effect of the duals on the weights from W.
template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::start(const Start<Dim>& start, bool balances) {
  set_weights(start.weights);
  set_cell_dual(start.flux_density);
  set_vertex_dual(start.vertex_dual_at(penalty_));
  pass_cells(false, 0);
  collect_divergence();
  multigrid_.cycle(rows_.residual.data());
  pass_rows(loops_->correct);
  parallel_for(rows_.W.size(), [&](std::size_t k) { rows_.W[k] = 2 * rows_.W[k] - rows_.a[k]; });
  pass_rows(loops_->w_step);
  if (balances) rows_.keep_start();
}

// Boundary values are known to higher than single precision.
template <class Scalar, int Dim>
SparseWeights ActiveSplitting<Scalar, Dim>::sparse_weights() const {
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
    const auto list = active_.of(v);
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

template <class Scalar, int Dim>
Eigen::VectorXd ActiveSplitting<Scalar, Dim>::vertex_dual_at(Index vertex) const {
  Eigen::VectorXd dual(n_);
  spread(
      vertex, [this](std::size_t place) { return rows_.vertex_dual(place) / sigma(); },
      dual.data());
  return dual;
}

template <class Scalar, int Dim>
Vectors<Dim> ActiveSplitting<Scalar, Dim>::flux_density(Index cell) const {
  if (is_boundary_cell(problem_, cell)) return boundary_flux_density(problem_, cell);
  Vectors<Dim> density = Vectors<Dim>::Zero(n_, Dim);
  const Index k = patches_.place_of_cell[cell];
  const Patch& patch = patches_.patches[k / kPatchCells];
  AlignedArray<Scalar> rows(Dim * patch.stride);
  loops_->decode(P_.data(), Dim * patch.number_of(k), rows.data(), Dim * patch.stride);
  const double scale = 1 / compact::dual_scale(problem_, metric_, unit_, cell);
  for (std::size_t j = 0; j < patch.stride; ++j) {
    const Index i = patches_.items[patch.first_item + j];
    if (i >= n_) break;
    for (int d = 0; d < Dim; ++d) density(i, d) = scale * rows[d * patch.stride + j];
  }
  make_admissible(problem_, cell, density);
  return density;
}

FLBC_INSTANTIATE_SCALAR_CLASS(ActiveSplitting)

}  // namespace flbc::active_set
