// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Moving a model with its cage: X = C W for any number of poses C.
#pragma once

#include <cstdint>
#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Where points go when the control points move.
//! \param weights  n x P
//! \param control_points  Dim x n, in any units
//! \param threads  at most so many; 0 = as many as OpenMP offers. Less than four million weights take
//! one whatever this says: waking others may cost more, by far where other programs keep the cores
//! busy. The result does not depend on it
//! \return Dim x P, in the units of the control points
//! \throws InputError naming both numbers of control points if they differ
template <int Dim>
PointList<Dim> deform(const WeightMatrix& weights, const PointList<Dim>& control_points,
                      int threads = 0);

//! Weights without their zeros, point by point: the form for many poses of local coordinates, and
//! the one that skinning takes.
class SparseWeights {
 public:
  //! No points.
  SparseWeights() = default;

  //! Keeps weights with |w| > threshold as they are; nothing is scaled, so that with threshold 0
  //! nothing is lost, and with a larger one the sum of the weights falls short of 1 by what was
  //! dropped.
  //! \param weights  n x P
  //! \param threshold  >= 0
  //! \throws OptionError if the threshold is negative or no number
  explicit SparseWeights(const WeightMatrix& weights, double threshold = 0);

  //! P.
  Index num_points() const { return static_cast<Index>(starts_.size()) - 1; }

  //! n.
  Index num_control_points() const { return num_control_points_; }

  //! P + 1 values: the weights of point p are numbers starts[p] up to starts[p + 1].
  const std::vector<std::int64_t>& starts() const { return starts_; }

  //! The control points they belong to, ascending for each point.
  const std::vector<std::uint32_t>& control_points() const { return control_points_; }

  //! Their values.
  const std::vector<double>& values() const { return values_; }

 private:
  Index num_control_points_ = 0;
  std::vector<std::int64_t> starts_{0};
  std::vector<std::uint32_t> control_points_;
  std::vector<double> values_;
};

//! The same for weights without zeros.
//! \param weights  of P points
//! \param control_points  Dim x n, in any units
//! \param threads  as above
//! \return Dim x P, in the units of the control points
//! \throws InputError naming both numbers of control points if they differ
template <int Dim>
PointList<Dim> deform(const SparseWeights& weights, const PointList<Dim>& control_points,
                      int threads = 0);

//! How far each point moved.
//! \param before  Dim x P
//! \param after  Dim x P, in the same units
//! \return P lengths
//! \throws InputError if the numbers of points differ
template <int Dim>
Eigen::VectorXd displacements(const PointList<Dim>& before, const PointList<Dim>& after);

}  // namespace flbc
