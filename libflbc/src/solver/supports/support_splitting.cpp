// SPDX-License-Identifier: BSD-3-Clause
#include "solver/supports/support_splitting.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "base/flush_denormals.h"
#include "flbc/padded_rows.h"

namespace flbc::supports {
namespace {

// One thread's dense rows of a patch.
template <class Scalar>
struct PatchRows {
  AlignedArray<Scalar> extrapolated, difference, residual, violation_sum;
  AlignedArray<double> violation;
  std::vector<std::uint16_t> slot_of;

  PatchRows(std::size_t largest_block, std::size_t n, bool measures)
      : extrapolated(largest_block),
        difference(measures ? largest_block : 0),
        residual(largest_block),
        violation_sum(measures ? padded(n) : 0),
        violation(measures ? padded(n) : 0),
        slot_of(n + 1) {}
};

// Cells of a patch by their place in it.
const std::int32_t* places_in_patch() {
  static const auto places = [] {
    std::array<std::int32_t, kPatchCells> numbers;
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  }();
  return places.data();
}

}  // namespace

template <class Scalar, class Stored, int Dim>
SupportSplitting<Scalar, Stored, Dim>::SupportSplitting(const LbcProblem<Dim>& problem,
                                                        splitting::Metric metric, double penalty,
                                                        double relaxation, SupportLists supports)
    : SupportSplitting(problem, metric, penalty, relaxation, std::move(supports),
                       splitting::system_matrix(problem, metric)) {
}

template <class Scalar, class Stored, int Dim>
SupportSplitting<Scalar, Stored, Dim>::SupportSplitting(const LbcProblem<Dim>& problem,
                                                        splitting::Metric metric, double penalty,
                                                        double relaxation, SupportLists supports,
                                                        const RowMatrix& system)
    : problem_(problem),
      kernel_(select_kernel<compact::Kernel<Scalar, Stored, Dim>>()),
      list_kernel_(select_kernel<Kernel<Scalar, Dim>>()),
      n_(problem.num_control_points()),
      metric_(std::move(metric)),
      unit_(compact::radius_unit(problem, metric_)),
      penalty_(penalty),
      relaxation_(relaxation),
      supports_(std::move(supports)),
      order_(sweep_order(system)),
      data_(compact::make_rows_and_cells<Scalar, Stored>(problem, metric_, order_.position, unit_)),
      lists_(lists_of_rows()),
      bases_(row_bases<Scalar, Dim>(lists_, problem.cage.points, points_of_rows(), &targets_)),
      patches_(make_patches(problem, metric_, unit_, data_, lists_, kernel_)),
      multigrid_(system, order_, lists_, bases_, problem.cage.points, list_kernel_),
      extrapolated_(lists_.size()),
      relaxed_(num_interior_numbers()),
      vertex_dual_(metric_.vertex.size() > 0 ? num_interior_numbers() : 0),
      residual_(num_interior_numbers()),
      left_(patches_.num_left),
      cell_dual_(Dim * patches_.radius.size()) {
}

template <class Scalar, class Stored, int Dim>
PackedLists SupportSplitting<Scalar, Stored, Dim>::lists_of_rows() const {
  PackedLists lists;
  const auto n = static_cast<ControlPoint>(n_);
  for (const Index v : data_.vertices) {
    lists.append(supports_.of(v).first, supports_.of(v).last, n);
  }
  for (const Index v : problem_.boundary.vertices) {
    lists.append(supports_.of(v).first, supports_.of(v).last, n);
  }
  return lists;
}

template <class Scalar, class Stored, int Dim>
PointList<Dim> SupportSplitting<Scalar, Stored, Dim>::points_of_rows() const {
  PointList<Dim> points(Dim, lists_.num_rows());
  Index row = 0;
  for (const Index v : data_.vertices) points.col(row++) = problem_.mesh.points.col(v);
  for (const Index v : problem_.boundary.vertices) points.col(row++) = problem_.mesh.points.col(v);
  return points;
}

template <class Scalar, class Stored, int Dim>
compact::Arrays<Scalar, Stored, Dim> SupportSplitting<Scalar, Stored, Dim>::patch_state(
    const Patch& patch) {
  State state{};
  state.stride = state.cell_stride = patch.stride;
  state.num_cells = static_cast<std::size_t>(patch.end_cell - patch.first_cell);
  state.num_interior = static_cast<std::size_t>(patch.num_interior);
  state.cell_dual = cell_dual_.data() + Dim * patch.first_number;
  state.cells = patches_.cells.data() + patch.first_cell;
  state.cell_index = places_in_patch();
  state.radius = patches_.radius.data() + patch.first_number;
  state.sigma = static_cast<Scalar>(sigma());
  return state;
}

// Z-steps of all cells; the divergence of each patch is left to be collected.
// \return the squared violation of z = grad w, if measured
template <class Scalar, class Stored, int Dim>
double SupportSplitting<Scalar, Stored, Dim>::pass_cells(bool measures, double relaxation) {
  const auto num_patches = static_cast<Index>(patches_.patches.size());
  const Lists lists = lists_.view();
  std::vector<double> violations(num_patches, 0);
#pragma omp parallel
  {
    const FlushDenormals flush;
    PatchRows<Scalar> rows(patches_.largest_block, n_ + 1, measures);
#pragma omp for schedule(static)
    for (Index p = 0; p < num_patches; ++p) {
      const Patch& patch = patches_.patches[p];
      const Index* numbers = patches_.rows.data() + patch.first_row;
      set_slots(patches_, patch, rows.slot_of);
      auto state = patch_state(patch);
      state.relaxation = static_cast<Scalar>(relaxation);
      state.extrapolated = rows.extrapolated.data();
      state.residual = rows.residual.data();
      list_kernel_.gather(lists, numbers, patch.num_rows, rows.slot_of.data(), extrapolated_.data(),
                          patch.stride, state.extrapolated);
      std::fill_n(state.residual, patch.num_interior * patch.stride, Scalar(0));
      if (measures) {
        const auto size = patch.num_rows * patch.stride;
        std::fill_n(rows.difference.data(), size, Scalar(0));
        list_kernel_.gather(lists, numbers, patch.num_interior, rows.slot_of.data(),
                            difference_.data(), patch.stride, rows.difference.data());
        std::fill_n(rows.violation.data(), rows.violation.size(), 0.0);
        state.difference = rows.difference.data();
        state.violation = rows.violation.data();
        state.violation_sum = rows.violation_sum.data();
        kernel_.z_step_measured(state, {0, patch.stride});
        violations[p] =
            std::accumulate(rows.violation.data(), rows.violation.data() + patch.stride, 0.0);
      } else {
        kernel_.z_step(state, {0, patch.stride});
      }
      list_kernel_.scatter(lists, numbers, patch.num_interior, rows.slot_of.data(), state.residual,
                           patch.stride, patches_.leaves.data() + patch.first_row, left_.data());
    }
  }
  return std::accumulate(violations.begin(), violations.end(), 0.0);
}

template <class Scalar, class Stored, int Dim>
void SupportSplitting<Scalar, Stored, Dim>::collect_divergence() {
  const auto num_rows = static_cast<Index>(data_.vertices.size());
#pragma omp parallel for schedule(static)
  for (Index row = 0; row < num_rows; ++row) {
    Scalar* residual = residual_.data() + lists_.starts[row];
    const std::size_t length = lists_.starts[row + 1] - lists_.starts[row];
    for (const std::size_t place : patches_.left.of(row)) {
      for (std::size_t j = 0; j < length; ++j) residual[j] += left_[place + j];
    }
  }
}

template <class Scalar, class Stored, int Dim>
compact::Arrays<Scalar, Stored, Dim> SupportSplitting<Scalar, Stored, Dim>::row_state(Index row) {
  static constexpr std::int32_t kItself = 0;
  const std::size_t start = lists_.starts[row];
  State state{};
  state.stride = lists_.starts[row + 1] - start;
  state.extrapolated = extrapolated_.data() + start;
  state.relaxed = relaxed_.data() + start;
  state.vertex_dual = has_vertex_dual() ? vertex_dual_.data() + start : nullptr;
  state.residual = residual_.data() + start;
  state.vertices = &kItself;
  state.vertex_metric = has_vertex_dual() ? data_.vertex_metric.data() + row : nullptr;
  state.basis = bases_.data() + (Dim + 1) * start;
  state.row_target = targets_.data() + static_cast<std::size_t>(row) * (Dim + 1);
  state.sigma = static_cast<Scalar>(sigma());
  state.relaxation = static_cast<Scalar>(relaxation_);
  return state;
}

template <class Scalar, class Stored, int Dim>
compact::RowSums SupportSplitting<Scalar, Stored, Dim>::pass_rows(RowLoop loop) {
  const auto num_rows = static_cast<Index>(data_.vertices.size());
  std::vector<compact::RowSums> parts((num_rows + kRowBlock - 1) / kRowBlock);
#pragma omp parallel
  {
    const FlushDenormals flush;
#pragma omp for schedule(static)
    for (std::size_t block = 0; block < parts.size(); ++block) {
      const Index begin = static_cast<Index>(block) * kRowBlock;
      for (Index row = begin; row < std::min(num_rows, begin + kRowBlock); ++row) {
        const auto sums = loop(row_state(row), 0, 1);
        parts[block].change += sums.change;
        parts[block].violation += sums.violation;
      }
    }
  }
  compact::RowSums sums;
  for (const auto& part : parts) {
    sums.change += part.change;
    sums.violation += part.violation;
  }
  return sums;
}

template <class Scalar, class Stored, int Dim>
compact::Step SupportSplitting<Scalar, Stored, Dim>::step(bool measures) {
  if (measures) {
    difference_ = AlignedArray<Scalar>(relaxed_.size());
    for (std::size_t k = 0; k < relaxed_.size(); ++k) {
      difference_[k] = Scalar(0.5) * (extrapolated_[k] - relaxed_[k]);
    }
  }
  const double of_cells = pass_cells(measures, relaxation_);
  collect_divergence();
  multigrid_.cycle(residual_.data());
  const auto sums = pass_rows(measures ? kernel_.y_step_measured : kernel_.y_step);
  const double scale = 1 / (sigma() * sigma());
  return {scale * sums.change, measures ? scale * (of_cells + sums.violation) : -1};
}

template <class Scalar, class Stored, int Dim>
Scalar SupportSplitting<Scalar, Stored, Dim>::weight_at(std::size_t place) const {
  return static_cast<Scalar>(0.5 / sigma()) * (extrapolated_[place] + relaxed_[place]);
}

template <class Scalar, class Stored, int Dim>
void SupportSplitting<Scalar, Stored, Dim>::read_vertex(Index vertex, Scalar* weights) const {
  const Index row = data_.row_of[vertex];
  std::fill_n(weights, padded(static_cast<std::size_t>(n_)), Scalar(0));
  const std::size_t start = lists_.starts[row];
  for (Index j = 0; j < lists_.counts[row]; ++j) {
    weights[lists_.items[start + j]] = weight_at(start + j);
  }
}

template <class Scalar, class Stored, int Dim>
double SupportSplitting<Scalar, Stored, Dim>::state_scalars_per_cell() const {
  const std::size_t numbers = extrapolated_.size() + relaxed_.size() + vertex_dual_.size() +
                              residual_.size() + left_.size() + bases_.size();
  const double cell_numbers =
      static_cast<double>(cell_dual_.size()) * sizeof(Stored) / sizeof(Scalar);
  return (static_cast<double>(numbers) + cell_numbers) / n_ / problem_.mesh.num_cells();
}

template class SupportSplitting<float, compact::Half, 2>;
template class SupportSplitting<float, compact::Half, 3>;
template class SupportSplitting<float, float, 2>;
template class SupportSplitting<float, float, 3>;
template class SupportSplitting<double, double, 2>;
template class SupportSplitting<double, double, 3>;

}  // namespace flbc::supports
