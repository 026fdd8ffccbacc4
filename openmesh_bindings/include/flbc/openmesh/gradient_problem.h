// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Constants of the GradientAdmm iteration, in the units of the mesh.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "flbc/lbc_problem.h"
#include "flbc/openmesh/domain.h"

namespace flbc {

template <int Dim>
class DirichletProblem;

}  // namespace flbc

namespace flbc::openmesh {

//! A vector per control point, a row of n numbers per coordinate.
template <class Scalar, int Dim>
using VectorRows = Eigen::Matrix<Scalar, Dim, Eigen::Dynamic, Eigen::RowMajor>;

//! If the boundary has several components, (8)-(10) do not determine one constant per control point
//! and additional component (docs/explanation/method/gradient_admm.md). One condition fixes each
//! constant: sum_s field_s . g_i(s) = values_i.
template <int Dim>
struct PeriodConstraint {
  PointList<Dim> field;       //!< Dim x F, with norm 1
  Eigen::RowVectorXd values;  //!< n
};

//! The minimization problem (7)-(11) of the paper for n control points and F cells.
template <class Scalar, int Dim>
struct GradientProblem {
  std::shared_ptr<const LbcProblem<Dim>> base;
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> radius;  //!< n x F, phi A
  Eigen::VectorXd quadratic;                                     //!< F, epsilon A
  //! Per facet, empty inside: tangential gradients h of (9).
  std::vector<VectorRows<Scalar, Dim>> slope;
  //! Per facet: projector onto its tangents.
  std::vector<Eigen::Matrix<Scalar, Dim, Dim>> projector;
  Eigen::Matrix<Scalar, Eigen::Dynamic, Dim + 1> basis;  //!< Q: orthonormal columns, span [1; c]
  Eigen::Matrix<Scalar, Dim, Dim + 1> target;            //!< g Q for every g that satisfies (8)
  std::vector<PeriodConstraint<Dim>> periods;
  double penalty;            //!< mu that needs few iterations, length^(Dim + 1)
  double published_penalty;  //!< mu of the paper, in the same unit
  double published_scale;    //!< length in the paper, where the radius is 250 / length of the mesh
  //! Of start and recovery; made on demand.
  mutable std::shared_ptr<const DirichletProblem<Dim>> poisson;
};

//! \param base  of the mesh \param topology  facets of the mesh
//! \throws SolverError
template <class Scalar, int Dim>
GradientProblem<Scalar, Dim> make_gradient_problem(std::shared_ptr<const LbcProblem<Dim>> base,
                                                   const MeshTopology<Dim>& topology);

constexpr int kSumBlocks = 64;  //!< blocks of for_blocks()

//! Calls body(block, begin, end) for kSumBlocks blocks of [0, count), in parallel. What is added up
//! per block, and then over the blocks, does not depend on the threads. Denormal numbers count as
//! 0, because they are slow.
void for_blocks(int count, const std::function<void(int block, int begin, int end)>& body);

namespace internal {

//! make_problem() in the units of the mesh.
//! \throws InputError if the mesh does not match the cage; SolverError
template <int Dim>
std::shared_ptr<const LbcProblem<Dim>> problem_on_mesh(const Cage<Dim>& cage, Domain<Dim> domain,
                                                       DistanceScheme phi, double smoothness);

//! Harmonic coordinates, n x V. \throws SolverError
template <class Scalar, int Dim>
WeightMatrix harmonic_weights(const GradientProblem<Scalar, Dim>& problem);

//! The weights whose gradients are nearest to the given ones, n x V. \throws SolverError
template <class Scalar, int Dim>
WeightMatrix nearest_weights(const GradientProblem<Scalar, Dim>& problem,
                             const CellFieldView<Scalar, Dim>& gradients);

}  // namespace internal

}  // namespace flbc::openmesh
