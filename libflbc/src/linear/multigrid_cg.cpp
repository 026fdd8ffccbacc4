// SPDX-License-Identifier: BSD-3-Clause
#include "linear/multigrid_cg.h"

#include <omp.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace flbc {
namespace {

constexpr double kReduction = 1e-14;  // of the squared error, estimated as r . B^-1 r
constexpr int kMostSteps = 200;

// A thread's columns on their way. Every column has scalars of its own, and they are zero once it
// has arrived: it stays as it is, whatever the others in its slice do.
class ColumnSlice {
 public:
  //! \param arrays  solution, residual, direction and its product, size() rows each
  ColumnSlice(const RowMatrix& matrix, Multigrid<double>& multigrid, std::size_t stride,
              Slice slice, const std::vector<double*>& arrays)
      : matrix_(matrix),
        multigrid_(multigrid),
        stride_(stride),
        slice_(slice),
        x_(arrays[0]),
        r_(arrays[1]),
        p_(arrays[2]),
        q_(arrays[3]) {}

  // From the right-hand side in x to the solution there.
  void solve() {
    const std::size_t count = slice_.end - slice_.begin;
    std::vector<double> energy(count), first(count), step(count);
    for_numbers([&](std::size_t k, std::size_t) {
      r_[k] = p_[k] = x_[k];
      x_[k] = 0;
    });
    multigrid_.cycle_slice(p_, slice_.begin, slice_.end);
    energy = first = products(r_, p_);
    for (int k = 0; k < kMostSteps && any(energy, first); ++k) {
      multiply();
      const auto curvature = products(p_, q_);
      for (std::size_t i = 0; i < count; ++i) {
        const bool goes_on = energy[i] > kReduction * first[i] && curvature[i] > 0;
        step[i] = goes_on ? energy[i] / curvature[i] : 0;
      }
      for_numbers([&](std::size_t at, std::size_t i) {
        x_[at] += step[i] * p_[at];
        r_[at] -= step[i] * q_[at];
        q_[at] = r_[at];
      });
      multigrid_.cycle_slice(q_, slice_.begin, slice_.end);
      const auto next = products(r_, q_);
      for (std::size_t i = 0; i < count; ++i) {
        const double ratio = step[i] > 0 ? next[i] / energy[i] : 0;
        energy[i] = step[i] > 0 ? next[i] : 0;
        step[i] = ratio;
      }
      for_numbers([&](std::size_t at, std::size_t i) { p_[at] = q_[at] + step[i] * p_[at]; });
    }
  }

 private:
  // body(place of the number, column within the slice)
  template <class Body>
  void for_numbers(const Body& body) const {
    for (Index row = 0; row < matrix_.rows(); ++row) {
      const std::size_t start = static_cast<std::size_t>(row) * stride_;
      for (std::size_t i = slice_.begin; i < slice_.end; ++i) body(start + i, i - slice_.begin);
    }
  }

  std::vector<double> products(const double* a, const double* b) const {
    std::vector<double> sums(slice_.end - slice_.begin);
    for_numbers([&](std::size_t at, std::size_t i) { sums[i] += a[at] * b[at]; });
    return sums;
  }

  // q = matrix * p
  void multiply() const {
    for (Index row = 0; row < matrix_.rows(); ++row) {
      double* q = q_ + static_cast<std::size_t>(row) * stride_;
      std::fill(q + slice_.begin, q + slice_.end, 0.0);
      for (RowMatrix::InnerIterator entry(matrix_, row); entry; ++entry) {
        const double* p = p_ + static_cast<std::size_t>(entry.col()) * stride_;
        const double value = entry.value();
        for (std::size_t i = slice_.begin; i < slice_.end; ++i) q[i] += value * p[i];
      }
    }
  }

  static bool any(const std::vector<double>& energy, const std::vector<double>& first) {
    for (std::size_t i = 0; i < energy.size(); ++i) {
      if (energy[i] > kReduction * first[i]) return true;
    }
    return false;
  }

  const RowMatrix& matrix_;
  Multigrid<double>& multigrid_;
  std::size_t stride_;
  Slice slice_;
  double* x_;
  double* r_;
  double* p_;
  double* q_;
};

}  // namespace

MultigridCg::MultigridCg(const RowMatrix& matrix) : matrix_(matrix), position_(matrix.rows()) {
  std::iota(position_.begin(), position_.end(), 0);
}

void MultigridCg::solve(double* rows, std::size_t stride) const {
  if (size() == 0) return;
  if (!multigrid_ || stride_ != stride) multigrid_.emplace(matrix_, stride);
  stride_ = stride;
  std::vector<AlignedArray<double>> memory;
  std::vector<double*> arrays{rows};
  for (int k = 0; k < 3; ++k) {
    memory.emplace_back(position_.size() * stride);
    arrays.push_back(memory.back().data());
  }
#pragma omp parallel
  {
    const Slice slice = slice_of(stride, omp_get_thread_num(), omp_get_num_threads());
    if (slice.begin < slice.end) {
      ColumnSlice(matrix_, *multigrid_, stride, slice, arrays).solve();
    }
  }
}

}  // namespace flbc
