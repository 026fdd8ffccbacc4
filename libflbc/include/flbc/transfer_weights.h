// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights from one model to another version of it.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! A model as a set of points, segments and triangles.
template <int Dim>
struct ModelElements {
  PointList<Dim> points;  //!< Dim x P
  FacetList<3> corners;   //!< 3 x E; a corner that is repeated makes a segment or a point of one
};

//! Weights at other points, from where they are nearest to a model: linear in the element there,
//! then the nearest weights that are not negative, sum to one and reproduce the point
//! (project_non_negative()).
//! \param control_points  Dim x n
//! \param from  the model that has weights
//! \param weights  n x P, of its points
//! \param to  Dim x Q
//! \param limit  largest distance of a point from the model, in its units
//! \param distances  Q, replaced unless null
//! \return n x Q
//! \throws InputError if sizes do not fit, or if points are farther away than the limit, naming how
//! many there are, the first of them and the farthest, or as project_non_negative()
template <int Dim>
WeightMatrix transfer_weights(const PointList<Dim>& control_points, const ModelElements<Dim>& from,
                              const WeightMatrix& weights, const PointList<Dim>& to, double limit,
                              Eigen::VectorXd* distances = nullptr);

}  // namespace flbc
