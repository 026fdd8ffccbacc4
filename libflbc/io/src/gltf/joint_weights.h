// SPDX-License-Identifier: BSD-3-Clause
// Weights in the format of skins: a few joints and weights per point.
#pragma once

#include <cstdint>

#include "flbc/sparse_weights.h"

namespace flbc::gltf {

//! The influences of each point, largest first; unused slots have joint 0 and weight 0. There are 4
//! or 8 slots, depending on the maximum number of influences. A point without weights has joint n,
//! which does not move, with all the weight.
struct JointWeights {
  Eigen::Matrix<std::uint16_t, Eigen::Dynamic, Eigen::Dynamic> joints{};  //!< slots x P
  Eigen::MatrixXf numbers{};                                              //!< slots x P
};

//! Rounds to single precision, so that the weights of a point still sum to 1 in it.
//! \param weights  non-negative, at most 8 nonzero per point, sum 1 or none; n <= 65535
JointWeights to_joint_weights(const SparseWeights& weights);

//! The weights as read back, of P points.
SparseWeights to_weights(const JointWeights& stored, Eigen::Index num_joints);

}  // namespace flbc::gltf
