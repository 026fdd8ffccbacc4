// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The facet duals of the gradient ADMM as a potential of the flux.
#pragma once

#include "flbc/cell_locator.h"
#include "flbc/lbc_problem.h"
#include "solver/warm_start/mesh_state.h"

namespace flbc {

//! At an optimum the multipliers of a cell's facets balance its flux, A p = sum of mu u over its
//! facets, where u is tangential to the facet, and equal and opposite for its two cells. This is
//! Stokes' theorem for a potential psi, known at the middle of each facet of measure |f|. In 2D p /
//! A is the gradient of psi, turned by 90 degrees, and mu u = |f| psi t with the tangent t that
//! runs counter-clockwise round the first cell; in 3D p / A = curl psi and mu u = |f| N x psi with
//! the normal N that points out of the first cell. In 3D this leaves the normal component open,
//! which is taken from the constant vectors that fit the two cells best. \param multipliers  mu u
//! on the facet's first side \return n x (kPotentialSize E)
template <int Dim>
Eigen::MatrixXd flux_potential(const LbcProblem<Dim>& problem, const VectorsAt<Dim>& multipliers);

//! The potential anywhere: linear in a cell through its values in the middle of the facets.
//! \return n x kPotentialSize
template <int Dim>
Eigen::MatrixXd evaluate_potential(const LbcProblem<Dim>& problem, const Eigen::MatrixXd& potential,
                                   const Location<Dim>& place);

//! mu u on the first side of a facet in whose middle the potential is known (n x kPotentialSize).
template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> facet_multiplier(const LbcProblem<Dim>& problem,
                                                            Index facet,
                                                            const Eigen::MatrixXd& potential);

}  // namespace flbc
