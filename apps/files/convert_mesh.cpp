// SPDX-License-Identifier: BSD-3-Clause
#include "files/convert_mesh.h"

#include <iostream>
#include <variant>

#include "files/held_signals.h"
#include "files/load.h"
#include "files/mesh_file.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"

namespace flbc::app {
namespace {

using AnyMesh = std::variant<io::Model, FieldMesh<2>, FieldMesh<3>>;

template <int Dim>
FieldMesh<Dim> load_domain(const std::string& path) {
  FieldMesh<Dim> mesh;
  mesh.mesh = io::read_domain<Dim>(path, mesh.fields);
  return mesh;
}

// Only the cells of a .vtu file tell its dimension.
AnyMesh load_grid(const std::string& path) {
  try {
    return load_domain<2>(path);
  } catch (const InputError& no_triangles) {
    try {
      return load_domain<3>(path);
    } catch (const InputError& no_tetrahedra) {
      throw InputError(path + ": neither a 2D mesh (" + no_triangles.what() + ") nor a 3D one (" +
                       no_tetrahedra.what() + ")");
    }
  }
}

AnyMesh load_mesh(const std::string& path) {
  if (is_model_file(path)) return io::ModelFile(path).model();
  if (is_tetrahedra_file(path)) return load_domain<3>(path);
  if (is_mesh_file(path)) return load_grid(path);
  throw OptionError(path + ": cannot tell the format of this mesh");
}

Eigen::Index num_vertices(const io::Model& model) {
  return static_cast<Eigen::Index>(model.soup.points.size());
}
template <int Dim>
Eigen::Index num_vertices(const FieldMesh<Dim>& mesh) {
  return mesh.mesh.num_vertices();
}

// A 2D mesh may be a model file, but other formats of meshes of the interior want one.
void refuse_other_kinds(const AnyMesh& mesh, const std::string& input, const std::string& output) {
  if (std::holds_alternative<FieldMesh<3>>(mesh)) {
    if (!is_model_file(output)) return;
    throw OptionError(output + ": " + input +
                      " holds tetrahedra, so that the result must end in .mesh, .node, .ele, .msh "
                      "or .vtu");
  }
  if (!is_tetrahedra_file(output)) return;
  throw OptionError(output + ": " + input +
                    " holds no tetrahedra, so that the result must end in .obj, .off, .ply, .stl, "
                    ".om or .vtu");
}

}  // namespace

Index count_vertices(const std::string& path) {
  return std::visit([](const auto& mesh) { return static_cast<Index>(num_vertices(mesh)); },
                    load_mesh(path));
}

void convert_mesh(const std::string& input, const std::string& output, bool quiet) {
  auto mesh = load_mesh(input);
  refuse_other_kinds(mesh, input, output);
  auto lost = std::visit([&](const auto& any) { return find_losses(any, output); }, mesh);
  const bool becomes_domain = std::holds_alternative<io::Model>(mesh) && !is_model_file(output);
  if (becomes_domain) mesh = load_domain<2>(input);
  {
    const HeldSignals held;
    std::visit([&](const auto& any) { naming(input, [&] { save(output, any); }); }, mesh);
  }
  if (quiet) return;
  const auto count = std::visit([](const auto& any) { return num_vertices(any); }, mesh);
  std::cerr << output << ": " << count << " vertices\n";
  print_losses(input, output, lost);
}

}  // namespace flbc::app
