// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Penalties as the literature states them.
#pragma once

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/options.h"

namespace flbc {

//! A penalty as publications state it, in the unit of SolverOptions::penalty. They mean it for a
//! domain scaled such that its farthest vertex lies at radius 250: 10 for Method::kLbc2014 (Zhang
//! et al. 2014), 100 in 2D and 10000 in 3D for Method::kPaper (section 5 of the paper).
//!
//! \param cage  n control points, in any unit of length
//! \param mesh  of its interior, in the same unit
//! \param method  whose penalty it is: they differ in how a penalty grows with lengths
//! \param penalty  as published, > 0
//! \throws OptionError unless it is positive and finite
template <int Dim>
double published_penalty(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, Method method,
                         double penalty);

}  // namespace flbc
