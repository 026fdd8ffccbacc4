// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! All that the weights of a domain depend on.
#pragma once

#include <string>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/options.h"
#include "solve/mesher.h"

namespace flbc::app {

//! Where weights come from; meshes and points are kept by reference.
template <int Dim>
struct WeightOrigin {
  const Cage<Dim>& cage;
  const DomainMesh<Dim>* domain = nullptr;   //!< given; null: made from what follows
  const PointList<Dim>* embedded = nullptr;  //!< become vertices of the mesh; null for none
  Index vertices = 0;                        //!< wanted, 0 = as many as the program chooses
  bool can_mesh = true;                      //!< whether there is a mesher for coarser meshes
  double penalty = 0;                        //!< as published, 0 = by method
  SolverOptions options{};                   //!< but for the penalty
  Mesher mesher = Mesher::kAuto;             //!< asked for
};

//! Lines that can be read, then the bytes of all numbers of cage, domain and embedded points. Keys
//! of different origins differ, and so do those of different versions of the library. The number of
//! threads is not in it: it does not change the weights.
template <int Dim>
std::string key_of(const WeightOrigin<Dim>& origin);

//! The same with hashes in place of the bytes, and without max_iterations: what an iteration depends
//! on that stops and goes on.
template <int Dim>
std::string lines_of(const WeightOrigin<Dim>& origin);

}  // namespace flbc::app
