// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Transfers weights from one model to another version of it.
#pragma once

#include "flbc/cage.h"
#include "flbc/masks.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! A model as a set of points, segments, and triangles.
template <int Dim>
struct ModelElements {
  PointList<Dim> points;  //!< Dim x P
  FacetList<3> corners;   //!< 3 x E; repeated corners describe a segment or a point
};

//! Weights at other points, interpolated linearly at the nearest place on a model.
//! \param from  model with weights \param weights  of its P points \param to  Dim x Q
//! \param limit  maximum distance of a point from the model, in its units
//! \param distances  output: Q distances from the model; may be null
//! \return weights of Q points \throws InputError as transfer_weights()
template <int Dim>
SparseWeights nearest_weights(const ModelElements<Dim>& from, const SparseWeights& weights,
                              const PointList<Dim>& to, double limit,
                              Eigen::VectorXd* distances = nullptr);

//! Weights at other points, from the nearest place on a model. They are interpolated linearly in
//! the nearest element, then projected so that they are non-negative, sum to 1, and reproduce the
//! point (project_non_negative()).
//! \param control_points  Dim x n
//! \param from  model with weights
//! \param weights  of the P points of the model
//! \param to  Dim x Q
//! \param limit  maximum distance of a point from the model, in its units
//! \param distances  output: Q distances from the model; may be null
//! \param masks  of the Q points; masked weights become exactly 0
//! \return weights of Q points
//! \throws InputError if sizes do not match, or points are farther away than the limit, naming
//! their number, the first, and the farthest; also as project_non_negative()
template <int Dim>
SparseWeights transfer_weights(const PointList<Dim>& control_points, const ModelElements<Dim>& from,
                               const SparseWeights& weights, const PointList<Dim>& to, double limit,
                               Eigen::VectorXd* distances = nullptr, const PointMasks& masks = {});

}  // namespace flbc
