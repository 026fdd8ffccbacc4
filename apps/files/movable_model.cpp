// SPDX-License-Identifier: BSD-3-Clause
#include "files/movable_model.h"

#include <algorithm>

#include "draw/colormap.h"
#include "files/domain_formats.h"
#include "files/load.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"

namespace flbc::app {
namespace {

const char* const kField = "displacement";

bool has_extension(const std::string& path, std::initializer_list<const char*> extensions) {
  return std::find(extensions.begin(), extensions.end(), io::extension_of(path)) !=
         extensions.end();
}

// Weights were computed for the vertices that load_model() finds.
void require_same_vertices([[maybe_unused]] const std::string& path,
                           [[maybe_unused]] const io::PolygonSoup& soup) {
#ifdef FLBC_WITH_OPENMESH
  if (!has_extension(path, {"stl"})) return;
  const auto other = load_polygons(path);
  if (other.points == soup.points) return;
  throw InputError(path + ": its corners make " + std::to_string(soup.points.size()) +
                   " vertices, but OpenMesh, through which flbc solve reads it, finds " +
                   std::to_string(other.points.size()) +
                   " or places them otherwise; flbc convert makes a .ply or .obj file of it for "
                   "both commands");
#endif
}

PointList<3> colors_of(const Eigen::VectorXd& lengths, double largest) {
  PointList<3> colors(3, lengths.size());
  for (Eigen::Index v = 0; v < lengths.size(); ++v) {
    const auto color = draw::weight_color(largest > 0 ? lengths[v] / largest : 0);
    colors.col(v) << color.r, color.g, color.b;
  }
  return colors;
}

void set_field(std::vector<io::VertexField>& fields, const Eigen::VectorXd& values) {
  const auto old = std::find_if(fields.begin(), fields.end(),
                                [](const auto& field) { return field.name == kField; });
  if (old != fields.end()) fields.erase(old);
  fields.push_back({kField, values});
}

}  // namespace

void require_formats(const MovedFile& file) {
  if (!is_mesh_file(file.model)) {
    throw OptionError(file.model +
                      ": cannot tell the format; a model ends in .obj, .off, .ply, .stl or .om, a "
                      "domain mesh in .vtu, .mesh, .node, .ele or .msh");
  }
  require_mesh_writable(file.output);
  if (file.shows_displacement && has_extension(file.output, {"stl", "node", "ele", "msh"})) {
    throw OptionError(file.output +
                      ": cannot show displacements, for this format has neither colours nor "
                      "fields; .obj, .off, .ply, .om, .vtu and .mesh have");
  }
}

template <int Dim>
void require_formats_of(const MovedFile& file) {
  const auto& [model, output, shows] = file;
  if (Dim == 2 && is_tetrahedra_file(model)) {
    throw OptionError(model + ": holds tetrahedra, but the cage is in 2D");
  }
  if (is_model_file(model)) {
    const bool is_mesh = Dim == 2 && has_extension(model, {"obj", "off"});
    if (is_model_file(output) || (is_mesh && has_extension(output, {"vtu"}))) return;
    throw OptionError(output + ": " + model +
                      " holds polygons, so that the result must end in .obj, .off, .ply, .stl or "
                      ".om" +
                      (is_mesh ? ", or in .vtu" : ""));
  }
  if (Dim == 2 && is_model_file(output)) return;
  require_domain_writable<Dim>(output);
}

std::vector<std::string> files_of_model(const std::string& path) {
  const auto extension = io::extension_of(path);
  const auto stem = path.substr(0, path.size() - extension.size());
  if (has_extension(path, {"node", "ele"})) return {path, stem + "node", stem + "ele"};
  if (has_extension(path, {"mesh"})) return {path, stem + "sol"};
  return {path};
}

template <int Dim>
MovableModel<Dim>::MovableModel(const MovedFile& file)
    : shows_displacement_(file.shows_displacement) {
  const auto& [path, output, shows] = file;
  if (is_model_file(path)) {
    model_ = std::make_unique<io::ModelFile>(path);
    auto model = model_->model();
    points_ = io::to_points<Dim>(model.soup, path);
    require_same_vertices(path, model.soup);
    is_rewritten_ = io::extension_of(path) == io::extension_of(output) && !shows;
    if (is_rewritten_) return;
    const bool replaces_colors = shows && model.attributes.colors.cols() > 0;
    if (replaces_colors) model.attributes.colors.resize(3, 0);
    losses_ = find_losses(model, output);
    if (replaces_colors) losses_.emplace_back("colours (they show the displacement)");
  }
  if (model_ && is_model_file(output)) return;
  model_.reset();
  mesh_.mesh = io::read_domain<Dim>(path, mesh_.fields);
  points_ = mesh_.mesh.points;
  const auto lost_fields = find_losses(mesh_, output);
  losses_.insert(losses_.end(), lost_fields.begin(), lost_fields.end());
}

template <int Dim>
void MovableModel<Dim>::write_model(const std::string& path, const PointList<Dim>& points,
                                    const Eigen::VectorXd& lengths, double largest) const {
  if (is_rewritten_) {
    return io::write_file(path, [&](std::ostream& file) { model_->write(file, points); });
  }
  auto model = model_->moved(points);
  if (shows_displacement_) model.attributes.colors = colors_of(lengths, largest);
  save(path, model);
}

template <int Dim>
void MovableModel<Dim>::write(const std::string& path, const PointList<Dim>& points,
                              const Eigen::VectorXd& lengths, double largest) const {
  if (model_) return write_model(path, points, lengths, largest);
  FieldMesh<Dim> moved{{points, mesh_.mesh.cells}, mesh_.fields};
  if constexpr (Dim == 2) {
    if (is_model_file(path)) {
      auto model = to_model(moved.mesh);
      if (shows_displacement_) model.attributes.colors = colors_of(lengths, largest);
      return save(path, model);
    }
  }
  if (shows_displacement_) set_field(moved.fields, lengths);
  save(path, moved);
}

template void require_formats_of<2>(const MovedFile&);
template void require_formats_of<3>(const MovedFile&);
template class MovableModel<2>;
template class MovableModel<3>;

}  // namespace flbc::app
