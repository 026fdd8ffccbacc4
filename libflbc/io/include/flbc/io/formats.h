// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! File formats by extension.
#pragma once

#include <initializer_list>
#include <string>

namespace flbc::io {

//! Kinds of file content.
enum class Content {
  kModel,    //!< polygons and polylines: models and cages
  kMesh2D,   //!< triangles in the plane
  kMesh3D,   //!< tetrahedra
  kWeights,  //!< weight matrices
  kColors,   //!< vertex colors of a model
  kFields    //!< scalars at mesh vertices
};

//! Domain meshes in Dim dimensions.
template <int Dim>
constexpr Content kMesh = Dim == 2 ? Content::kMesh2D : Content::kMesh3D;

//! Whether the format of `path` can hold one of these kinds of content.
bool holds(const std::string& path, std::initializer_list<Content> contents);

//! The extensions of all such formats, such as ".obj, .off or .vtu".
std::string extensions_of(std::initializer_list<Content> contents);

//! How to get a model out of a file in a format of other programs, such as .fbx, as the end of a
//! message; empty for other extensions.
std::string conversion_hint(const std::string& path);

}  // namespace flbc::io
