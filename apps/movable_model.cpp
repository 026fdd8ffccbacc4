// SPDX-License-Identifier: BSD-3-Clause
#include "movable_model.h"

#include <algorithm>

#include "domain_formats.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "load.h"

namespace flbc::app {
namespace {

using Extensions = std::initializer_list<const char*>;
constexpr Extensions kTexts = {"obj", "off"};
constexpr Extensions kAll = {"obj", "off", "vtu", "mesh", "node", "ele", "msh"};

bool is_one_of(const std::string& extension, Extensions extensions) {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

bool is_rewritten(const std::string& model, const std::string& output) {
  const auto extension = io::extension_of(model);
  return is_one_of(extension, kTexts) && extension == io::extension_of(output);
}

}  // namespace

void require_formats(const std::string& model, const std::string& output) {
  if (!is_one_of(io::extension_of(model), kAll)) {
    throw OptionError(model +
                      ": only models in .obj and .off files can be moved without loss, and meshes "
                      "in .vtu, .mesh, .node, .ele and .msh files; convert it to one of them");
  }
  require_writable(output, kAll);
}

template <int Dim>
void require_formats_of(const std::string& model, const std::string& output) {
  if (is_rewritten(model, output)) return;
  const auto extension = io::extension_of(model);
  if (Dim == 3 && is_one_of(extension, kTexts)) {
    throw OptionError(output + ": " + model + " is a ." + extension +
                      " file, so that the result must be one too");
  }
  if (Dim == 2 && !is_one_of(extension, {"obj", "off", "vtu"})) {
    throw OptionError(model + ": holds tetrahedra, but the cage is in 2D");
  }
  require_domain_writable<Dim>(output);
}

std::vector<std::string> files_of_model(const std::string& path) {
  const auto extension = io::extension_of(path);
  const auto stem = path.substr(0, path.size() - extension.size());
  if (is_one_of(extension, {"node", "ele"})) return {path, stem + "node", stem + "ele"};
  if (extension == "mesh") return {path, stem + "sol"};
  return {path};
}

template <int Dim>
MovableModel<Dim>::MovableModel(const std::string& path, const std::string& output) {
  if (is_rewritten(path, output)) {
    text_ = std::make_unique<io::PolygonText>(path);
    points_ = io::to_points<Dim>(text_->soup(), path);
    return;
  }
  auto mesh = io::read_domain<Dim>(path, fields_);
  points_ = std::move(mesh.points);
  cells_ = std::move(mesh.cells);
}

template <int Dim>
void MovableModel<Dim>::write(const std::string& path, const PointList<Dim>& points) const {
  if (text_) {
    io::write_file(path, [&](std::ostream& file) { text_->write(file, points); });
  } else {
    io::write_domain(path, DomainMesh<Dim>{points, cells_}, fields_);
  }
}

template void require_formats_of<2>(const std::string&, const std::string&);
template void require_formats_of<3>(const std::string&, const std::string&);
template class MovableModel<2>;
template class MovableModel<3>;

}  // namespace flbc::app
