// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify.h"

#include <omp.h>

#include <optional>
#include <string>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/stage_progress.h"
#include "flbc/errors.h"
#include "flbc/non_negative.h"
#include "sparsify/point_sparsifier.h"

namespace flbc {

template <int Dim>
void validate(const SparsifyOptions& options) {
  if (options.max_influences < Dim + 1) {
    throw OptionError("max_influences must be at least " + std::to_string(Dim + 1) + " in " +
                      std::to_string(Dim) + "D, because fewer cannot reproduce a vertex, not " +
                      std::to_string(options.max_influences));
  }
  if (!(options.threshold >= 0 && options.threshold < 1)) {
    throw OptionError("the threshold must be at least 0 and below 1, not " +
                      format_number(options.threshold));
  }
}

template <int Dim>
SparseWeights sparsify(const PointList<Dim>& control_points, const PointList<Dim>& points,
                       const SparseWeights& weights, const SparsifyOptions& options) {
  validate<Dim>(options);
  const StageScope scope(options.progress);
  const auto masks = masks_of(options, weights);
  const auto projected = [&] {
    const StageScope silent({});
    return project_non_negative(control_points, points, weights, {}, masks);  // checks the input
  }();
  const auto& given = masks.empty() ? weights : projected;  // masked influences never enter
  const PointSparsifier<Dim> sparsifier(control_points, options);
  const auto num_points = static_cast<Index>(points.cols());
  LoopProgress progress(num_points);
  std::vector<std::optional<typename PointSparsifier<Dim>::Workspace>> works(omp_get_max_threads());
  return SparseWeights::of(static_cast<Index>(control_points.cols()), num_points, [&](Index p) {
    auto& work = works[omp_get_thread_num()];
    if (!work) work.emplace(control_points);
    progress.add(1);
    return sparsifier.sparsify(points.col(p), given.at(p), projected.at(p), *work);
  });
}

template void validate<2>(const SparsifyOptions&);
template void validate<3>(const SparsifyOptions&);
FLBC_INSTANTIATE_FUNCTION(sparsify)

}  // namespace flbc
