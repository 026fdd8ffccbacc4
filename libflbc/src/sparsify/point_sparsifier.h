// SPDX-License-Identifier: BSD-3-Clause
// Reduces the influences of one point, without regard to its neighbors.
#pragma once

#include <vector>

#include "flbc/sparsify.h"
#include "polytope/weight_projection.h"
#include "sparsify/support_selection.h"

namespace flbc {

//! Thread-safe; each thread needs its own workspace.
template <int Dim>
class PointSparsifier {
 public:
  struct Workspace {
    explicit Workspace(const PointList<Dim>& control_points)
        : selection(Metric(), control_points) {}
    SupportSelection<Dim> selection;
    std::vector<Index> may_enter;
    PointWeights reduced, best;
  };

  //! \param control_points  Dim x n, kept by reference
  PointSparsifier(const PointList<Dim>& control_points, const SparsifyOptions& options)
      : control_points_(control_points), options_(options), projection_(control_points) {}

  //! The weights that sparsify() gives a point, exact.
  //! \param given  n \param projected  n, the nearest feasible weights
  Eigen::VectorXd sparsify(const Vector<Dim>& point, const Eigen::VectorXd& given,
                           const Eigen::VectorXd& projected, Workspace& work) const;

  //! The same with at most one more influence, accurate to about 1e-8.
  Eigen::VectorXd with_one_more(const Vector<Dim>& point, const Eigen::VectorXd& given,
                                const Eigen::VectorXd& projected, Workspace& work) const;

  const WeightProjection<Dim>& projection() const { return projection_; }

 private:
  bool is_within(Index most, const Eigen::VectorXd& projected) const;
  Vector<Dim> target_of(const Vector<Dim>& point, const Eigen::VectorXd& projected) const;
  bool reduce(Index most, const Eigen::VectorXd& given, const Eigen::VectorXd& projected,
              const std::vector<Index>& support, Workspace& work) const;
  bool start(const std::vector<Index>& support, std::size_t keep, Workspace& work) const;
  void exchange(const Eigen::VectorXd& given, const std::vector<Index>& support, Index most,
                Workspace& work) const;
  Eigen::VectorXd on_few_points(const Vector<Dim>& target, const Eigen::VectorXd& given,
                                const std::vector<Index>& support, Index most) const;

  const PointList<Dim>& control_points_;
  SparsifyOptions options_;
  WeightProjection<Dim> projection_;
};

//! Of the options, for weights of P points.
inline PointMasks masks_of(const SparsifyOptions& options, const SparseWeights& weights) {
  if (options.masks.empty()) return {};
  return {options.masks, weights.num_control_points(), weights.num_points()};
}

//! \param few  its weights \param size  n
Eigen::VectorXd to_dense(const PointWeights& few, Eigen::Index size);

}  // namespace flbc
