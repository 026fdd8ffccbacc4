// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Converts penalties from the literature.
#pragma once

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/options.h"

namespace flbc {

//! Converts a published penalty to the unit of SolverOptions::penalty. Publications state penalties
//! for a domain whose farthest vertex lies at radius 250. They use 10 for Method::kLbc2014 (Zhang
//! et al. 2014), and 100 in 2D and 10000 in 3D for Method::kPaper (section 5 of the paper).
//!
//! \param cage  n control points, in any unit of length
//! \param mesh  domain mesh of the cage, in the same unit
//! \param method  method of the penalty; the scaling with length depends on it
//! \param penalty  as published, > 0
//! \throws OptionError if the penalty is not positive and finite
template <int Dim>
double published_penalty(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, Method method,
                         double penalty);

}  // namespace flbc
