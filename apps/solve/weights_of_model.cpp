// SPDX-License-Identifier: BSD-3-Clause
#include "solve/weights_of_model.h"

#include <sstream>

#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/placement.h"

namespace flbc::app {
namespace {

// Weights reproduce their model up to rounding and the tolerance of a solve.
constexpr double kReproduction = 1e-6;

}  // namespace

void check_sizes(const SparseWeights& weights, Eigen::Index num_control_points,
                 Eigen::Index num_points, const WeightFiles& files) {
  if (weights.num_points() != num_points) {
    throw InputError(files.weights + ": has weights of " + std::to_string(weights.num_points()) +
                     " points, but " + files.model + " has " + std::to_string(num_points) +
                     " vertices");
  }
  if (weights.num_control_points() != num_control_points) {
    throw InputError(files.weights + ": has weights for " +
                     std::to_string(weights.num_control_points()) + " control points, but " +
                     files.cage + " has " + std::to_string(num_control_points));
  }
}

Index count_without_weights(const SparseWeights& weights) {
  Index count = 0;
  for (Index p = 0; p < weights.num_points(); ++p) count += weights.has_weights(p) ? 0 : 1;
  return count;
}

template <int Dim>
void check_reproduction(const SparseWeights& weights, const Cage<Dim>& rest,
                        const PointList<Dim>& points, const WeightFiles& files) {
  check_sizes(weights, rest.size(), points.cols(), files);
  const auto moved = deform(weights, rest.points);
  auto lengths = displacements(attached_points(rest, points, weights), moved);
  for (Index p = 0; p < weights.num_points(); ++p) {
    if (!weights.has_weights(p)) lengths[p] = 0;
  }
  Eigen::Index worst = 0;
  const double error = lengths.maxCoeff(&worst) / bounding_box_diagonal(rest.points);
  if (error <= kReproduction) return;
  const Eigen::IOFormat row(6, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
  std::ostringstream text;
  text << files.weights << ": the weights do not belong to this model: with " << files.cage
       << " they put vertex " << worst << " of " << files.model << " at "
       << moved.col(worst).transpose().format(row) << ", not at "
       << points.col(worst).transpose().format(row) << "; the distance is " << error
       << " of the cage size, but at most " << kReproduction
       << " is allowed; weights by the method bbw reproduce no model and need flbc deform "
          "--relative";
  throw InputError(text.str());
}

template void check_reproduction(const SparseWeights&, const Cage<2>&, const PointList<2>&,
                                 const WeightFiles&);
template void check_reproduction(const SparseWeights&, const Cage<3>&, const PointList<3>&,
                                 const WeightFiles&);

}  // namespace flbc::app
