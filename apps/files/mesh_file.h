// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Models and meshes of the interior in every format that can be written, and what is lost there.
#pragma once

#include <string>
#include <vector>

#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"

namespace flbc::app {

//! A mesh of the interior with what is known at its vertices.
template <int Dim>
struct FieldMesh {
  DomainMesh<Dim> mesh{};
  std::vector<io::VertexField> fields{};
};

//! By the extension: polygons with attributes, in 2D maybe a mesh of the interior.
bool is_model_file(const std::string& path);
//! By the extension: tetrahedra. .vtu files, of either dimension, are neither.
bool is_tetrahedra_file(const std::string& path);
//! Either, or .vtu.
bool is_mesh_file(const std::string& path);

//! In a plane, triangles are a surface too.
io::Model to_model(const DomainMesh<2>& mesh);

//! \throws OptionError if no mesh can be written to such a file; IoError as require_writable()
void require_mesh_writable(const std::string& path);

//! What the file would not keep, a phrase each.
std::vector<std::string> find_losses(const io::Model& model, const std::string& path);
std::vector<std::string> find_losses(const FieldMesh<2>& mesh, const std::string& path);
std::vector<std::string> find_losses(const FieldMesh<3>& mesh, const std::string& path);

//! Write by extension. What find_losses() tells is left out.
//! \throws OptionError if the format is for another kind of mesh; IoError; InputError
void save(const std::string& path, const io::Model& model);
void save(const std::string& path, const FieldMesh<2>& mesh);
void save(const std::string& path, const FieldMesh<3>& mesh);

//! Tells on standard error what `output` does not keep of `input`; nothing if there is nothing.
void print_losses(const std::string& input, const std::string& output,
                  const std::vector<std::string>& losses);

}  // namespace flbc::app
