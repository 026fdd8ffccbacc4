// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/active_splitting.h"

#include <algorithm>
#include <utility>

#include "base/flush_denormals.h"
#include "base/instantiate.h"
#include "base/parallel.h"
#include "mesh/cell_geometry.h"
#include "solver/plan/constants.h"

namespace flbc::active_set {
namespace {

// The dense rows of a patch, for one thread.
template <class Scalar>
struct PatchRows {
  AlignedArray<Scalar> extrapolated, residual;
  std::vector<std::uint16_t> slot_of;
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

// Whether masks exclude all pairs that are not active.
template <int Dim>
bool has_all_allowed(const LbcProblem<Dim>& problem, const ActiveLists& active) {
  if (problem.masks.empty()) return false;
  std::size_t missing = 0, masked = 0;
  for (const Index v : problem.boundary.interior_vertices()) {
    missing += problem.num_control_points() - (active.start[v + 1] - active.start[v]);
    masked += problem.masks.forbidden(v).size();
  }
  return missing == masked;
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
                                              splitting::Metric metric,
                                              const Parameters& parameters, ActiveLists active)
    : Base(problem, std::move(metric), parameters, select_kernel<compact::Kernel<Scalar, Dim>>()),
      list_kernel_(select_kernel<Kernel<Scalar, Dim>>()),
      active_(std::move(active)) {
  const auto system = splitting::system_matrix(problem, metric_);
  const auto order = sweep_order(system);
  data_ = compact::make_rows_and_cells<Scalar>(problem, metric_, order.position);
  const auto vertices = vertices_of_rows(problem, data_);
  lists_ =
      std::make_unique<PackedLists>(lists_of(active_, vertices, static_cast<ControlPoint>(n_)));
  bases_ = std::make_unique<AlignedArray<Scalar>>(row_bases<Scalar, Dim>(
      *lists_, problem.cage.points, problem.mesh.points(Eigen::all, vertices), &targets_));
  patches_ = make_patches(problem, metric_, unit_, data_, *lists_);
  multigrid_ = std::make_unique<ActiveMultigrid<Scalar, Dim>>(system, order, *lists_, *bases_,
                                                              problem.cage.points, list_kernel_);
  rows_ = {lists_->size(), lists_->starts[data_.vertices.size()], metric_.vertex.size() > 0};
  left_ = AlignedArray<Scalar>(patches_.num_left);
  P_ = AlignedArray<Scalar>(Dim * patches_.radius.size());
  complete_ = has_all_allowed(problem, active_);
}

template <class Scalar, int Dim>
auto ActiveSplitting<Scalar, Dim>::patch_state(const Patch& patch) -> State {
  State state{};
  state.stride = state.cell_stride = patch.stride;
  state.num_cells = static_cast<std::size_t>(patch.end_cell - patch.first_cell);
  state.num_interior = static_cast<std::size_t>(patch.num_interior);
  state.cell_dual = P_.data() + Dim * patch.first_number;
  state.cells = patches_.cells.data() + patch.first_cell;
  state.radius = patches_.radius.data() + patch.first_number;
  state.sigma = static_cast<Scalar>(sigma());
  state.smoothing = static_cast<Scalar>(compact::smoothing(problem_, this->penalty()));
  return state;
}

// Calls body(p, rows, state) for all patches, where `rows` has a of the rows of patch p.
template <class Scalar, int Dim>
template <class Body>
void ActiveSplitting<Scalar, Dim>::for_patches(const Body& body) {
  const auto num_patches = static_cast<Index>(patches_.patches.size());
  const auto pass = [&](Index begin, Index end) {
    const FlushDenormals flush;
    PatchRows<Scalar> rows{AlignedArray<Scalar>(patches_.largest_block),
                           AlignedArray<Scalar>(patches_.largest_block),
                           std::vector<std::uint16_t>(n_ + 1)};
    for (Index p = begin; p < end; ++p) {
      const Patch& patch = patches_.patches[p];
      for (std::size_t j = 0; j < patch.stride; ++j) {
        rows.slot_of[patches_.items[patch.first_item + j]] = static_cast<std::uint16_t>(j);
      }
      auto state = patch_state(patch);
      state.extrapolated = rows.extrapolated.data();
      state.residual = rows.residual.data();
      gather(patch, rows.slot_of, rows_.a, patch.num_rows, rows.extrapolated);
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
  list_kernel_.gather(lists_->view(), patches_.rows.data() + patch.first_row, count, slot_of.data(),
                      numbers.data(), patch.stride, block.data());
}

// Z-steps of all cells leave the divergence of each patch, which the rows collect.
template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::solve(SliceLoop loop, double relaxation) {
  for_patches([&](Index p, PatchRows<Scalar>& rows, State& state) {
    const Patch& patch = patches_.patches[p];
    state.relaxation = static_cast<Scalar>(relaxation);
    std::fill_n(state.residual, patch.num_interior * patch.stride, Scalar(0));
    loop(state, {0, patch.stride});
    list_kernel_.scatter(lists_->view(), patches_.rows.data() + patch.first_row, patch.num_interior,
                         rows.slot_of.data(), state.residual, patch.stride,
                         patches_.leaves.data() + patch.first_row, left_.data());
  });
  parallel_for(static_cast<Index>(data_.vertices.size()), [&](Index row) {
    Scalar* residual = rows_.residual.data() + lists_->starts[row];
    const std::size_t length = lists_->starts[row + 1] - lists_->starts[row];
    for (const std::size_t place : patches_.left.of(row)) {
      for (std::size_t j = 0; j < length; ++j) residual[j] += left_[place + j];
    }
  });
  multigrid_->cycle(rows_.residual.data());
}

template <class Scalar, int Dim>
auto ActiveSplitting<Scalar, Dim>::row_state(Index row) -> State {
  const std::size_t start = lists_->starts[row];
  State state{};
  state.stride = lists_->starts[row + 1] - start;
  rows_.set(state, start);
  state.vertex_metric = rows_.S.size() > 0 ? data_.vertex_metric.data() + row : nullptr;
  state.basis = bases_->data() + (Dim + 1) * start;
  state.row_target = targets_.data() + static_cast<std::size_t>(row) * (Dim + 1);
  state.sigma = static_cast<Scalar>(sigma());
  state.relaxation = static_cast<Scalar>(parameters_.relaxation);
  return state;
}

template <class Scalar, int Dim>
double ActiveSplitting<Scalar, Dim>::pass_rows(RowLoop loop) {
  const auto num_rows = static_cast<Index>(data_.vertices.size());
  return parallel_sum(num_rows, 0.0, [&](Index begin, Index end) {
    const FlushDenormals flush;
    double change = 0;
    for (Index row = begin; row < end; ++row) change += loop(row_state(row), 0, 1);
    return change;
  });
}

// Truncated weights must be compensated elsewhere in the row.
template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::set_weights(const VectorsAt<1>& weights) {
  Base::set_weights(weights);
  std::fill_n(rows_.residual.data(), rows_.residual.size(), Scalar(0));
  pass_rows(kernel_.correct);
}

template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::set_cell_dual(const VectorsAt<Dim>& flux_density) {
  store_in_cells<Dim>(patches_, n_, P_, [&](Index s) {
    const double scale = compact::dual_scale(problem_, metric_, unit_, s);
    return [scale, density = flux_density(s)](Index i, int d) { return scale * density(i, d); };
  });
}

template <class Scalar, int Dim>
Vectors<Dim> ActiveSplitting<Scalar, Dim>::cell_dual(Index cell) const {
  Vectors<Dim> dual = Vectors<Dim>::Zero(n_, Dim);
  const Index k = patches_.place_of_cell[cell];
  const Patch& patch = patches_.patches[k / kPatchCells];
  const Scalar* rows = P_.data() + Dim * patch.number_of(k);
  for (std::size_t j = 0; j < patch.stride; ++j) {
    const Index i = patches_.items[patch.first_item + j];
    if (i >= n_) break;
    for (int d = 0; d < Dim; ++d) dual(i, d) = rows[d * patch.stride + j];
  }
  return dual;
}

// A larger set makes a new splitting, which starts from this one.
template <class Scalar, int Dim>
bool ActiveSplitting<Scalar, Dim>::adapt(const Milestone& at) {
  if (!at.ends && at.made % plan::kBetweenLooks != 0) return false;
  auto more = larger_set(at);
  if (more.items.size() <= active_.items.size()) return false;
  ++growths_;
  ActiveSplitting larger(problem_, metric_, parameters_, std::move(more));
  larger.start(this->state());
  active_ = std::move(larger.active_);
  lists_ = std::move(larger.lists_);
  targets_ = std::move(larger.targets_);
  bases_ = std::move(larger.bases_);
  patches_ = std::move(larger.patches_);
  multigrid_ = std::move(larger.multigrid_);
  left_ = std::move(larger.left_);
  data_ = std::move(larger.data_);
  rows_ = std::move(larger.rows_);
  P_ = std::move(larger.P_);
  return true;
}

// The active set, extended if weights at its border exceed a small part of the estimated error,
// because they would continue beyond; otherwise empty.
template <class Scalar, int Dim>
ActiveLists ActiveSplitting<Scalar, Dim>::larger_set(const Milestone& at) const {
  const double all = static_cast<double>(n_) * problem_.mesh.num_vertices();
  const auto half = static_cast<Scalar>(0.5 / sigma());
  const auto weight = [&](Index v, Index place) -> double {
    const std::size_t k = lists_->starts[data_.row_of[v]] + place;
    return half * (rows_.a[k] + rows_.W[k]);
  };
  const double at_ends = squared_at_ends<Dim>(problem_, active_, weight);
  if (!(at_ends > plan::kEndsOfError * at.error * all)) return {};
  return grown<Dim>(problem_, active_, threshold_for(at.tolerance), weight);
}

template <class Scalar, int Dim>
Weights ActiveSplitting<Scalar, Dim>::weights() const {
  const auto of_vertex = with_known_values(problem_, this->state().weights);
  return {{}, SparseWeights::of(n_, problem_.mesh.num_vertices(), of_vertex)};
}

template <class Scalar, int Dim>
Certificate ActiveSplitting<Scalar, Dim>::certify(const WeightMatrix& weights, Proof* proof) const {
  const auto density = this->state().flux_density;
  const auto stride = static_cast<std::size_t>(n_);
  std::vector<Scalar> flux(Dim * stride * problem_.mesh.num_cells());
  parallel_for(problem_.mesh.num_cells(), [&](Index s) {
    const Vectors<Dim> p = cell_geometry(problem_.mesh, s).measure * density(s);
    for (int d = 0; d < Dim; ++d) {
      for (Index i = 0; i < n_; ++i) {
        flux[(s * Dim + d) * stride + i] = static_cast<Scalar>(p(i, d));
      }
    }
  });
  return flbc::certify(problem_, CellFieldView<Scalar, Dim>{flux.data(), stride, n_}, weights,
                       proof);
}

template <class Scalar, int Dim>
void ActiveSplitting<Scalar, Dim>::describe(SolveReport& report) const {
  const std::size_t numbers = rows_.size() + P_.size() + left_.size() + bases_->size();
  report.penalty = this->penalty();
  report.state_scalars_per_cell = static_cast<double>(numbers) / n_ / problem_.mesh.num_cells();
  report.active_set = {density(problem_, active_), growths_};
}

FLBC_INSTANTIATE_SCALAR_CLASS(ActiveSplitting)

}  // namespace flbc::active_set
