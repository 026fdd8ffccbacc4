// SPDX-License-Identifier: BSD-3-Clause
// Moves the points of one rank of an OpenFOAM mesh with a cage.
#pragma once

#include <functional>
#include <vector>

#include "boolList.H"
#include "dictionary.H"
#include "pointField.H"
#include "polyMesh.H"

namespace flbc::foam {

//! A pose of the cage at a time, in seconds.
struct TimedPose {
  Foam::scalar time;
  Foam::fileName file;
};

//! Poses of a cage as displacements of the points of one rank. Points outside the cage
//! (OutsidePoints::kKeep) and points of fixed patches keep their exact positions. A displacement
//! depends only on the position of the point, so ranks that share a point compute bit-identical
//! positions.
class CageDeformer {
 public:
  //! Reads the files and places the points. The entries of the dictionary:
  //!  - binding: a .npz file with a domain mesh, relative to the case
  //!  - joint (optional): smooth or curvature; the deformation then ends smoothly where facets cut
  //!    through the mesh (Binding::joined())
  //!  - jointMass (optional): Joint::mass
  //!  - fixedPatches (optional): patches that do not move
  //! Exits with a FatalError if a file is unusable, a pose does not have the vertices of the cage
  //! in their order, or it moves control points of facets that cut through the mesh.
  //! \param points  of the mesh at rest
  //! \param poses  at least one, ascending times
  CageDeformer(const Foam::polyMesh& mesh, const Foam::pointField& points,
               const Foam::dictionary& dict, std::vector<TimedPose> poses);

  //! The positions at a time, by linear interpolation between the poses. Reports quality, and exits
  //! with a FatalError if cells are inverted.
  Foam::tmp<Foam::pointField> positions(Foam::scalar time) const;

 private:
  void check_quality(const Foam::pointField& points, Foam::scalar time) const;

  const Foam::polyMesh& mesh_;
  const Foam::pointField& rest_;
  std::vector<TimedPose> poses_;
  Foam::boolList is_fixed_;
  //! Moves points to a part in [0, 1] of the way from a pose to the next one.
  std::function<void(Foam::pointField&, std::size_t pose, double part)> add_to_;
};

}  // namespace flbc::foam
