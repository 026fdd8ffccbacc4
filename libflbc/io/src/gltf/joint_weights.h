// SPDX-License-Identifier: BSD-3-Clause
// Weights in the format of skins: a few joints and weights per point.
#pragma once

#include <cstdint>

#include "flbc/sparse_weights.h"

namespace flbc::gltf {

enum class WeightFormat {
  kFloat,          //!< 4 bytes each
  kUnsignedShort,  //!< 2 bytes each, multiples of 1 / 65535
  kUnsignedByte    //!< 1 byte each, multiples of 1 / 255
};

//! Sum of the stored weights of a point: 1, 65535 or 255.
double unit_of(WeightFormat format);

//! The influences of each point, largest first; unused slots have joint 0 and weight 0. There are 4
//! or 8 slots, depending on the maximum number of influences. A point without weights has joint n,
//! which does not move, with all the weight.
struct JointWeights {
  WeightFormat format = WeightFormat::kFloat;
  Eigen::Matrix<std::uint16_t, Eigen::Dynamic, Eigen::Dynamic> joints{};  //!< slots x P
  Eigen::MatrixXd numbers{};  //!< slots x P, integers or single precision; in units of 1 /
                              //!< unit_of()
};

//! Rounds so that the weights of a point still sum to the unit: integers exactly, by the largest
//! remainder method; floats to single precision.
//! \param weights  non-negative, at most 8 nonzero per point, sum 1 or none; n <= 65535
JointWeights to_joint_weights(const SparseWeights& weights, WeightFormat format);

//! The weights as read back, of P points.
SparseWeights to_weights(const JointWeights& stored, Eigen::Index num_joints);

}  // namespace flbc::gltf
