// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Constants of the GradientAdmm iteration, in the units of the mesh.
#pragma once

#include <functional>
#include <vector>

#include "flbc/lbc_problem.h"
#include "flbc/openmesh/domain.h"

namespace flbc::openmesh {

//! A vector per control point, a row of n numbers per coordinate.
template <int Dim>
using VectorRows = Eigen::Matrix<double, Dim, Eigen::Dynamic, Eigen::RowMajor>;

//! If the boundary has several components, (8)-(10) do not determine one constant per control point
//! and additional component (docs/explanation/method/gradient_admm.md). One condition fixes each
//! constant: sum_s field_s . g_i(s) = values_i.
template <int Dim>
struct PeriodConstraint {
  PointList<Dim> field;       //!< Dim x F, with norm 1
  Eigen::RowVectorXd values;  //!< n
};

//! The minimization problem (7)-(11) of the paper for n control points and F cells.
template <int Dim>
struct GradientProblem {
  LbcProblem<Dim> base;                //!< not scaled
  Eigen::MatrixXd radius;              //!< n x F, phi A
  Eigen::VectorXd quadratic;           //!< F, epsilon A
  std::vector<VectorRows<Dim>> slope;  //!< per facet, empty inside: tangential gradients h of (9)
  //! Per facet: projector onto its tangents.
  std::vector<Eigen::Matrix<double, Dim, Dim>> projector;
  Eigen::Matrix<double, Eigen::Dynamic, Dim + 1> basis;  //!< Q: orthonormal columns, span [1; c]
  Eigen::Matrix<double, Dim, Dim + 1> target;            //!< g Q for every g that satisfies (8)
  std::vector<PeriodConstraint<Dim>> periods;
  double penalty;          //!< mu that needs few iterations, length^(Dim + 1)
  double published_scale;  //!< length in the paper, where the radius is 250 / length of the mesh
};

//! \param domain  with the facets of the mesh
//! \throws InputError if the mesh does not match the cage; SolverError
template <int Dim>
GradientProblem<Dim> make_gradient_problem(const Cage<Dim>& cage, Domain<Dim> domain,
                                           DistanceScheme phi, double smoothness);

constexpr int kSumBlocks = 64;  //!< blocks of for_blocks()

//! Calls body(block, begin, end) for kSumBlocks blocks of [0, count), in parallel. What is added up
//! per block, and then over the blocks, does not depend on the threads.
void for_blocks(int count, const std::function<void(int block, int begin, int end)>& body);

}  // namespace flbc::openmesh
