// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "front/facts.h"
#include "front/model_page.h"
#include "front/page.h"
#include "run/steps.h"

namespace flbc::app {

template <int Dim>
view::ShownCage<Dim> shown_cage(const Run<Dim>& run) {
  if (run.cage_file != nullptr) {
    return cage_as_shown<Dim>(*run.cage_file, run.arguments.settings.cage);
  }
  return {run.cage.points, run.cage.facets, view::edges_of_cage<Dim>({}, run.cage.facets)};
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
