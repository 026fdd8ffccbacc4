// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights as skins store them: a few joints and numbers per point.
#pragma once

#include <cstdint>

#include "flbc/sparse_weights.h"

namespace flbc::gltf {

//! How the weights of a skin are stored.
enum class WeightFormat {
  kFloat,          //!< 4 bytes each
  kUnsignedShort,  //!< 2 bytes each, multiples of 1 / 65535
  kUnsignedByte    //!< 1 byte each, multiples of 1 / 255
};

//! Sum of the stored numbers of a point: 1, 65535 or 255.
double unit_of(WeightFormat format);

//! The influences on each point, the largest first; slots that are not used have joint 0 and
//! number 0. There are 4 slots or 8, as many as some point needs.
struct JointWeights {
  WeightFormat format = WeightFormat::kFloat;
  Eigen::Matrix<std::uint16_t, Eigen::Dynamic, Eigen::Dynamic> joints{};  //!< slots x P
  Eigen::MatrixXd numbers{};  //!< slots x P, whole or of single precision; weights in unit_of()
};

//! Rounds so that the numbers of a point still add up to the unit: whole ones exactly, by the
//! largest remainders; floats as exactly as floats can.
//! \param weights  none below 0, at most 8 above 0 per point, with sum 1; n <= 65535
JointWeights to_joint_weights(const SparseWeights& weights, WeightFormat format);

//! The weights that a reader finds, of P points.
SparseWeights to_weights(const JointWeights& stored, Eigen::Index num_joints);

}  // namespace flbc::gltf
