// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The interface of iterations: splitting on all pairs, splitting on an active set, gradient ADMM.
#pragma once

#include <utility>

#include "flbc/certificate.h"
#include "flbc/report.h"
#include "flbc/sparse_weights.h"
#include "solver/start/start.h"

namespace flbc {

//! Result of the last iteration of a call.
struct Step {
  double change = 0;  //!< squared change of all weights or gradients
  //! Norms of r_p and r_d of the paper divided by their number of components; 0 if not measured.
  double primal = 0, dual = 0;
};

//! Weights in the format of an iteration: dense, or sparse for an active set.
struct Weights {
  WeightMatrix dense{};    //!< n x V, empty if they are sparse
  SparseWeights sparse{};  //!< of V points

  bool is_sparse() const { return sparse.num_points() > 0; }

  WeightMatrix to_dense() && { return is_sparse() ? sparse.dense() : std::move(dense); }
  SparseWeights to_sparse() && { return is_sparse() ? std::move(sparse) : SparseWeights(dense); }
};

//! The point that a run has reached, as an iteration needs it to adapt.
struct Milestone {
  int made;          //!< iterations since the start, over all runs that resumed
  double error;      //!< estimated mean squared error of the weights
  double tolerance;  //!< its target
  bool ends;         //!< whether the run would end here
};

//! An iteration and its state. Boundary values of the weights are exact; interior columns sum to
//! one and reproduce their points up to the iteration's precision, and may be negative. The run
//! counts the iterations.
template <int Dim>
class Iteration {
 public:
  virtual ~Iteration() = default;

  //! Starts from weights and duals, or cold. Must be called before iterate().
  virtual void start(const Start<Dim>& start) = 0;

  //! Iterations between two evaluations of the run.
  virtual int interval() const { return 1; }

  //! Iterates. adapt() must follow before the next call. \param made  iterations since the start
  //! \param count  >= 1; at most up to the next multiple of interval()
  virtual Step iterate(int made, int count) = 0;

  //! Lets the iteration change the pairs it works on.
  //! \return whether it works on other pairs, so that changes so far say nothing about the error
  virtual bool adapt(const Milestone&) { return false; }

  virtual Weights weights() const = 0;

  //! A start for another iteration: views, valid until the next call of iterate() or adapt(). Cold
  //! if not supported.
  virtual Start<Dim> state() const { return {}; }

  //! Whether certify() has the duals that it needs.
  virtual bool can_certify() const { return true; }

  //! Certificate of weights (n x V) from the current duals. \param proof  receives them, if given
  virtual Certificate certify(const WeightMatrix& weights, Proof* proof) const = 0;

  //! Fills in the penalty, the size of the state, and the active set.
  virtual void describe(SolveReport& report) const = 0;
};

}  // namespace flbc
