// SPDX-License-Identifier: BSD-3-Clause
#include "front/movable_model.h"

#include <algorithm>
#include <iostream>

#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "front/colormap.h"
#include "front/facts.h"
#include "front/load.h"

namespace flbc::app {
namespace {

using io::Content;
using io::holds;

constexpr std::initializer_list<Content> kShowing = {Content::kColors, Content::kFields};

bool is_model_file(const std::string& path) {
  return holds(path, {Content::kModel});
}

// .vtu files may be of either dimension.
bool is_tetrahedra_file(const std::string& path) {
  return holds(path, {Content::kMesh3D}) && !holds(path, {Content::kMesh2D});
}

bool is_rewritten(const MovedFile& file) {
  return is_model_file(file.model) && !file.shows_displacement && !file.is_anew &&
         io::extension_of(file.model) == io::extension_of(file.output);
}

PointList<3> colors_of(const Eigen::VectorXd& lengths, double largest) {
  PointList<3> colors(3, lengths.size());
  for (Eigen::Index v = 0; v < lengths.size(); ++v) {
    const auto color = draw::weight_color(largest > 0 ? lengths[v] / largest : 0);
    colors.col(v) << color.r, color.g, color.b;
  }
  return colors;
}

}  // namespace

void require_mesh_readable(const std::string& path) {
  if (holds(path, kMeshFiles)) return;
  throw OptionError(path + ": unknown file format; a model or mesh must end in " +
                    io::extensions_of(kMeshFiles) + io::conversion_hint(path));
}

void require_formats(const MovedFile& file) {
  if (moves_drawing(file)) return require_writable(file.output, "svg");
  require_mesh_readable(file.model);
  require_writable(file.output, kMeshFiles);
  if (file.shows_displacement && !holds(file.output, kShowing)) {
    throw OptionError(file.output +
                      ": cannot show displacements, because this format has neither colors nor "
                      "fields; choose from " +
                      io::extensions_of(kShowing));
  }
}

bool moves_splats(const MovedFile& file) {
  return is_rewritten(file) && io::is_splat_file(file.model);
}

bool moves_drawing(const MovedFile& file) {
  const auto is_drawing = [](const std::string& path) { return io::extension_of(path) == "svg"; };
  return is_drawing(file.model) && is_drawing(file.output) && !file.shows_displacement;
}

template <int Dim>
void require_formats_of(const MovedFile& file) {
  if (moves_drawing(file)) return;
  const auto& [model, output, shows, is_anew] = file;
  if (Dim == 2 && is_tetrahedra_file(model)) {
    throw OptionError(model + ": holds tetrahedra, but the cage is in 2D");
  }
  const bool is_model = is_model_file(model);
  const bool is_mesh = holds(model, {io::kMesh<Dim>});
  if (is_mesh && holds(output, {io::kMesh<Dim>})) return;
  if ((is_model || Dim == 2) && is_model_file(output)) return;
  const char* const held = !is_model                    ? " holds tetrahedra"
                           : is_tetrahedra_file(output) ? " holds no tetrahedra"
                                                        : " holds polygons";
  throw OptionError(
      output + ": " + model + (Dim == 2 && !is_model ? " holds triangles" : held) +
      "; the result must end in " +
      (is_model ? io::extensions_of({Content::kModel}) : io::extensions_of({io::kMesh<Dim>})) +
      (is_mesh && is_model ? ", or in .vtu" : ""));
}

template <int Dim>
MovableModel<Dim>::MovableModel(MovedFile file) : file_(std::move(file)) {
  read();
  if (points().cols() == 0) throw InputError(file_.model + ": the model has no vertices");
}

template <int Dim>
const PointList<Dim>& MovableModel<Dim>::points() const {
  if constexpr (Dim == 2) {
    if (drawing_) return drawing_->points();
  }
  return points_;
}

template <int Dim>
void MovableModel<Dim>::read() {
  const auto& path = file_.model;
  if (moves_splats(file_)) {
    if constexpr (Dim == 2) {
      throw InputError(path + ": Gaussian splats need a cage in 3D");
    } else {
      points_ = splats_.emplace(path).points();
      return;
    }
  }
  if (moves_drawing(file_)) {
    if constexpr (Dim == 3) {
      throw InputError(path + ": a drawing needs a cage in 2D");
    } else {
      drawing_.emplace(io::read_drawing(path));
      return;
    }
  }
  if (is_point_file(path)) {
    points_ = load_points<Dim>(path);
    return;
  }
  if (is_model_file(path)) {
    model_.emplace(path);
    for (const auto& note : model_->model().notes)
      std::cerr << "flbc: " << path << ": " << note << '\n';
    if (!is_rewritten(file_) || model_->model().gltf) find_losses(model_->model());
    if (is_model_file(file_.output)) {
      points_ = io::to_points<Dim>(model_->model().soup, path);
      return;
    }
    model_.reset();
  }
  mesh_ = io::read_domain<Dim>(path);
  points_ = mesh_.points;
  if (Dim == 2 && !holds(file_.output, {Content::kFields})) find_losses({io::to_polygons(mesh_)});
}

template <int Dim>
void MovableModel<Dim>::find_losses(io::Model model) {
  const bool replaces_colors = file_.shows_displacement && model.attributes.colors.cols() > 0;
  if (replaces_colors) model.attributes.colors.resize(3, 0);
  if (file_.shows_displacement) model.gltf.reset();
  const auto lost = io::losses(model, file_.output);
  losses_.insert(losses_.end(), lost.begin(), lost.end());
  if (replaces_colors) losses_.emplace_back("colors (they show the displacement)");
}

template <int Dim>
EdgeList MovableModel<Dim>::edges() const {
  if (!model_) return edges_of_cells(mesh_);
  const auto& soup = model()->soup;
  return naming(file_.model,
                [&] { return edges_of_polygons(points_, soup.polygons, soup.polylines); });
}

template <int Dim>
gltf::Surface MovableModel<Dim>::surface() const {
  return naming(file_.model, [&] {
    if (model_) return gltf::surface_of_model<Dim>(*model());
    return gltf::surface_of_model<Dim>({io::to_polygons(mesh_)});
  });
}

template <int Dim>
void MovableModel<Dim>::print_losses() const {
  if (drawing_ && !drawing_->notes().empty()) {
    std::cerr << "flbc: " << file_.output
              << " keeps, but does not bend: " << joined(drawing_->notes()) << '\n';
  }
  if (losses_.empty()) return;
  std::cerr << "flbc: " << file_.output << " does not keep all of " << file_.model
            << "; lost: " << joined(losses_) << '\n';
}

template <int Dim>
void MovableModel<Dim>::write(const std::string& path, const PointList<Dim>& points,
                              const Eigen::VectorXd& lengths, double largest,
                              const Eigen::MatrixXd& jacobians) const {
  if constexpr (Dim == 3) {
    if (splats_) {
      return io::write_file(path,
                            [&](std::ostream& out) { splats_->write(out, points, jacobians); });
    }
  }
  if constexpr (Dim == 2) {
    if (drawing_) {
      return io::write_file(path, [&](std::ostream& out) { out << drawing_->moved(points); });
    }
  }
  if (is_point_file(file_.model)) return io::write_weights(path, points);
  if (model_ && is_rewritten(file_)) {
    return io::write_file(path, [&](std::ostream& out) { model_->write(out, points, jacobians); });
  }
  if (is_model_file(path)) {
    auto model = model_ ? model_->moved(points, jacobians)
                        : io::Model{io::to_polygons<Dim>({points, mesh_.cells})};
    if (file_.shows_displacement) {
      model.attributes.colors = colors_of(lengths, largest);
      model.gltf.reset();  // its document has other colors
    }
    return io::write_model(path, model);
  }
  std::vector<io::VertexField> fields;
  if (file_.shows_displacement) fields.push_back({"displacement", lengths});
  io::write_domain<Dim>(path, {points, mesh_.cells}, fields);
}

AnyModel load_any_model(const MovedFile& file) {
  const auto load = [&](auto dimension) {
    require_formats_of<dimension>(file);
    return MovableModel<dimension>(file);
  };
  constexpr std::integral_constant<int, 2> kPlane;
  constexpr std::integral_constant<int, 3> kSpace;
  const auto& path = file.model;
  if (is_tetrahedra_file(path)) return load(kSpace);
  if (is_model_file(path)) {
    if (holds(file.output, {Content::kMesh2D}) && !is_model_file(file.output)) return load(kPlane);
    return load(kSpace);
  }
  return MovableModel<2>(file);  // .vtu: refuses with the way out
}

template void require_formats_of<2>(const MovedFile&);
template void require_formats_of<3>(const MovedFile&);
template class MovableModel<2>;
template class MovableModel<3>;

}  // namespace flbc::app
