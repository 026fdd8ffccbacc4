// SPDX-License-Identifier: BSD-3-Clause
// The pictures of flbc compare: a panel for each kind of coordinates.
#include <algorithm>

#include "compare/comparison.h"
#include "draw/canvas.h"
#include "draw/model_picture.h"
#include "draw/plane_picture.h"
#include "flbc/deform.h"
#include "front/model_page.h"

namespace flbc::app {
namespace {

draw::WeightPictureOptions options_of(const CompareArguments& arguments) {
  draw::WeightPictureOptions options;
  options.width = 1800;
  options.format = draw::picture_format("picture." + arguments.pictures);
  return options;
}

// \param posed  in the pose instead of one function
std::string grid(const Comparison<2>& all, bool posed) {
  const auto rest = std::make_shared<const draw::DrawnShape>(
      draw::DrawnShape{all.cage.points, all.domain.points});
  std::vector<draw::PlanePanel> panels;
  for (const auto* column : all.succeeded()) {
    if (posed) {
      const draw::DrawnShape pose{all.pose, column->moved(all.pose)};
      panels.push_back({column->title, std::make_shared<const draw::DrawnShape>(pose)});
    } else {
      panels.push_back({column->title, rest, column->of_mesh.of_control_point(all.control_point),
                        all.control_point});
    }
  }
  const auto triangles =
      posed ? gltf::triangles_of_points(all.shape.surface) : CellList<2>(all.domain.cells);
  return draw::draw_panels(all.cage.facets, triangles, panels, all.shape.points,
                           options_of(all.arguments));
}

// The poses are colored by how far they are from rest, relative to the farthest of all.
std::string grid(const Comparison<3>& all, bool posed) {
  const auto rest =
      std::make_shared<const draw::ModelPlace>(draw::ModelPlace{all.cage.points, all.points()});
  std::vector<draw::ModelPanel> panels;
  double farthest = 0;
  for (const auto* column : all.succeeded()) {
    if (posed) {
      const draw::ModelPlace pose{all.pose, column->moved(all.pose)};
      const Eigen::VectorXd lengths = displacements<3>(all.points(), pose.points);
      farthest = std::max(farthest, lengths.maxCoeff());
      panels.push_back({column->title, std::make_shared<const draw::ModelPlace>(pose), lengths});
    } else {
      panels.push_back({column->title, rest, column->rows.of_control_point(all.control_point),
                        all.control_point});
    }
  }
  if (farthest > 0) {  // in poses
    for (auto& panel : panels) panel.values /= farthest;
  }
  return draw::draw_panels(
      {gltf::triangles_of_points(all.shape.surface), load_shown_cage<3>(all.arguments.cage).edges},
      panels, draw::view_of(all.arguments.up, all.points()), options_of(all.arguments));
}

}  // namespace

std::vector<std::string> names_of_grids(const CompareArguments& arguments) {
  return {"functions." + arguments.pictures, "poses." + arguments.pictures};
}

template <int Dim>
std::vector<std::string> draw_grids(Comparison<Dim>& all) {
  std::vector<Pose<Dim>> poses;
  if (all.pose.cols() > 0) poses.push_back({all.arguments.pose, 0, all.pose});
  const Index given = all.arguments.control_point;
  all.control_point =
      given >= 0 ? given
                 : main_control_point(all.succeeded().front()->rows, all.cage.points, poses);
  std::vector<std::string> drawn;
  if (!draw::can_draw()) return drawn;
  const auto names = names_of_grids(all.arguments);
  const bool has_surface = all.shape.surface.triangles.cols() > 0;
  // On the boundary of a mesh in 3D, all functions are the same.
  const bool shows_functions = Dim == 2 || (has_surface && !all.arguments.model.empty());
  const auto draw = [&](const std::string& name, const char* what, bool posed) {
    all.folder.add_text(name, what, grid(all, posed));
    drawn.push_back(name);
  };
  if (shows_functions) draw(names[0], "one coordinate function", false);
  if (all.pose.cols() > 0 && has_surface)
    draw(names[1], "the pose; in 3D, colors show displacements", true);
  return drawn;
}

template std::vector<std::string> draw_grids(Comparison<2>&);
template std::vector<std::string> draw_grids(Comparison<3>&);

}  // namespace flbc::app
