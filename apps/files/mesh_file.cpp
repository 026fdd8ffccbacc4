// SPDX-License-Identifier: BSD-3-Clause
#include "files/mesh_file.h"

#include <algorithm>
#include <iostream>

#include "files/load.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#ifdef FLBC_WITH_OPENMESH
#include "flbc/openmesh/om_file.h"
#endif

namespace flbc::app {
namespace {

bool is_one_of(const std::string& path, std::initializer_list<const char*> extensions) {
  return std::find(extensions.begin(), extensions.end(), io::extension_of(path)) !=
         extensions.end();
}

std::vector<std::string> names_of(const std::vector<io::VertexField>& fields) {
  std::vector<std::string> names;
  for (const auto& field : fields) names.push_back("field \"" + field.name + "\"");
  return names;
}

// Of a 2D mesh in .vtu.
std::vector<std::string> attributes_of(const io::Model& model) {
  auto phrases = model.others;
  if (!model.soup.polylines.empty()) phrases.emplace_back("polylines");
  if (model.attributes.colors.cols() > 0) phrases.emplace_back("colours");
  if (model.attributes.normals.cols() > 0) phrases.emplace_back("normals");
  if (model.attributes.texture_coordinates.cols() > 0) phrases.emplace_back("texture coordinates");
  return phrases;
}

}  // namespace

bool is_model_file(const std::string& path) {
  return is_one_of(path, {"obj", "off", "ply", "stl", "om"});
}

bool is_tetrahedra_file(const std::string& path) {
  return is_one_of(path, {"mesh", "node", "ele", "msh"});
}

bool is_mesh_file(const std::string& path) {
  return is_model_file(path) || is_tetrahedra_file(path) || is_one_of(path, {"vtu"});
}

io::Model to_model(const DomainMesh<2>& mesh) {
  io::Model model;
  for (const auto& point : mesh.points.colwise()) {
    model.soup.points.emplace_back(point[0], point[1], 0.0);
  }
  for (const auto& cell : mesh.cells.colwise()) {
    model.soup.polygons.push_back({cell[0], cell[1], cell[2]});
  }
  return model;
}

void require_mesh_writable(const std::string& path) {
#ifndef FLBC_WITH_OPENMESH
  if (is_one_of(path, {"om"}))
    throw OptionError(path + ": this program was built without OpenMesh");
#endif
  require_writable(path, {"obj", "off", "ply", "stl", "om", "vtu", "mesh", "node", "ele", "msh"});
}

std::vector<std::string> find_losses(const io::Model& model, const std::string& path) {
  return is_model_file(path) ? io::losses(model, path) : attributes_of(model);
}

std::vector<std::string> find_losses(const FieldMesh<2>& mesh, const std::string& path) {
  if (!is_model_file(path)) return {};
  auto phrases = names_of(mesh.fields);
  const auto others = io::losses(to_model(mesh.mesh), path);
  phrases.insert(phrases.end(), others.begin(), others.end());
  return phrases;
}

std::vector<std::string> find_losses(const FieldMesh<3>& mesh, const std::string& path) {
  if (is_one_of(path, {"vtu", "mesh"})) return {};
  return names_of(mesh.fields);
}

void save(const std::string& path, const io::Model& model) {
#ifdef FLBC_WITH_OPENMESH
  if (is_one_of(path, {"om"})) return openmesh::write_om(path, model);
#endif
  io::write_model(path, model);
}

void save(const std::string& path, const FieldMesh<2>& mesh) {
  if (is_model_file(path)) return save(path, to_model(mesh.mesh));
  io::write_domain(path, mesh.mesh, mesh.fields);
}

void save(const std::string& path, const FieldMesh<3>& mesh) {
  const bool keeps_fields = is_one_of(path, {"vtu", "mesh"});
  io::write_domain(path, mesh.mesh, keeps_fields ? mesh.fields : std::vector<io::VertexField>());
}

void print_losses(const std::string& input, const std::string& output,
                  const std::vector<std::string>& losses) {
  if (losses.empty()) return;
  std::cerr << "flbc: " << output << " does not keep all of " << input << "; lost: ";
  for (std::size_t k = 0; k < losses.size(); ++k) std::cerr << (k > 0 ? ", " : "") << losses[k];
  std::cerr << '\n';
}

}  // namespace flbc::app
