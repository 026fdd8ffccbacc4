// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Small problems with optima that were found by other means (tests/data/references/README.md).
#pragma once

#include "support/test.h"

namespace flbc::testing {

//! A problem and its optima. Lengths are the file's own: make_problem() scales by
//! LbcProblem::scale, and with it all objectives, by scale^(Dim - 1); weights stay. Its phi is to
//! be replaced by this one, which is not made from geodesic distances.
template <int Dim>
struct ReferenceOptimum {
  struct Variant {
    double objective;      //!< sum_s sum_i phi_i^s A_s |grad w_i|_s
    double gap;            //!< relative: (objective - proven lower bound) / objective
    WeightMatrix weights;  //!< n x V, unique to about 1e-6
  };

  std::string name;
  Cage<Dim> cage;  //!< oriented outward
  DomainMesh<Dim> mesh;
  Eigen::MatrixXd phi;    //!< n x F, in [0, 1]
  Variant unconstrained;  //!< weights may be negative
  Variant non_negative;   //!< weights have to be >= 0
};

//! All of this dimension, by name.
//! \throws std::runtime_error naming the file if one is not as it should be, or if there is none
template <int Dim>
std::vector<ReferenceOptimum<Dim>> reference_optima();

}  // namespace flbc::testing
