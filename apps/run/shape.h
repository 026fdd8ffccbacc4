// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The shape that moves with the cage: a model, or the mesh of the interior.
#pragma once

#include <memory>
#include <string>

#include "files/movable_model.h"
#include "flbc/domain_mesh.h"
#include "gltf/surface.h"

namespace flbc::app {

//! A model or mesh as the steps of flbc run need it.
template <int Dim>
struct Shape {
  std::string name;                           //!< in glTF
  std::string extension;                      //!< of its file, with the dot
  PointList<Dim> points{};                    //!< Dim x P
  EdgeList edges{};                           //!< between them; empty for a mere set of points
  gltf::Surface surface{};                    //!< without triangles if there are none
  std::unique_ptr<MovableModel<Dim>> file{};  //!< the model's; null for the mesh
};

//! A model's file. \throws IoError, InputError, OptionError
template <int Dim>
Shape<Dim> load_shape(const std::string& path);

//! A mesh of the interior.
template <int Dim>
Shape<Dim> shape_of(const DomainMesh<Dim>& domain);

//! The format in which flbc run writes meshes of the interior.
template <int Dim>
constexpr const char* domain_extension() {
  return Dim == 2 ? ".obj" : ".mesh";
}

}  // namespace flbc::app
