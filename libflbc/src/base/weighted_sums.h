// SPDX-License-Identifier: BSD-3-Clause
// Sums of control points times weights, the inner loop of every deformation.
#pragma once

#include <omp.h>

#include <cstddef>
#include <cstdint>

#include "base/parallel.h"
#include "flbc/sparse_weights.h"

// Internal linkage, or the linker may take the copy of a file that is optimized lightly: then a
// deformation takes six times as long.
namespace flbc {
namespace {

//! Number of threads for a deformation with the given number of weights. Starting threads takes
//! microseconds on idle cores and milliseconds on busy ones, so they are used only if one thread
//! would take longer.
//! \param wanted  maximum number; 0 = as many as OpenMP offers
inline int deform_threads(std::size_t num_weights, int wanted) {
  constexpr std::size_t kWorthThreads = 4'000'000;
  if (num_weights < kWorthThreads) return 1;
  return wanted > 0 ? wanted : omp_get_max_threads();
}

//! Control points with coordinates padded to an even number, for vector instructions. The order of
//! summation is unchanged.
template <int Dim>
class PaddedPoints {
 public:
  explicit PaddedPoints(const PointList<Dim>& points)
      : points_(Padded::Zero(kRows, points.cols())) {
    points_.template topRows<Dim>() = points;
  }

  //! \param of  control points of the weights
  Vector<Dim> sum(const double* weights, const std::uint32_t* of, std::ptrdiff_t count) const {
    Eigen::Matrix<double, kRows, 1> sum = Eigen::Matrix<double, kRows, 1>::Zero();
    for (std::ptrdiff_t j = 0; j < count; ++j) sum += weights[j] * points_.col(of[j]);
    return sum.template head<Dim>();
  }

 private:
  static constexpr int kRows = Dim + Dim % 2;
  using Padded = Eigen::Matrix<double, kRows, Eigen::Dynamic>;
  Padded points_;
};

//! Calls use(p, sum) with the weighted sum of each point, in parallel.
template <int Dim, class Use>
void for_sums(const SparseWeights& weights, const PointList<Dim>& control_points, int threads,
              const Use& use) {
  const PaddedPoints<Dim> padded(control_points);
  const auto* starts = weights.starts().data();
  const auto* of = weights.control_points().data();
  const auto* values = weights.values().data();
  const ThreadScope scope(deform_threads(weights.values().size(), threads));
  parallel_for(weights.num_points(), [&](Index p) {
    const auto start = starts[p];
    use(p, padded.sum(values + start, of + start, starts[p + 1] - start));
  });
}

}  // namespace
}  // namespace flbc
