// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Estimates the distance of weights from the limit of the iteration, from their movement. Stopping
//! criterion of Method::kValue and Method::kGradient.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "flbc/types.h"
#include "solver/plan/constants.h"

namespace flbc {

//! Movement of weights in two intervals of iterations, the second of which begins where the first
//! ends. Each ends at 1.25 to 1.5 times the number of iterations at which it begins.
struct Movement {
  int from, middle, to;  //!< iterations
  double before, last;   //!< mean squared differences of a weight
  double since_start;    //!< the same to the start
};

//! Keeps the weights of some earlier iterations and compares the present ones with them. Unlike
//! single iterations, long intervals suppress oscillations and show slow drift.
class WeightHistory {
 public:
  static constexpr int kStep = 8;  //!< iterations between two comparisons

  //! Writes the n weights of a vertex.
  using ReadRow = std::function<void(Index vertex, double* weights)>;

  //! \param vertices  interior vertices; large meshes are sampled
  //! \param n  number of control points \param in_double  whether to store doubles instead of floats
  //! \param step  iterations between two comparisons
  WeightHistory(const std::vector<Index>& vertices, Index n, bool in_double, int step = kStep);

  //! Must be called with the start (iteration 0) and after iterations 1, 2, ... It compares only
  //! every `step` iterations.
  //! \return the movement, if there are two intervals
  std::optional<Movement> operator()(int iteration, const ReadRow& read);

 private:
  struct Kept {
    int iteration = 0;
    int compared_with = 0;        // iteration
    double difference = 0;        // to its weights
    std::vector<float> floats{};  // rows of the sample, of either type
    std::vector<double> doubles{};
  };

  template <class Scalar>
  Eigen::Array2d compare(std::vector<Scalar> Kept::*rows, const ReadRow& read);

  std::vector<Index> sample_;
  std::size_t n_;
  bool in_double_;
  int step_;
  Kept start_;
  std::deque<Kept> kept_;  // oldest first
  Kept present_;
};

//! The kind of start of an iteration, on which the estimate depends.
enum class Origin {
  kCold,         //!< weights without duals
  kCoarserMesh,  //!< weights and duals of a coarser mesh, with small errors of all kinds
  kNearby        //!< those of a similar problem; their errors appear only after some iterations
};

//! Estimates the mean squared error of weights by extrapolation.
//!
//! If weights move less by a factor rho (a length) whenever the number of iterations grows by the
//! same factor, the remaining error is rho / (1 - rho) times the last movement. This is exact where
//! errors shrink as a power of the number of iterations, as they do at first. Later they shrink
//! faster, and the estimate is too large. It is also too large where weights circle their limit.
//!
//! Duals may still grow while weights do not change, for example on round cages with nearly
//! undetermined weights. The residual of the splitting detects this, but costs more than an
//! iteration. It is therefore measured only if the run would otherwise end.
//!
//! Constants: plan/constants.h.
class ErrorEstimate {
 public:
  //! \param looks  whether the iteration adapts its penalty late (plan::kFirstLook), so that early
  //! estimates of cold starts say little
  explicit ErrorEstimate(Origin origin, bool looks = false) : origin_(origin), looks_(looks) {}

  //! Whether the next iteration should measure its residual.
  bool wants_residual() const { return wants_residual_; }

  //! Estimates of one run, iteration by iteration.
  //! \param tolerance  target mean squared error
  //! \param change  mean squared change of a weight in this iteration
  //! \param movement  of the weights; empty if unknown
  //! \param residual  mean squared difference of z and grad w per control point, times the squared
  //! size of the cage; negative if not measured
  //! \return the latest estimate; above the tolerance until a residual has confirmed it; not finite
  //! if an argument is not finite
  double operator()(int iteration, double tolerance, double change,
                    const std::optional<Movement>& movement, double residual = -1);

 private:
  double safety(int iteration, double tolerance) const;
  double confirmed(int iteration, double tolerance, double residual);

  Origin origin_;
  bool looks_;
  std::optional<double> moved_;  // since the start
  double shown_ = 0;             // by the weights
  double hidden_ = -1;           // from them, when last measured
  int next_measured_ = 0;
  bool wants_residual_ = false;
};

}  // namespace flbc
