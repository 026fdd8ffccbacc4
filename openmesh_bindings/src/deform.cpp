// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/deform.h"

#include <atomic>
#include <cstdint>
#include <string>

#include "base/parallel.h"
#include "base/weighted_sums.h"
#include "flbc/errors.h"

namespace flbc::openmesh::internal {
namespace {

// Sums in the order of deform(SparseWeights), so results are identical.
template <int Dim>
Vector<Dim> place_of(const InfluenceBlock& weights, std::int64_t p, const PaddedPoints<Dim>& cage) {
  const std::size_t most = weights.most();
  const std::size_t start = static_cast<std::size_t>(p) * most;
  return cage.sum(weights.weights() + start, weights.control_points() + start,
                  static_cast<std::ptrdiff_t>(most));
}

template <int Dim>
Vector<Dim> place_of(const RowBlock<double>& weights, std::int64_t p,
                     const Eigen::Matrix<double, Eigen::Dynamic, Dim>& coordinates) {
  const Eigen::Map<const Eigen::VectorXd> row(
      weights.data() + static_cast<std::size_t>(p) * weights.width(), coordinates.rows());
  Vector<Dim> place;
  for (int d = 0; d < Dim; ++d) place[d] = coordinates.col(d).dot(row);
  return place;
}

std::size_t numbers_in(const InfluenceBlock& weights) {
  return weights.size() * weights.most();
}
std::size_t numbers_in(const RowBlock<double>& weights) {
  return weights.size() * weights.width();
}
std::size_t control_points_of(const InfluenceBlock& weights) {
  return weights.num_control_points();
}
std::size_t control_points_of(const RowBlock<double>& weights) {
  return weights.width();
}

// The layout for the loop over the weights of a point.
template <int Dim>
PaddedPoints<Dim> arranged(const InfluenceBlock&, const PointList<Dim>& control_points) {
  return PaddedPoints<Dim>(control_points);
}
// One coordinate per column, so sums run over contiguous values.
template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> arranged(const RowBlock<double>&,
                                                    const PointList<Dim>& control_points) {
  return control_points.transpose();
}

}  // namespace

template <class Block, class Scalar, int Dim>
Index move_points(const Block& weights, const PointList<Dim>& control_points,
                  const RowBlock<double>* offsets, int threads, const PointsView<Scalar>& points) {
  require_control_points(control_points_of(weights), control_points.cols());
  const auto cage = arranged<Dim>(weights, control_points);
  const auto count = static_cast<std::int64_t>(weights.size());
  const ThreadScope scope(deform_threads(numbers_in(weights), threads));
  std::atomic<Index> left{0};
  parallel_for(count, [&](std::int64_t p) {
    Vector<Dim> place = place_of<Dim>(weights, p, cage);
    if (place.isZero(0) && is_unbound(weights[static_cast<std::size_t>(p)])) {
      // It stays where it is. Only if it was bound so, it has an offset.
      if (!offsets || is_unbound((*offsets)[static_cast<std::size_t>(p)])) ++left;
      return;
    }
    if (offsets) {
      const auto offset = (*offsets)[static_cast<std::size_t>(p)];
      for (int d = 0; d < Dim; ++d) place[d] += offset[static_cast<std::size_t>(d)];
    }
    Scalar* point = points.data + static_cast<std::size_t>(p) * points.stride;
    for (int d = 0; d < Dim; ++d) point[d] = static_cast<Scalar>(place[d]);
  });
  if (count > 0 && left == count) {
    throw InputError("none of the " + std::to_string(count) +
                     " vertices was bound; bind the mesh again");
  }
  return left;
}

#define FLBC_INSTANTIATE(Block, Scalar, Dim)                                                    \
  template Index move_points(const Block&, const PointList<Dim>&, const RowBlock<double>*, int, \
                             const PointsView<Scalar>&);
#define FLBC_INSTANTIATE_BLOCK(Block) \
  FLBC_INSTANTIATE(Block, float, 2)   \
  FLBC_INSTANTIATE(Block, float, 3)   \
  FLBC_INSTANTIATE(Block, double, 2)  \
  FLBC_INSTANTIATE(Block, double, 3)
FLBC_INSTANTIATE_BLOCK(InfluenceBlock)
FLBC_INSTANTIATE_BLOCK(RowBlock<double>)
#undef FLBC_INSTANTIATE_BLOCK
#undef FLBC_INSTANTIATE

}  // namespace flbc::openmesh::internal
