// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Estimates the distance of weights from the limit of the iteration, from their changes. Stopping
//! criterion of Method::kValue.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "flbc/types.h"
#include "solver/plan/constants.h"

namespace flbc {

//! Differences of weights over kSpan iterations, for each control point. Unlike differences of
//! single iterations, they suppress fast oscillations and amplify slow drift by kSpan.
class WeightHistory {
 public:
  static constexpr int kSpan = 32;  //!< iterations
  static constexpr int kStep = 8;   //!< iterations between two samples

  //! Writes the n weights of a vertex.
  using ReadRow = std::function<void(Index vertex, double* weights)>;

  //! \param vertices  interior vertices; large meshes are sampled
  //! \param n  number of control points \param in_double  whether to store doubles, because floats
  //! would round the weights
  WeightHistory(const std::vector<Index>& vertices, Index n, bool in_double);

  //! Must be called after every iteration.
  //! \return for each control point, the mean squared difference to the weights kSpan iterations
  //! ago, every kStep iterations; empty at other times
  std::vector<double> operator()(int iteration, const ReadRow& read);

 private:
  template <class Scalar>
  using Rows = std::array<std::vector<Scalar>, kSpan / kStep>;  // of the sample, in turn

  template <class Scalar>
  std::vector<double> compare(std::vector<Scalar>& kept, const ReadRow& read) const;

  std::vector<Index> sample_;
  std::size_t n_;
  bool in_double_;
  Rows<float> floats_;
  Rows<double> doubles_;
};

//! The kind of start of an iteration, on which the estimate depends.
enum class Origin {
  kCold,         //!< weights without duals
  kCoarserMesh,  //!< weights and duals of a coarser mesh, with small errors of all kinds
  kNearby        //!< those of a similar problem; their errors appear only after some iterations
};

//! Estimates the mean squared error of weights in two ways.
//!
//! At first the error shrinks as a power of the number k of iterations, and is 0.1 to 0.9 times k^2
//! times the squared change of an iteration on the test models. In 3D, differences underestimate
//! the error then, so this serves as a lower bound.
//!
//! Geometric extrapolation over spans of kSpan iterations: if differences shrink by rho (a length)
//! from span to span, the remaining error is rho / (1 - rho) times the last one. The rate is a
//! regression over the last iterations, because differences oscillate. If the rate falls, because
//! slow parts of the error remain, it is assumed to fall further. If it is low for the number of
//! iterations, power-law decay is also assumed.
//!
//! Every control point is extrapolated with its own rate, because weights in a slit or a thin
//! finger may creep when the sum over all has settled. But single rates are noisy, and the estimate
//! becomes too large. The sum is therefore extrapolated, too, and the estimate is a geometric mean
//! of both.
//!
//! From a cold start, the estimate is no less than a fraction of what is left of weights that
//! approach their limit as 1 / k, where k is the number of iterations.
//!
//! Duals may still grow while weights do not change, for example on round cages with nearly
//! undetermined weights. The residual of the splitting detects this, but costs more than an
//! iteration. It is therefore measured only if the run would otherwise end.
//!
//! Constants: plan/constants.h.
class ErrorEstimate {
 public:
  //! \param dim  of the domain \param tolerance  target mean squared error
  //! \param span  iterations that differences are taken over
  //! \param early  a cold start ends before this iteration only with a much smaller estimate
  ErrorEstimate(Origin origin, int dim, double tolerance, int span = WeightHistory::kSpan,
                int early = plan::error_estimate::kFirstMeasured)
      : origin_(origin), dim_(dim), tolerance_(tolerance), span_(span), early_(early) {}

  //! Whether the next iteration should measure its residual.
  bool wants_residual() const { return wants_residual_; }

  //! Estimates of one run, iteration by iteration.
  //! \param change  mean squared change of a weight in this iteration
  //! \param differences  of each control point, mean squared differences to the weights of `span`
  //! iterations ago; empty if unknown
  //! \param residual  mean squared difference of z and grad w per control point, times the squared
  //! size of the cage; negative if not measured
  //! \return the latest estimate; above the tolerance until a residual has confirmed it; not finite
  //! if an argument is not finite
  double operator()(int iteration, double change, const std::vector<double>& differences,
                    double residual = -1);

 private:
  struct Entry {
    int iteration;
    std::vector<double> log_differences;  // of each control point, then of their sum
  };
  double rate(std::size_t i, double first, double last) const;
  double spans_left(double rate) const;
  double rest(std::size_t i) const;
  double least(int iteration, double change) const;
  double extrapolated(const std::vector<double>& differences, double sum) const;
  double confirmed(int iteration, double residual);

  Origin origin_;
  int dim_;
  double tolerance_;
  int span_;
  int early_;
  double shown_ = 0;    // by the weights
  double hidden_ = -1;  // from them, when last measured
  int next_measured_ = 0;
  bool wants_residual_ = false;
  std::vector<Entry> entries_;
};

}  // namespace flbc
