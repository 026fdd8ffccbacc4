// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Custom numbers of the vertices of a model file, such as a painted region.
#pragma once

#include <string>

#include <Eigen/Core>

namespace flbc::io {

//! Reads an attribute of a .ply, .glb, .vrm, or .gltf file: a property of the element "vertex", or
//! an attribute such as "_BELT". Where several vertices of a glTF file are one vertex of the model,
//! the largest number counts; vertices of meshes without it have 0.
//! \return a number for each vertex, in the order of ModelFile
//! \throws IoError; InputError naming the file if there is no such attribute
Eigen::VectorXd vertex_attribute(const std::string& path, const std::string& name);

}  // namespace flbc::io
