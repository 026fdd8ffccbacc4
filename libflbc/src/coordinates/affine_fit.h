// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How control points around one of a cage move, as an affine map.
#pragma once

#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! The linear part of the affine map that fits displacements of control points in the sense of
//! least squares: the columns of G with sum_i G_i = 0 and sum_i c_i G_i^T = I that have the least
//! norm.
template <int Dim>
struct AffineFit {
  std::vector<Index> control_points;
  Eigen::Matrix<double, Eigen::Dynamic, Dim> gradients;  //!< G, a row per control point
};

//! Fits with a control point and its neighbours on the cage, and theirs, and so on, until they
//! surround it well enough: where facets lie in one plane neighbours alone do not.
template <int Dim>
class AffineFitter {
 public:
  //! \param cage  has passed validate(), outlives the fitter
  explicit AffineFitter(const Cage<Dim>& cage);

  AffineFit<Dim> operator()(Index control_point) const;

 private:
  const Cage<Dim>& cage_;
  std::vector<std::vector<Index>> neighbors_;
};

}  // namespace flbc
