// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What a run knows of an iteration: the splitting on all pairs, the splitting on an active set,
//! the gradient ADMM.
#pragma once

#include <utility>

#include "flbc/certificate.h"
#include "flbc/report.h"
#include "flbc/sparse_weights.h"
#include "solver/start/start.h"

namespace flbc {

//! What the last of some iterations did.
struct Step {
  double change = 0;  //!< squared change of all weights or gradients
  //! Squared violation of the constraints that couple the copies, in the metric of the iteration;
  //! -1 where it was not measured.
  double violation = -1;
  //! The paper's norms of r_p and r_d divided by their number of components; -1 where they were not
  //! measured.
  double primal = -1, dual = -1;
};

//! Weights as an iteration holds them: all of them, or those on its active set.
struct Weights {
  WeightMatrix dense{};    //!< n x V, empty if they are sparse
  SparseWeights sparse{};  //!< of V points

  bool is_sparse() const { return sparse.num_points() > 0; }

  //! All of them, n x V.
  WeightMatrix to_dense() && { return is_sparse() ? sparse.dense() : std::move(dense); }
};

//! An iteration and its state. Boundary values of the weights are exact; interior columns sum to
//! one and reproduce their points up to the iteration's precision, and may be negative.
template <int Dim>
class Iteration {
 public:
  virtual ~Iteration() = default;

  //! Begins anew from weights and duals, or cold. Must be called once before iterate().
  virtual void start(const Start<Dim>& start) = 0;

  //! Iterates `count` >= 1 times. \param measure  whether the last step needs its residuals
  virtual Step iterate(int count, bool measure) = 0;

  virtual Weights weights() const = 0;

  //! Writes the weights of an interior vertex: n numbers.
  virtual void read_weights(Index vertex, double* weights) const = 0;

  //! Where another iteration can start: views, valid until the next call of iterate() or adapt().
  //! Cold for an iteration that no other starts from.
  virtual Start<Dim> state() const { return {}; }

  //! Whether its duals are complete, so that certify() proves something.
  virtual bool is_certifiable() const { return true; }

  //! Certificate of weights (n x V) by the present duals.
  virtual Certificate certify(const WeightMatrix& weights) const = 0;

  //! Lets the iteration change its precision, its penalty, or the pairs it works on.
  //! \param made  iterations of the run \param error  estimated mean squared error of the weights
  //! \param ends  whether the run is about to end because of it
  //! \return iterations to make before the run may end; 0 for none
  virtual int adapt(int /*made*/, double /*error*/, bool /*ends*/) { return 0; }

  //! Fills in the penalty, the size of the state, and the active set.
  virtual void describe(SolveReport& report) const = 0;
};

}  // namespace flbc
