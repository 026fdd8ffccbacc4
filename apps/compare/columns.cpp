// SPDX-License-Identifier: BSD-3-Clause
// The kinds of coordinates of flbc compare: names, weights, and properties.
#include <algorithm>
#include <chrono>
#include <iostream>

#include "compare/comparison.h"
#include "compare/distortion.h"
#include "flbc/check.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/green.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/weights_io.h"
#include "flbc/report.h"
#include "flbc/solver.h"
#include "flbc/sparsify_error.h"
#include "front/instantiate.h"
#include "front/load.h"
#include "front/make_domain.h"
#include "front/wording.h"
#include "report/properties.h"
#include "solve/cage_solver.h"
#include "solve/progress_bar.h"

namespace flbc::app {
namespace {

constexpr const char* kBlended = "blended";

// In the order of the table, with their titles in pictures.
constexpr std::pair<const char*, const char*> kMethods[] = {{"local", "local"},
                                                            {"harmonic", "harmonic"},
                                                            {"bbw", "bounded biharmonic"},
                                                            {"meanvalue", "mean value"},
                                                            {"maxentropy", "maximum entropy"},
                                                            {"maxlikelihood", "maximum likelihood"},
                                                            {"green", "Green"},
                                                            {kBlended, "blended"}};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <int Dim>
void mesh_domain(Comparison<Dim>& all) {
  const auto& arguments = all.arguments;
  SolveSettings settings;
  settings.cage = arguments.cage;
  settings.model = arguments.model;
  settings.vertices = arguments.vertices;
  settings.meshing = arguments.meshing;
  settings.needs_domain = true;
  CageSolver<Dim> solver(all.cage, all.shape.points, all.shape.edges, settings);
  solver.make_domain(arguments.quiet);
  all.domain = solver.domain();
  all.placement = solver.rig().placement();
  if (arguments.model.empty()) all.shape = shape_of(all.domain);
  all.folder.add(domain_file<Dim>(), "",
                 [&](const std::string& path) { io::write_domain(path, all.domain); });
}

// \return what moves the vertices of the mesh, and the seconds for its weights
template <int Dim>
std::pair<Motion<Dim>, StageSeconds> solve_green(const Comparison<Dim>& all, Column<Dim>& column) {
  const auto n = all.cage.size();
  const auto of_control_points = [&](const PointList<Dim>& points) {
    return SparseWeights(WeightMatrix(green_coordinates(all.cage, points).topRows(n)));
  };
  const auto start = std::chrono::steady_clock::now();
  auto mesh = by_green_coordinates(all.cage, all.domain.points);
  const double seconds = seconds_since(start);
  column.of_mesh = of_control_points(all.domain.points);
  column.moved = by_green_coordinates(all.cage, all.points());
  column.rows = of_control_points(all.points());
  return {std::move(mesh), {0, seconds, 0, 0}};
}

// By weights that need not reproduce the points.
template <int Dim>
Motion<Dim> by_weights(const Comparison<Dim>& all, const PointList<Dim>& points,
                       const SparseWeights& weights) {
  return [binding = bound_by<Dim>(all.cage, points, weights)](const PointList<Dim>& pose) {
    return binding.deform(pose);
  };
}

// What holds for the deformation, of which weights of control points are only a part.
template <int Dim>
double reproduction_error(const Comparison<Dim>& all, const Motion<Dim>& moved) {
  return displacements<Dim>(all.points(), moved(all.cage.points)).maxCoeff() /
         bounding_box_diagonal(all.cage.points);
}

// The share of the points that a control point moves by more than 1% of its own displacement.
double reach(const SparseWeights& weights) {
  return count_influences(weights, 0.01).mean / weights.num_control_points();
}

template <int Dim>
void add_distortion(const Comparison<Dim>& all, const Motion<Dim>& mesh, Column<Dim>& column) {
  auto poses = test_poses<Dim>(all.cage.points);
  if (all.pose.cols() > 0) poses = {all.pose};
  Distortion sum;
  for (const auto& pose : poses) {
    const auto one = distortion_of<Dim>(all.domain, mesh(pose));
    sum.isometric += one.isometric / static_cast<double>(poses.size());
    sum.volume += one.volume / static_cast<double>(poses.size());
    sum.flipped += one.flipped / static_cast<double>(poses.size());
  }
  column.facts["distortion"] = sum.isometric;
  column.facts["volume_change"] = sum.volume;
  column.facts["flipped"] = sum.flipped;
}

//! \param mesh  moves the vertices of the mesh
template <int Dim>
void measure(const Comparison<Dim>& all, const Motion<Dim>& mesh, const StageSeconds& seconds,
             Column<Dim>& column) {
  const auto& settings = column.settings;
  column.facts = {{"method", name_of_method(settings, settings.options.method)},
                  {"smoothness", settings.coordinates ? 0 : *resolve(settings.options).smoothness}};
  const auto check = check_weights(all.cage, all.domain, column.of_mesh);
  column.facts.update(properties_of(check));
  column.facts["total_variation"] =
      check.mesh->total_variation / check.mesh->harmonic_total_variation;
  column.facts["max_influences"] = count_influences(column.of_mesh, kInfluenceThreshold).max;
  column.facts["reach"] = reach(column.rows);
  add_distortion(all, mesh, column);
  if (column.has_normals()) {
    column.facts["reproduction_error"] = reproduction_error(all, column.moved);
  }
  constexpr int kFrames = 5;
  const auto& pose = all.pose.cols() > 0 ? all.pose : all.cage.points;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < kFrames; ++k) column.moved(pose);
  column.facts["setup_seconds"] = seconds.setup;
  column.facts["solve_seconds"] = seconds.solve + seconds.recover;
  column.facts["seconds_per_frame"] = seconds_since(start) / kFrames;
}

template <int Dim>
void solve_column(const Comparison<Dim>& all, Column<Dim>& column) {
  if (column.has_normals()) {
    const auto [mesh, seconds] = solve_green(all, column);
    return measure(all, mesh, seconds, column);
  }
  const auto& settings = column.settings;
  ProgressBar bar(all.arguments.quiet, "setting up: boundary values, distances");
  auto options = bind_options(all.cage, all.domain, settings);
  options.outside = OutsidePoints::kNearest;
  options.observer.progress = [&](const Progress& progress) {
    bar.show(progress);
    return true;
  };
  const bool has_model = !all.arguments.model.empty();
  Rig<Dim> rig(all.cage, MadeDomain<Dim>{all.domain}, has_model ? all.points() : PointList<Dim>(),
               {}, options);
  const auto seconds = rig.solve().report.seconds;
  column.of_mesh = rig.solution().weights;
  column.rows = rig.weights_of_points();
  column.moved = by_weights(all, all.points(), column.rows);
  measure(all, by_weights(all, all.domain.points, column.of_mesh), seconds, column);
}

}  // namespace

std::vector<std::string> comparable_methods() {
  std::vector<std::string> names;
  for (const auto& [name, title] : kMethods) names.emplace_back(name);
  return names;
}

template <int Dim>
std::vector<Column<Dim>> columns_of(const std::vector<std::string>& methods) {
  std::vector<Column<Dim>> columns;
  for (const auto& [name, title] : kMethods) {
    const bool is_given = std::count(methods.begin(), methods.end(), name) > 0;
    const bool is_possible = Dim == 2 || name != std::string(kBlended);
    if (!(methods.empty() ? is_possible : is_given)) continue;
    Column<Dim> column{name, title};
    column.settings.coordinates = value_named<Coordinates>(name);
    columns.push_back(column);
  }
  return columns;
}

template <int Dim>
void solve_columns(Comparison<Dim>& all) {
  mesh_domain(all);
  for (auto& column : all.columns) {
    if (!all.arguments.quiet) std::cerr << "flbc: " << column.name << '\n';
    try {
      naming(all.arguments.cage, [&] { solve_column(all, column); });
    } catch (const Error& error) {
      column.failure = in_words_of_program(error.what());
      continue;
    }
    if (column.has_normals()) continue;
    all.folder.add(column.weights_file(), "",
                   [&](const std::string& path) { io::write_weights(path, column.rows); });
  }
  if (all.succeeded().empty()) {
    throw InputError(all.arguments.cage +
                     ": all methods failed; the first one: " + all.columns.front().failure);
  }
}

FLBC_INSTANTIATE_FUNCTION(columns_of)
FLBC_INSTANTIATE_FUNCTION(solve_columns)

}  // namespace flbc::app
