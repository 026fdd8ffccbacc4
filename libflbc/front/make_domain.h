// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshes a cage as the command line says.
#pragma once

#include <string>

#include "flbc/make_domain.h"

namespace flbc::app {

//! Who makes meshes, and for how long.
struct MesherSettings {
  //! One of NamedMesher, or "auto": CGAL in 2D; in 3D TetGen, and Netgen for cages on which that
  //! fails.
  std::string mesher = "auto";
  double timeout = 60;  //!< seconds that a run may take in 3D
};

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

//! \throws OptionError if the program was built without the mesher, or it is none for this
//! dimension; InputError if the cage cannot be meshed
template <int Dim>
MadeDomain<Dim> make_domain(const DomainRequest<Dim>& request);

}  // namespace flbc::app
