// SPDX-License-Identifier: BSD-3-Clause
#include "view/influences.h"

#include <string>
#include <vector>

#include "flbc/errors.h"
#include "flbc/sparsify.h"

namespace flbc::view {

template <int Dim>
WeightMatrix limit_influences(const PointList<Dim>& control_points, const PointList<Dim>& points,
                              const WeightMatrix& weights, Index most) {
  if (most < Dim + 1 || most > kMostInfluences) {
    throw OptionError("a page holds from " + std::to_string(Dim + 1) + " to " +
                      std::to_string(kMostInfluences) + " influences per point, not " +
                      std::to_string(most));
  }
  std::vector<Eigen::Index> crowded;
  for (Eigen::Index p = 0; p < weights.cols(); ++p) {
    if ((weights.col(p).array() != 0).count() > most) crowded.push_back(p);
  }
  WeightMatrix result = weights;
  if (crowded.empty()) return result;
  const PointList<Dim> places = points(Eigen::all, crowded);
  const WeightMatrix given = weights(Eigen::all, crowded);
  result(Eigen::all, crowded) = sparsify<Dim>(control_points, places, given, {most});
  return result;
}

template WeightMatrix limit_influences(const PointList<2>&, const PointList<2>&,
                                       const WeightMatrix&, Index);
template WeightMatrix limit_influences(const PointList<3>&, const PointList<3>&,
                                       const WeightMatrix&, Index);

}  // namespace flbc::view
