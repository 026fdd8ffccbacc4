// SPDX-License-Identifier: BSD-3-Clause
#include "linear/multigrid_cg.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/parallel.h"

namespace flbc {
namespace {

constexpr double kReduction = 1e-14;  // of the squared error, estimated as r . B^-1 r
constexpr int kMostSteps = 200;

// The state of the columns of one thread. Each column has its own scalars, which are zero after
// convergence, so the column no longer changes.
struct ColumnSlice {
  const RowMatrix& matrix;
  Multigrid<double>& multigrid;
  std::size_t stride;
  Slice slice;
  // Solution, residual, direction, and its product.
  double* x;
  double* r;
  double* p;
  double* q;

  // Solves in place: x is the right-hand side, then the solution.
  void solve() {
    const std::size_t count = slice.end - slice.begin;
    std::vector<double> energy(count), first(count), step(count);
    for_numbers([&](std::size_t k, std::size_t) {
      r[k] = p[k] = x[k];
      x[k] = 0;
    });
    multigrid.cycle_slice(p, slice.begin, slice.end);
    energy = first = products(r, p);
    for (int k = 0; k < kMostSteps && any(energy, first); ++k) {
      multiply();
      const auto curvature = products(p, q);
      for (std::size_t i = 0; i < count; ++i) {
        const bool goes_on = energy[i] > kReduction * first[i] && curvature[i] > 0;
        step[i] = goes_on ? energy[i] / curvature[i] : 0;
      }
      for_numbers([&](std::size_t at, std::size_t i) {
        x[at] += step[i] * p[at];
        r[at] -= step[i] * q[at];
        q[at] = r[at];
      });
      multigrid.cycle_slice(q, slice.begin, slice.end);
      const auto next = products(r, q);
      for (std::size_t i = 0; i < count; ++i) {
        const double ratio = step[i] > 0 ? next[i] / energy[i] : 0;
        energy[i] = step[i] > 0 ? next[i] : 0;
        step[i] = ratio;
      }
      for_numbers([&](std::size_t at, std::size_t i) { p[at] = q[at] + step[i] * p[at]; });
    }
  }

  // body(position of the value, column within the slice)
  template <class Body>
  void for_numbers(const Body& body) const {
    for (Index row = 0; row < matrix.rows(); ++row) {
      const std::size_t start = static_cast<std::size_t>(row) * stride;
      for (std::size_t i = slice.begin; i < slice.end; ++i) body(start + i, i - slice.begin);
    }
  }

  std::vector<double> products(const double* a, const double* b) const {
    std::vector<double> sums(slice.end - slice.begin);
    for_numbers([&](std::size_t at, std::size_t i) { sums[i] += a[at] * b[at]; });
    return sums;
  }

  // q = matrix * p
  void multiply() const {
    for (Index row = 0; row < matrix.rows(); ++row) {
      double* product = q + static_cast<std::size_t>(row) * stride;
      std::fill(product + slice.begin, product + slice.end, 0.0);
      for (RowMatrix::InnerIterator entry(matrix, row); entry; ++entry) {
        const double* factor = p + static_cast<std::size_t>(entry.col()) * stride;
        const double value = entry.value();
        for (std::size_t i = slice.begin; i < slice.end; ++i) product[i] += value * factor[i];
      }
    }
  }

  static bool any(const std::vector<double>& energy, const std::vector<double>& first) {
    for (std::size_t i = 0; i < energy.size(); ++i) {
      if (energy[i] > kReduction * first[i]) return true;
    }
    return false;
  }
};

}  // namespace

MultigridCg::MultigridCg(const RowMatrix& matrix) : matrix_(matrix), position_(matrix.rows()) {
  std::iota(position_.begin(), position_.end(), 0);
}

void MultigridCg::solve(double* rows, std::size_t stride) const {
  if (size() == 0) return;
  if (!multigrid_ || stride_ != stride) multigrid_.emplace(matrix_, stride);
  stride_ = stride;
  const std::size_t room = position_.size() * stride;
  AlignedArray<double> r(room), p(room), q(room);
  in_threads(true, [&](int thread, int num_threads) {
    const Slice slice = slice_of(stride, thread, num_threads);
    if (slice.begin == slice.end) return;
    ColumnSlice columns{matrix_, *multigrid_, stride, slice, rows, r.data(), p.data(), q.data()};
    columns.solve();
  });
}

}  // namespace flbc
