// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How far an iteration's weights are from its limit, judged by how it moves: what Method::kValue
//! stops by.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Differences of weights over kSpan iterations. Unlike those of single iterations they hardly see
//! what oscillates and fades soon, and see what drifts slowly kSpan times as large.
class WeightHistory {
 public:
  static constexpr int kSpan = 32;  //!< iterations
  static constexpr int kStep = 8;   //!< iterations between two looks

  //! Writes the n weights of a vertex.
  using ReadRow = std::function<void(Index vertex, double* weights)>;

  //! \param vertices  the interior ones; of a large mesh some thousands serve as a sample
  //! \param n  number of control points \param in_double  whether floats would round the weights
  WeightHistory(const std::vector<Index>& vertices, Index n, bool in_double);

  //! To be called after every iteration.
  //! \return mean squared difference per vertex to the weights kSpan iterations ago, every kStep
  //! iterations; below 0 at other times
  double operator()(int iteration, const ReadRow& read);

 private:
  template <class Scalar>
  using Rows = std::array<std::vector<Scalar>, kSpan / kStep>;  // of the sample, in turn

  template <class Scalar>
  double compare(std::vector<Scalar>& kept, const ReadRow& read) const;

  std::vector<Index> sample_;
  std::size_t n_;
  bool in_double_;
  Rows<float> floats_;
  Rows<double> doubles_;
};

//! Where an iteration started from, by which it shows how far it has to go.
enum class Origin {
  kCold,         //!< weights without duals
  kCoarserMesh,  //!< weights and duals of a coarser mesh, off by a little of everything
  kNearby        //!< those of a problem like it; what is wrong with them first shows after a while
};

//! Estimates the mean squared error of weights, by two looks at it.
//!
//! At first the error shrinks as a power of the number k of iterations, and is 0.1 to 0.9 times k^2
//! times the squared change of an iteration on the test models. In 3D differences tell less than
//! that then, so it is a lower bound.
//!
//! Geometric extrapolation over spans of kSpan iterations: if differences shrink by rho (a length)
//! from span to span, the remaining error is rho / (1 - rho) times the last one. The rate is a
//! regression's over the last iterations, because differences oscillate; where it falls, as the
//! slow parts of the error remain, it is taken to fall further. Where it is low for the number of
//! iterations, shrinking as a power of that number is assumed as well.
//!
//! Weights do not show duals that still grow while they stand still, as on round cages whose
//! weights are nearly undetermined. It is in the residual of the splitting, which costs more than
//! an iteration to measure. So it is asked for only where the run would end without it.
//!
//! Constants: plan/constants.h.
class ErrorEstimate {
 public:
  //! \param dim  of the domain \param tolerance  mean squared error that the run is to end at
  //! \param span  iterations that differences are taken over
  ErrorEstimate(Origin origin, int dim, double tolerance, int span = WeightHistory::kSpan)
      : origin_(origin), dim_(dim), tolerance_(tolerance), span_(span) {}

  //! Whether the next iteration should measure its residual.
  bool wants_residual() const { return wants_residual_; }

  //! Estimates of one run, iteration by iteration.
  //! \param change  mean squared change of a weight in this iteration
  //! \param difference  mean squared difference to the weights of `span` iterations ago;
  //! below 0 where it is not known
  //! \param residual  mean squared difference of z and grad w per control point, times the squared
  //! size of the cage; below 0 where it was not measured
  //! \return the estimate of this iteration or, where there is none, of the last one that had one;
  //! above the tolerance until a residual has confirmed it; not finite if an argument is not
  double operator()(int iteration, double change, double difference, double residual = -1);

 private:
  struct Entry {
    int iteration;
    double log_difference;
  };
  double rate(double first, double last) const;
  double spans_left(double rate) const;
  double rest() const;
  double least(int iteration, double change) const;
  double confirmed(int iteration, double residual);

  Origin origin_;
  int dim_;
  double tolerance_;
  int span_;
  double shown_ = 0;    // by the weights
  double hidden_ = -1;  // from them, when last measured
  int next_measured_ = 0;
  bool wants_residual_ = false;
  std::vector<Entry> entries_;
};

}  // namespace flbc
