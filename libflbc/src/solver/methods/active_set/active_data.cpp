// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/active_data.h"

#include <algorithm>

#include "base/instantiate.h"
#include "base/padded_rows.h"
#include "base/parallel.h"
#include "mesh/cell_geometry.h"

namespace flbc::active_set {
namespace {

// Q and R^-T of [1; c] = Q R for one list, by Gram-Schmidt with reorthogonalization.
template <int Dim>
struct ListBasis {
  Eigen::Matrix<double, Eigen::Dynamic, Dim + 1> q;
  Eigen::Matrix<double, Dim + 1, Dim + 1> r = Eigen::Matrix<double, Dim + 1, Dim + 1>::Zero();

  // Columns that depend on previous ones up to rounding are redundant and left out.
  void orthogonalise() {
    constexpr double kDependent = 1e-9;
    for (int k = 0; k <= Dim; ++k) {
      const double before = q.col(k).norm();
      for (int pass = 0; pass < 2; ++pass) {
        for (int l = 0; l < k; ++l) {
          const double part = q.col(l).dot(q.col(k));
          q.col(k) -= part * q.col(l);
          r(l, k) += part;
        }
      }
      const double length = q.col(k).norm();
      if (length <= kDependent * before || before == 0) {
        q.col(k).setZero();
        continue;
      }
      q.col(k) /= length;
      r(k, k) = length;
    }
  }

  // Q^T w from [1; x] = R^T Q^T w.
  Vector<Dim + 1> target(const Vector<Dim + 1>& sums) const {
    Vector<Dim + 1> target = Vector<Dim + 1>::Zero();
    for (int k = 0; k <= Dim; ++k) {
      if (r(k, k) == 0) continue;
      double rest = sums[k];
      for (int l = 0; l < k; ++l) rest -= r(l, k) * target[l];
      target[k] = rest / r(k, k);
    }
    return target;
  }
};

// Rows of a patch's corners, interior ones first, and cells in terms of these.
template <class Scalar, int Dim>
void add_rows(Index num_interior, CellPatches<Scalar, Dim>& result, Patch& patch) {
  std::vector<Index> rows;
  for (Index s = patch.first_cell; s < patch.end_cell; ++s) {
    rows.insert(rows.end(), result.cells[s].rows, result.cells[s].rows + Dim + 1);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  const auto place_of = [&](Index row) {
    return static_cast<Index>(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
  };
  for (Index s = patch.first_cell; s < patch.end_cell; ++s) {
    for (auto& row : result.cells[s].rows) row = place_of(row);
  }
  patch.first_row = static_cast<Index>(result.rows.size());
  patch.num_rows = static_cast<Index>(rows.size());
  patch.num_interior = place_of(num_interior);
  result.rows.insert(result.rows.end(), rows.begin(), rows.end());
}

// The union of its rows' lists.
template <class Scalar, int Dim>
void add_list(const PackedLists& lists, ControlPoint n, CellPatches<Scalar, Dim>& result,
              Patch& patch) {
  std::vector<ControlPoint> items;
  for (Index k = 0; k < patch.num_rows; ++k) {
    const Index row = result.rows[patch.first_row + k];
    const ControlPoint* first = lists.items.data() + lists.starts[row];
    items.insert(items.end(), first, first + lists.counts[row]);
  }
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
  items.resize(padded(items.size()), n);
  patch.first_item = result.items.size();
  patch.stride = items.size();
  result.items.insert(result.items.end(), items.begin(), items.end());
}

// Location of the divergence contribution of each interior row of a patch.
template <class Scalar, int Dim>
void add_leaves(const PackedLists& lists, CellPatches<Scalar, Dim>& result, const Patch& patch) {
  for (Index k = 0; k < patch.num_rows; ++k) {
    const Index row = result.rows[patch.first_row + k];
    result.leaves.push_back(result.num_left);
    if (k < patch.num_interior) result.num_left += lists.starts[row + 1] - lists.starts[row];
  }
}

template <class Scalar, int Dim>
void set_radii(const LbcProblem<Dim>& problem, const splitting::Metric& metric, double unit,
               CellPatches<Scalar, Dim>& patches) {
  patches.radius = AlignedArray<Scalar>(patches.num_numbers);
  store_in_cells<1>(patches, problem.num_control_points(), patches.radius, [&](Index s) {
    const double scale = compact::dual_scale(problem, metric, unit, s);
    return [&problem, s, scale](Index i, int) {
      return scale * std::max(problem.phi(i, s), compact::kSmallestPhi);
    };
  });
}

}  // namespace

void PackedLists::append(const ActiveLists::Range& list, ControlPoint n) {
  items.insert(items.end(), list.first, list.last);
  counts.push_back(static_cast<std::int32_t>(list.last - list.first));
  items.resize(padded(items.size()), n);
  starts.push_back(items.size());
}

template <class Scalar, int Dim>
AlignedArray<Scalar> row_bases(const PackedLists& lists, const PointList<Dim>& control_points,
                               const PointList<Dim>& points, std::vector<Scalar>* targets) {
  AlignedArray<Scalar> bases((Dim + 1) * lists.size());
  if (targets != nullptr) targets->assign((Dim + 1) * lists.counts.size(), Scalar(0));
  parallel_for(lists.num_rows(), [&](Index row) {
    const std::size_t start = lists.starts[row];
    const std::size_t length = lists.starts[row + 1] - start;
    const Index count = lists.counts[row];
    if (count == 0) return;
    Vector<Dim> center = Vector<Dim>::Zero();
    for (Index j = 0; j < count; ++j) center += control_points.col(lists.items[start + j]) / count;
    ListBasis<Dim> basis;
    basis.q.resize(count, Dim + 1);
    basis.q.col(0).setOnes();
    for (Index j = 0; j < count; ++j) {
      basis.q.row(j).template tail<Dim>() =
          (control_points.col(lists.items[start + j]) - center).transpose();
    }
    basis.orthogonalise();
    for (int k = 0; k <= Dim; ++k) {
      Scalar* numbers = bases.data() + (Dim + 1) * start + k * length;
      for (Index j = 0; j < count; ++j) numbers[j] = static_cast<Scalar>(basis.q(j, k));
    }
    if (targets == nullptr) return;
    Vector<Dim + 1> sums;
    sums << 1, points.col(row) - center;
    const Vector<Dim + 1> target = basis.target(sums);
    for (int k = 0; k <= Dim; ++k) {
      (*targets)[row * (Dim + 1) + k] = static_cast<Scalar>(target[k]);
    }
  });
  return bases;
}

template <class Scalar, int Dim>
CellPatches<Scalar, Dim> make_patches(const LbcProblem<Dim>& problem,
                                      const splitting::Metric& metric, double unit,
                                      compact::CompactData<Scalar, Dim>& data,
                                      const PackedLists& lists) {
  CellPatches<Scalar, Dim> result;
  const auto num_interior = static_cast<Index>(data.vertices.size());
  const auto n = static_cast<ControlPoint>(problem.num_control_points());
  result.cells = std::move(data.cells);
  result.cell_index = std::move(data.cell_index);
  const auto num_cells = static_cast<Index>(result.cells.size());
  result.place_of_cell.assign(problem.mesh.num_cells(), -1);
  for (Index k = 0; k < num_cells; ++k) result.place_of_cell[result.cell_index[k]] = k;
  std::size_t next_number = 0;
  for (Index first = 0; first < num_cells; first += kPatchCells) {
    Patch patch{};
    patch.first_cell = first;
    patch.end_cell = std::min(num_cells, first + kPatchCells);
    add_rows(num_interior, result, patch);
    add_list(lists, n, result, patch);
    add_leaves(lists, result, patch);
    patch.first_number = next_number;
    next_number += (patch.end_cell - patch.first_cell) * patch.stride;
    result.largest_block = std::max(result.largest_block, patch.num_rows * patch.stride);
    result.patches.push_back(patch);
  }
  result.num_numbers = next_number;
  set_radii(problem, metric, unit, result);
  result.left = items_by_vertex<std::size_t>(num_interior, [&](const auto& visit) {
    for (const Patch& patch : result.patches) {
      for (Index k = 0; k < patch.num_interior; ++k) {
        visit(result.rows[patch.first_row + k], result.leaves[patch.first_row + k]);
      }
    }
  });
  return result;
}

FLBC_INSTANTIATE_SCALAR_FUNCTION(row_bases)
FLBC_INSTANTIATE_SCALAR_FUNCTION(make_patches)

}  // namespace flbc::active_set
