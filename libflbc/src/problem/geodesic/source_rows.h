// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Distances from some sources at a time on their way into a matrix whose columns are points.
#pragma once

#include <omp.h>

#include <algorithm>
#include <vector>

#include "base/stage_progress.h"
#include "flbc/distance_weights.h"

namespace flbc::distance {

//! Some rows of a DistanceMatrix. Written into it one by one, each number would fetch a cache line
//! of its own.
class SourceRows {
 public:
  //! \param num_rows  that are filled at a time \param num_points  V
  SourceRows(Index num_rows, Index num_points)
      : num_rows_(num_rows), numbers_(static_cast<std::size_t>(num_rows) * num_points) {}

  //! Of one source and point. \param row  in [0, num_rows)
  float& operator()(Index row, Index point) {
    return numbers_[static_cast<std::size_t>(point) * num_rows_ + row];
  }

  //! Copies the first rows. \param first  the row of the result they begin with
  void write(Index first, Index count, DistanceMatrix& result) const {
    for (Eigen::Index v = 0; v < result.cols(); ++v) {
      std::copy_n(numbers_.data() + v * num_rows_, count, result.col(v).data() + first);
    }
  }

 private:
  Index num_rows_;
  std::vector<float> numbers_;  // num_rows_ of each point
};

//! Measures from all sources, from some after the other by each thread.
//! \param make_measure  makes a function for a thread, which is called with a source, with rows,
//! and with the number of the row that takes its distances
//! \return num_sources x num_points
template <class MakeMeasure>
DistanceMatrix by_source_rows(Index num_sources, Index num_points,
                              const MakeMeasure& make_measure) {
  constexpr Index kMost = 16;      // a cache line
  constexpr Index kPerThread = 4;  // for threads to end nearly together
  const Index num_rows =
      std::clamp<Index>(num_sources / (kPerThread * omp_get_max_threads()), 1, kMost);
  DistanceMatrix result(num_sources, num_points);
  LoopProgress progress(num_sources);
#pragma omp parallel
  {
    SourceRows rows(num_rows, num_points);
    auto measure = make_measure();
#pragma omp for schedule(dynamic, 1)
    for (Index first = 0; first < num_sources; first += num_rows) {
      const Index count = std::min(num_rows, num_sources - first);
      for (Index row = 0; row < count; ++row) {
        measure(first + row, rows, row);
        progress.add(1);
      }
      rows.write(first, count, result);
    }
  }
  return result;
}

}  // namespace flbc::distance
