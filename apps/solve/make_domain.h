// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshing a cage with whatever mesher was built in.
#pragma once

#include <string>

#include "flbc/cage.h"
#include "flbc/meshing.h"

namespace flbc::app {

enum class Mesher {
  kAuto,  //!< CGAL in 2D; in 3D TetGen, and Netgen for cages on which that fails
  kCgal,
  kTetgen,
  kNetgen,
  kGiven  //!< none: the mesh was read from a file
};

//! Who makes meshes, and for how long.
struct MesherSettings {
  Mesher mesher = Mesher::kAuto;
  double timeout = 60;  //!< seconds that a run may take in 3D
};

inline const char* name_of(Mesher mesher) {
  constexpr const char* kNames[] = {"auto", "cgal", "tetgen", "netgen", "none"};
  return kNames[static_cast<int>(mesher)];
}

//! Number of mesh vertices if the user does not ask for one.
constexpr Index kDefaultVertices = 10000;

//! A mesh to be made. Files are named in messages.
template <int Dim>
struct DomainRequest {
  const Cage<Dim>& cage;
  std::string cage_file;
  Index vertices = 0;  //!< wanted, 0 = kDefaultVertices; where quality demands more, that
  MesherSettings meshing{};
  std::string embedded_file{};  //!< of the model whose points become vertices; empty for none
  PointList<Dim> embedded{};    //!< these points
};

//! A mesh that was made.
template <int Dim>
struct MadeDomain {
  DomainMesh<Dim> mesh{};
  Mesher mesher = Mesher::kAuto;  //!< that made it, or any part of it where the first one failed
  std::string note{};             //!< for the user: it is not quite as asked for, or made otherwise
};

//! \throws OptionError if the program was built without the mesher, or it is none for this
//! dimension; InputError if the cage cannot be meshed
template <int Dim>
MadeDomain<Dim> make_domain(const DomainRequest<Dim>& request);

}  // namespace flbc::app
