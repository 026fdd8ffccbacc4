// SPDX-License-Identifier: BSD-3-Clause
// Checks that sizes of weights, points, control points, and poses match.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/messages.h"
#include "flbc/errors.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! \throws InputError if weights, n x P, are not num_control_points x num_points
inline void check_size(Eigen::Index n, Eigen::Index P, Eigen::Index num_control_points,
                       Eigen::Index num_points) {
  if (n == num_control_points && P == num_points) return;
  throw InputError("weights for " + std::to_string(P) + " points and " + std::to_string(n) +
                   " control points do not match " + std::to_string(num_points) + " points and " +
                   std::to_string(num_control_points) + " control points");
}

inline void check_size(const WeightMatrix& weights, Eigen::Index num_control_points,
                       Eigen::Index num_points) {
  check_size(weights.rows(), weights.cols(), num_control_points, num_points);
}
inline void check_size(const SparseWeights& weights, Eigen::Index num_control_points,
                       Eigen::Index num_points) {
  check_size(weights.num_control_points(), weights.num_points(), num_control_points, num_points);
}

//! \throws InputError naming the first non-finite point
template <int Dim>
void check_finite(const PointList<Dim>& points) {
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    if (points.col(p).allFinite()) continue;
    throw InputError("point " + std::to_string(p) + " at " + format_point(points.col(p)) +
                     " is not finite");
  }
}

//! How messages call the elements between points.
struct ElementNames {
  const char* all;      //!< such as "cage"
  const char* element;  //!< such as "facet"
  const char* point;    //!< such as "control point"
  const char* points;
};
constexpr ElementNames kCageNames{"cage", "facet", "control point", "control points"};
constexpr ElementNames kMeshNames{"domain mesh", "cell", "vertex", "vertices"};

//! \throws InputError naming the first of the elements (one per column) with an index that is not
//! in [0, num_points)
template <class Elements>
void check_indices(const Elements& elements, Eigen::Index num_points, const ElementNames& names) {
  for (Eigen::Index e = 0; e < elements.cols(); ++e) {
    for (const auto index : elements.col(e)) {
      if (index >= 0 && index < num_points) continue;
      throw InputError(std::string(names.element) + " " + std::to_string(e) + " of the " +
                       names.all + " refers to " + names.point + " " + std::to_string(index) +
                       ", but there are " + std::to_string(num_points) + " " + names.points);
    }
  }
}

//! \throws InputError if there are no elements, a point is not finite, or as check_indices()
template <class Points, class Elements>
void check_elements(const Points& points, const Elements& elements, const ElementNames& names) {
  if (elements.cols() == 0) {
    throw InputError("the " + std::string(names.all) + " has no " + names.element + "s");
  }
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    if (points.col(p).allFinite()) continue;
    throw InputError(std::string(names.point) + " " + std::to_string(p) + " of the " + names.all +
                     " is not finite: " + format_point(points.col(p)));
  }
  check_indices(elements, points.cols(), names);
}

//! \throws InputError unless phi is n x F, finite, and not negative
template <class Phi>
void check_phi(const Phi& phi, Eigen::Index n, Eigen::Index num_cells) {
  if (phi.rows() != n || phi.cols() != num_cells) {
    throw InputError("phi is " + std::to_string(phi.rows()) + " x " + std::to_string(phi.cols()) +
                     ", but the problem has " + std::to_string(n) + " control points and " +
                     std::to_string(num_cells) + " cells; make_problem() computes phi");
  }
  for (Eigen::Index s = 0; phi.is_given() && s < num_cells; ++s) {
    for (Eigen::Index i = 0; i < n; ++i) {
      if (phi(i, s) >= 0 && std::isfinite(phi(i, s))) continue;
      throw InputError("phi of control point " + std::to_string(i) + " on cell " +
                       std::to_string(s) + " is " + format_number(phi(i, s)) +
                       "; it must be finite and not negative");
    }
  }
}

//! \throws InputError naming the first pose that is not finite or does not have `n` control points
template <int Dim>
void check_poses(const std::vector<PointList<Dim>>& poses, Eigen::Index n) {
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const std::string name = "pose " + std::to_string(k);
    if (poses[k].cols() != n) {
      throw InputError(name + " has " + std::to_string(poses[k].cols()) +
                       " control points, but the weights are for " + std::to_string(n));
    }
    if (!poses[k].allFinite()) throw InputError(name + " has a number that is not finite");
  }
}

}  // namespace flbc
