// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A file's format by its extension.
#pragma once

#include <initializer_list>
#include <string>

namespace flbc::io {

//! Kinds of content of files.
enum class Content {
  kModel,     //!< polygons and polylines: models and cages
  kMesh2D,    //!< triangles in the plane
  kMesh3D,    //!< tetrahedra
  kWeights,   //!< weight matrices
  kTriplets,  //!< weights, a line each, without the size of their matrix
  kColors,    //!< colours of a model's vertices
  kFields     //!< scalars at a mesh's vertices
};

//! Meshes of the interior in Dim dimensions.
template <int Dim>
constexpr Content kMesh = Dim == 2 ? Content::kMesh2D : Content::kMesh3D;

//! Whether the format that `path` names has a place for one of these contents.
bool holds(const std::string& path, std::initializer_list<Content> contents);

//! The extensions of all such formats, as in ".obj, .off or .vtu".
std::string extensions_of(std::initializer_list<Content> contents);

}  // namespace flbc::io
