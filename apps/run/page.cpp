// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <sstream>
#include <string>

#include "flbc/io/files.h"
#include "front/base64.h"
#include "front/facts.h"
#include "front/model_page.h"
#include "front/page.h"
#include "model/gltf_document.h"
#include "run/steps.h"

namespace flbc::app {

template <int Dim>
view::ShownCage<Dim> shown_cage(const Run<Dim>& run) {
  if (run.cage_file != nullptr) {
    return cage_as_shown<Dim>(*run.cage_file, run.arguments.settings.cage);
  }
  return {run.cage.points, run.cage.facets, view::edges_of_cage<Dim>({}, run.cage.facets)};
}

// Spreads the drawing or picture that moves with the mesh over it. A drawing around both leaves the
// mesh outside of them transparent.
template <int Dim>
void show_follower(const Run<Dim>& run, view::PageContent<Dim>& content) {
  if constexpr (Dim == 2) {
    const auto& [files, poses, animation, shape, follower, picture] = run.inputs;
    const auto* drawing = follower ? follower->drawing() : nullptr;
    if (drawing == nullptr && !picture) return;
    const auto& file = run.arguments.follower;
    const auto bytes = io::read_file(file);
    const auto type = drawing != nullptr ? "image/svg+xml" : io::media_type_of(bytes);
    Vector<2> page(0, 0);
    if (drawing != nullptr) page = drawing->page();
    if (picture) page << picture->width, picture->height;
    const double bottom = drawing != nullptr ? drawing->to_model().translation().y() : page.y();
    const Vector<2> low = content.points.rowwise().minCoeff();
    const Vector<2> high = content.points.rowwise().maxCoeff(), size = high - low;
    constexpr double kPixels = 2048;
    const Vector<2> pixels = kPixels / size.maxCoeff() * size;
    std::ostringstream around;
    around << R"(<svg xmlns="http://www.w3.org/2000/svg" width=")" << pixels.x() << R"(" height=")"
           << pixels.y() << R"(" viewBox=")" << low.x() << ' ' << bottom - high.y() << ' '
           << size.x() << ' ' << size.y() << R"("><image width=")" << page.x() << R"(" height=")"
           << page.y() << R"(" href="data:)" << type << ";base64," << draw::to_base64(bytes)
           << R"("/></svg>)";
    content.title = std::filesystem::path(file).stem().string();
    content.picture = "data:image/svg+xml;base64," + draw::to_base64(around.str());
    auto& coordinates = content.surface.texture_coordinates;
    coordinates = content.points(Eigen::all, content.surface.sources);
    coordinates = (coordinates.colwise() - low).array().colwise() / size.array();
    coordinates.row(1) = 1 - coordinates.row(1).array();
  }
}

template <int Dim>
void write_page(Run<Dim>& run) {
  const auto& shape = run.shape();
  const auto& model = run.arguments.settings.model;
  view::PageContent<Dim> content;
  content.title = shape.name;
  const auto path = run.folder.path_of(kPage);
  content.model_file = run.has_model() ? path_beside(path, model)
                                       : run.report["mesh"]["file"].template get<std::string>();
  content.weights_file = kSparseWeights;
  const auto& cage = run.arguments.settings.cage;
  content.cage_file = run.arguments.makes_cage ? cage : path_beside(path, cage);
  content.cage = shown_cage(run);
  content.points = shape.points;
  content.surface = shape.surface;
  show_follower(run, content);
  look_from_front(content, run.arguments.up);
  content.weights = view::limit_influences(run.reduced, view::kMostInfluences);
  content.poses = shown_poses(run.poses());
  const auto page = view::make_page(content);
  run.report["page"] = {{"file", kPage}, {"bytes", page.size()}};
  Facts facts;
  facts << "a page to move the cage in; " << static_cast<double>(page.size()) / 1e6 << " MB";
  run.folder.add_text(kPage, facts.text(), page);
}

template view::ShownCage<2> shown_cage(const Run<2>&);
template view::ShownCage<3> shown_cage(const Run<3>&);
template void write_page(Run<2>&);
template void write_page(Run<3>&);

}  // namespace flbc::app
