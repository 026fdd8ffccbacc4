// SPDX-License-Identifier: BSD-3-Clause
#include "run/steps.h"

#include <iostream>
#include <optional>

#include "flbc/deform.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/weights_io.h"
#include "flbc/quality.h"
#include "flbc/report.h"
#include "front/bound_model.h"
#include "front/facts.h"
#include "front/load.h"
#include "front/model_facets.h"
#include "front/poses.h"
#include "poses/outside.h"
#include "report/check_report.h"
#include "report/report_json.h"
#include "solve/progress_bar.h"

namespace flbc::app {

template <int Dim>
void deliver_cage(Run<Dim>& run) {
  if (!run.arguments.makes_cage) return;
  Facts facts;
  facts << run.cage.size() << " control points, " << run.cage.facets.cols()
        << (Dim == 2 ? " edges" : " triangles") << ", encloses the model";
  run.folder.add(kCage, facts.text(), [&](const std::string& path) { write_cage(path, run.cage); });
}

template <int Dim>
void mesh_interior(Run<Dim>& run) {
  auto& solver = run.solver;
  solver.make_domain(run.arguments.quiet);
  const auto& domain = solver.domain();
  if (!run.has_model()) run.inputs.shape = shape_of(domain);
  if (run.inputs.follower && run.inputs.follower->drawing() == nullptr) {
    // Refuses splats outside before the solve.
    naming(run.arguments.follower, [&] {
      place_points(run.cage, run.inputs.follower->points(), run.arguments.settings.outside);
    });
  }
  const auto name = domain_file<Dim>();
  run.report["mesh"] = {{"file", name},
                        {"vertices", domain.num_vertices()},
                        {"cells", domain.num_cells()},
                        {"mesher", solver.mesher()},
                        {"seconds", solver.mesh_seconds()}};
  Facts facts;
  facts << domain.num_vertices() << " vertices, " << domain.num_cells()
        << (Dim == 2 ? " triangles" : " tetrahedra");
  if (solver.mesher() == "netgen") facts << ", by Netgen";
  run.folder.add(name, facts.text(),
                 [&](const std::string& path) { io::write_domain(path, domain); });
}

template <int Dim>
void compute_weights(Run<Dim>& run) {
  auto& solver = run.solver;
  solver.solve(run.arguments.quiet);
  const auto& arguments = run.arguments;
  if (!arguments.quiet) warn_outside(solver.binding(), arguments.settings.model);
  if (run.inputs.follower) {
    const auto& follower = *run.inputs.follower;
    const auto& file = arguments.follower;
    const auto outside = arguments.settings.outside;
    if (follower.drawing() != nullptr) {
      run.drawing = drawing_by_mesh(solver.binding(), follower, file, outside);
    } else {
      run.follower = bind_by_mesh(solver.binding(), follower, file, outside);
      if (!arguments.quiet) warn_outside(run.follower, file);
    }
  }
  const auto delivered = measure_quality(run.cage.points, run.attached(), run.weights());
  run.report["solve"] = solver.json(delivered);
  if (run.has_model()) {
    run.folder.add(kDomainWeights, "a row per vertex of the domain",
                   [&](const auto& path) { io::write_weights(path, solver.domain_weights()); });
  }
  const auto& report = solver.report();
  Facts facts;
  facts << name_of_method(run.arguments.settings, report.method);
  if (!report.parts.empty()) facts << ", " << report.parts.size() << " parts";
  if (report.iterations > 0) facts << ", " << describe_iterations(report, run.arguments.settings);
  if (report.status != SolveStatus::kConverged) facts << " (not converged)";
  facts << "; " << delivered.mean_influences
        << " influences above 1e-4 per vertex, smallest weight " << delivered.min_weight
        << ", reproduction error " << delivered.max_reproduction_error;
  if (report.mesh_error > 0) {
    facts << "; mean squared distance from the weights of a much finer mesh about "
          << report.mesh_error << " (--vertices " << 4 * report.vertices << ": about "
          << report.mesh_error / 10 << ")";
  }
  if (is_certified(report)) {
    facts << ", " << describe_proof(report);
  }
  run.folder.add(kWeights, facts.text(),
                 [&](const std::string& path) { io::write_weights(path, run.weights()); });
}

template <int Dim>
void check_weights_of_mesh(Run<Dim>& run) {
  auto check = check_cage(run.cage, run.arguments.settings.cage);
  check.domain_file = run.report["mesh"]["file"];
  check.weights_file = run.has_model() ? kDomainWeights : kWeights;
  // As weights of points: comparing with harmonic coordinates takes long, and is up to flbc check.
  check_weights_of(check, run.solver.domain().points, run.solver.domain_weights());
  run.report["check"] = check_json(check);
}

namespace {

template <int Dim>
void deform_follower(Run<Dim>& run) {
  const auto& follower = *run.inputs.follower;
  std::optional<PointJacobians<Dim>> jacobians;
  if (!run.drawing) jacobians = run.follower.point_jacobians();
  for (const auto& pose : run.poses()) {
    const auto name = name_of_follower(pose.number, run.poses().size(), run.arguments);
    Facts facts;
    facts << follower.points().cols() << (jacobians ? " splats" : " points of curves");
    run.folder.add(name, facts.text(), [&](const std::string& path) {
      naming(path, [&] {
        const auto moved =
            run.drawing ? run.drawing(pose.points) : run.follower.deform(pose.points);
        follower.write(path, moved, {}, 0,
                       jacobians ? jacobians->at(pose.points) : Eigen::MatrixXd());
      });
    });
    run.report["deform"].push_back({{"pose", pose.name}, {"file", name}});
  }
  if (!run.arguments.quiet) follower.print_losses();
}

void deform_picture(Run<2>& run) {
  const auto& picture = *run.inputs.picture;
  std::vector<PointList<2>> poses;
  for (const auto& pose : run.poses()) poses.push_back(pose.points);
  const auto take = [&](std::size_t k, const io::Bitmap& moved) {
    const auto& pose = run.poses()[k];
    const auto name = name_of_follower(pose.number, poses.size(), run.arguments);
    run.folder.add(name, describe(moved),
                   [&](const std::string& path) { write_picture(path, moved); });
    run.report["deform"].push_back(
        {{"pose", pose.name}, {"file", name}, {"offset", {moved.left, moved.top}}});
  };
  const auto staying = io::warp(picture, run.solver.binding(), poses, 1, {0, 0}, take);
  if (!run.arguments.quiet) warn_staying(staying, run.arguments.follower);
}

// Where vertices stay that are outside of the cage.
template <int Dim>
void tell_border(Run<Dim>& run) {
  if (count_without_weights(run.reduced.weights) == 0) return;
  run.report["border"] = border_json(run.reduced, run.poses());
  if (!run.arguments.quiet) warn_border(run.reduced, run.arguments.settings.model, run.poses());
}

}  // namespace

template <int Dim>
void deform_shape(Run<Dim>& run) {
  const auto& shape = run.shape();
  run.displacement = measure_displacement<Dim>(
      [&](const PointList<Dim>& pose) { return run.reduced.deform(pose); }, shape.points,
      run.poses());
  auto& report = run.report["deform"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < run.poses().size(); ++k) {
    const auto& pose = run.poses()[k];
    const PointList<Dim> points = run.reduced.deform(pose.points);
    const auto name = name_of_deformed(pose.number, run.poses().size(), shape.extension);
    run.folder.add(name, "", [&](const std::string& path) {
      if (shape.file) {
        naming(path, [&] { shape.file->write(path, points, {}, 0); });
        if (!run.arguments.quiet) warn_inverted(*shape.file, points, name, pose.name);
      } else {
        io::write_domain<Dim>(path, {points, run.solver.domain().cells});
      }
    });
    Eigen::Index farthest = 0;
    const double largest = run.displacement.lengths.row(k).maxCoeff(&farthest);
    report.push_back({{"pose", pose.name},
                      {"file", name},
                      {"largest_displacement", largest},
                      {"point", farthest}});
  }
  tell_border(run);
  if (run.poses().empty()) return;
  if (run.inputs.follower) deform_follower(run);
  if constexpr (Dim == 2) {
    if (run.inputs.picture) deform_picture(run);
  }
  const auto& pose = run.poses()[run.displacement.pose];
  Facts facts;
  if (run.poses().size() > 1) facts << run.poses().size() << " poses; ";
  facts << "largest displacement " << run.displacement.largest << ", of vertex "
        << run.displacement.point << " in " << pose.name;
  run.folder.print((run.poses().size() > 1 ? "deformed_*" : "deformed") + shape.extension,
                   facts.text());
}

#define FLBC_INSTANTIATE(Dim)                     \
  template void deliver_cage(Run<Dim>&);          \
  template void mesh_interior(Run<Dim>&);         \
  template void compute_weights(Run<Dim>&);       \
  template void check_weights_of_mesh(Run<Dim>&); \
  template void deform_shape(Run<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
