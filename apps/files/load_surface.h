// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Models and domain meshes as surfaces to be shown.
#pragma once

#include <string>

#include "gltf/surface.h"

namespace flbc::app {

//! The vertices of a file, and the surface between them.
template <int Dim>
struct SurfaceModel {
  PointList<Dim> points;  //!< Dim x P, all vertices in the order of the file
  gltf::Surface surface;
};

//! \throws OptionError before any work is done if the file's name has none of the extensions that
//! load_surface() reads
void require_surface_readable(const std::string& path);

//! Polygons of .obj, with all their attributes, .off, .ply and .stl; the triangles of a 2D mesh and
//! the boundary of a 3D one in .vtu, .mesh, .node, .ele and .msh files.
//! \throws IoError, InputError, OptionError
template <int Dim>
SurfaceModel<Dim> load_surface(const std::string& path);

}  // namespace flbc::app
