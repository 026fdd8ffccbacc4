// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/packed_lists.h"

#include "base/padded_rows.h"

namespace flbc::active_set {
namespace {

// Q and R^-T of [1; c] = Q R for one list, by Gram and Schmidt, every column twice.
template <int Dim>
struct ListBasis {
  Eigen::Matrix<double, Eigen::Dynamic, Dim + 1> q;
  Eigen::Matrix<double, Dim + 1, Dim + 1> r = Eigen::Matrix<double, Dim + 1, Dim + 1>::Zero();

  // Columns that depend on those before, to rounding, are left out: what they say is said already.
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

}  // namespace

void PackedLists::append(const ControlPoint* first, const ControlPoint* last, ControlPoint n) {
  items.insert(items.end(), first, last);
  counts.push_back(static_cast<std::int32_t>(last - first));
  items.resize(padded(items.size()), n);
  starts.push_back(items.size());
}

template <class Scalar, int Dim>
AlignedArray<Scalar> row_bases(const PackedLists& lists, const PointList<Dim>& control_points,
                               const PointList<Dim>& points, std::vector<Scalar>* targets) {
  AlignedArray<Scalar> bases((Dim + 1) * lists.size());
  if (targets != nullptr) targets->assign((Dim + 1) * lists.counts.size(), Scalar(0));
#pragma omp parallel for schedule(static)
  for (Index row = 0; row < lists.num_rows(); ++row) {
    const std::size_t start = lists.starts[row];
    const std::size_t length = lists.starts[row + 1] - start;
    const Index count = lists.counts[row];
    if (count == 0) continue;
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
    if (targets == nullptr) continue;
    Vector<Dim + 1> sums;
    sums << 1, points.col(row) - center;
    const Vector<Dim + 1> target = basis.target(sums);
    for (int k = 0; k <= Dim; ++k) {
      (*targets)[row * (Dim + 1) + k] = static_cast<Scalar>(target[k]);
    }
  }
  return bases;
}

#define FLBC_INSTANTIATE(Scalar, Dim)                                                \
  template AlignedArray<Scalar> row_bases(const PackedLists&, const PointList<Dim>&, \
                                          const PointList<Dim>&, std::vector<Scalar>*);
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::active_set
