// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Starting from the solution on coarser meshes of the same cage: which ones, and who makes them.
//! solve() does it (solver.h); the types are here.
#pragma once

#include <functional>
#include <optional>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Makes a mesh of a cage's interior with about so many vertices, as triangulate() and
//! tetrahedralize() do (meshing.h). The cage is scaled; the mesh has to fill it as it is. With
//! several threads it is called from a thread of its own, by one at a time.
template <int Dim>
using CoarseMesher = std::function<DomainMesh<Dim>(const Cage<Dim>& cage, Index vertices)>;

//! Whether to start from coarser meshes.
enum class CoarseToFine {
  kAuto,  //!< where there is a mesher and it was measured to pay
  kOn,    //!< also on meshes so small that it costs more than it saves; needs a mesher
  kOff    //!< never
};

//! Which coarser meshes to use.
struct CoarseLevels {
  //! Fewest vertices of a coarse mesh, >= 1. By default 500 for CoarseToFine::kOn, else where it was
  //! measured to pay, which for small meshes means none at all.
  std::optional<Index> coarsest{};

  //! Vertices of a mesh relative to the next coarser one, >= 2. By default as it was measured to
  //! pay.
  std::optional<double> factor{};

  //! Tolerance on coarse meshes relative to the one wanted, > 0.
  double looseness = 4;
};

}  // namespace flbc
