// SPDX-License-Identifier: BSD-3-Clause
// flbc compare: several kinds of coordinates of a cage next to each other.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands/commands.h"
#include "draw/model_picture.h"
#include "draw/plane_picture.h"
#include "draw/view.h"
#include "files/load.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/weights_io.h"
#include "help/wording.h"
#include "poses/poses.h"
#include "report/check_report.h"
#include "report/facts.h"
#include "report/report_json.h"
#include "run/inputs.h"
#include "solve/cage_solver.h"
#include "solve/progress_bar.h"
#include "text/escaped.h"
#include "view/model_page.h"

namespace flbc::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kLocal = "local";
constexpr const char* kFunctionGrid = "functions";
constexpr const char* kPoseGrid = "poses";

struct CompareArguments {
  std::string cage, model, pose, output;
  std::vector<std::string> methods;
  Index vertices = 0;
  Index control_point = -1;
  MesherSettings meshing{};
  std::string pictures = "png";
  bool quiet = false;
};

// A kind of coordinates with its results.
template <int Dim>
struct Column {
  std::string name;  // also in names of files
  SolverOptions options{};
  std::string failure{};  // if there are no results
  WeightMatrix of_mesh{};
  SparseWeights rows{};  // of the shape's points
  PointList<Dim> points{};
  Json facts{};
};

std::vector<std::string> known_methods() {
  return {kLocal, "harmonic", "meanvalue", "maxentropy", "maxlikelihood", "blended"};
}

template <int Dim>
std::vector<Column<Dim>> columns_of(std::vector<std::string> methods) {
  if (methods.empty()) {
    methods = known_methods();
    if (Dim == 3) methods.pop_back();
  }
  std::vector<Column<Dim>> columns;
  for (const auto& method : methods) {
    Column<Dim> column{method};
    if (method != kLocal) {
      column.options.method = *value_named<Method>(method);
      columns.push_back(column);
      continue;
    }
    column.options.smoothness = 0;
    columns.push_back(column);
    column.name = "local_smooth";
    column.options.smoothness = kDeformationSmoothness;
    columns.push_back(column);
  }
  return columns;
}

// What is compared, and where it goes.
template <int Dim>
struct Comparison {
  const CompareArguments& arguments;
  const Cage<Dim>& cage;
  Shape<Dim> shape{};     // a model, or the mesh
  PointList<Dim> pose{};  // of the control points; empty without one
  DomainMesh<Dim> domain{};
  std::vector<Column<Dim>> columns{};
  Index control_point = 0;
  Json files = Json::array();

  std::string path_of(const std::string& name) const {
    return (fs::path(arguments.output) / name).string();
  }
  void add_text(const std::string& name, const std::string& text) {
    write_text(path_of(name), text);
    files.push_back(name);
  }
  std::vector<const Column<Dim>*> succeeded() const {
    std::vector<const Column<Dim>*> some;
    for (const auto& column : columns) {
      if (column.failure.empty()) some.push_back(&column);
    }
    return some;
  }
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <int Dim>
SolveSettings settings_of(const CompareArguments& arguments) {
  SolveSettings settings;
  settings.cage = arguments.cage;
  settings.model = arguments.model;
  settings.vertices = arguments.vertices;
  settings.meshing = arguments.meshing;
  settings.needs_domain = true;
  return settings;
}

template <int Dim>
void solve_column(const Comparison<Dim>& all, Column<Dim>& column) {
  auto settings = settings_of<Dim>(all.arguments);
  settings.domain = all.path_of(domain_file<Dim>());
  settings.options = column.options;
  const PointList<Dim> model = all.arguments.model.empty() ? PointList<Dim>() : all.shape.points;
  CageSolver<Dim> solver(all.cage, model, settings);
  solver.make_domain(all.arguments.quiet);
  const auto start = std::chrono::steady_clock::now();
  solver.solve(all.arguments.quiet);
  const double seconds = seconds_since(start);
  column.of_mesh = solver.domain_weights().dense();
  column.rows = solver.rows();
  column.points = solver.points();

  CheckReport<Dim> check;
  check.cage = all.cage;
  check_weights_of(check, all.domain, column.of_mesh);
  const auto quality = measure_quality(all.cage.points, column.points, column.rows);
  const auto& mesh = *check.weights->mesh;
  std::int64_t extrema = 0;
  for (const auto* numbers : {&mesh.local_minima, &mesh.local_maxima}) {
    for (const Index number : *numbers) extrema += number;
  }
  constexpr int kFrames = 5;
  const auto first_frame = std::chrono::steady_clock::now();
  const auto& pose = all.pose.cols() > 0 ? all.pose : all.cage.points;
  for (int k = 0; k < kFrames; ++k) deform<Dim>(column.rows, pose);
  column.facts = {
      {"method", name_of(resolve(column.options).method)},
      {"smoothness", column.options.smoothness.value_or(0)},
      {"influences", quality.mean_influences},
      {"min_weight", check.weights->min_weight.value},
      {"sum_error", check.weights->partition.value},
      {"reproduction_error", check.weights->reproduction.value},
      {"local_extrema", extrema},
      {"deepest_extremum", std::max(mesh.deepest_minimum.value, mesh.highest_maximum.value)},
      {"gradient_jump", mesh.gradient_jump},
      {"seconds", seconds},
      {"seconds_per_frame", seconds_since(first_frame) / kFrames}};
}

// Rows of the table, the first with headings.
template <int Dim>
std::vector<std::vector<std::string>> table_of(const Comparison<Dim>& all) {
  constexpr std::pair<const char*, const char*> kFacts[] = {
      {"influences", "influences, mean"},
      {"min_weight", "smallest weight"},
      {"sum_error", "sum - 1"},
      {"reproduction_error", "reproduction error"},
      {"local_extrema", "local extrema"},
      {"deepest_extremum", "depth of extrema"},
      {"gradient_jump", "gradient jump"},
      {"seconds", "seconds"},
      {"seconds_per_frame", "seconds per frame"}};
  std::vector<std::vector<std::string>> rows{{"coordinates"}};
  for (const auto& [key, heading] : kFacts) rows[0].emplace_back(heading);
  for (const auto* column : all.succeeded()) {
    rows.push_back({column->name});
    for (const auto& [key, heading] : kFacts) {
      Facts text;
      const auto& fact = column->facts[key];
      fact.is_number_integer() ? text << fact.template get<std::int64_t>()
                               : text << fact.template get<double>();
      rows.back().push_back(text.text());
    }
  }
  return rows;
}

template <int Dim>
std::string text_table(const Comparison<Dim>& all) {
  const auto rows = table_of(all);
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      std::size_t width = 0;
      for (const auto& other : rows) width = std::max(width, other[k].size());
      line += row[k] + std::string(width + 2 - row[k].size(), ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  for (const auto& column : all.columns) {
    if (!column.failure.empty()) text += column.name + " failed: " + column.failure + "\n";
  }
  return text;
}

template <int Dim>
Index choose_control_point(const Comparison<Dim>& all) {
  if (all.arguments.control_point >= 0) return all.arguments.control_point;
  Eigen::VectorXd moved = all.succeeded().front()->rows.dense().rowwise().sum();
  if (all.pose.cols() > 0) {
    const PointList<Dim> steps = all.pose - all.cage.points;
    const Eigen::VectorXd lengths = steps.colwise().norm();
    if (lengths.maxCoeff() > 0) moved = moved.cwiseProduct(lengths);
  }
  Eigen::Index chosen = 0;
  moved.maxCoeff(&chosen);
  return static_cast<Index>(chosen);
}

draw::WeightPictureOptions options_of(const CompareArguments& arguments) {
  draw::WeightPictureOptions options;
  options.width = 1800;
  options.format = draw::picture_format("picture." + arguments.pictures);
  return options;
}

// \param posed  in the pose instead of one function
std::string grid(const Comparison<2>& all, bool posed) {
  const auto triangles = gltf::triangles_of_points(all.shape.surface);
  std::vector<draw::PlanePanel> panels;
  for (const auto* column : all.succeeded()) {
    const Eigen::VectorXd values = column->of_mesh.row(all.control_point);
    if (posed) {
      panels.push_back({column->name, {all.pose, deform<2>(column->rows, all.pose)}, {}});
    } else {
      panels.push_back({column->name, {all.cage.points, all.domain.points}, values});
    }
  }
  return draw::draw_panels(all.cage.facets, posed ? triangles : all.domain.cells, panels,
                           all.shape.points, all.control_point, options_of(all.arguments));
}

std::string grid(const Comparison<3>& all, bool posed) {
  std::vector<draw::ModelPanel> panels;
  for (const auto* column : all.succeeded()) {
    if (posed) {
      panels.push_back({column->name, {all.pose, deform<3>(column->rows, all.pose)}, {}});
    } else {
      panels.push_back({column->name,
                        {all.cage.points, column->points},
                        column->rows.dense().row(all.control_point)});
    }
  }
  return draw::draw_panels(
      {gltf::triangles_of_points(all.shape.surface), load_shown_cage<3>(all.arguments.cage).edges},
      panels, all.control_point, draw::view_by_angles(draw::kUsualAzimuth, draw::kUsualElevation),
      options_of(all.arguments));
}

template <int Dim>
void draw_grids(Comparison<Dim>& all) {
  const auto extension = "." + all.arguments.pictures;
  const bool has_surface = all.shape.surface.triangles.cols() > 0;
  // On the boundary of a mesh in 3D, all functions are the same.
  const bool is_inside = Dim == 2 || (has_surface && !all.arguments.model.empty());
  if (is_inside) all.add_text(kFunctionGrid + extension, grid(all, false));
  if (all.pose.cols() > 0 && has_surface) all.add_text(kPoseGrid + extension, grid(all, true));
}

// A page in which the cage can be moved.
template <int Dim>
std::string viewer_of(const Comparison<Dim>& all, const Column<Dim>& column) {
  const auto& arguments = all.arguments;
  const auto page = all.path_of("model.html");
  view::PageContent<Dim> content;
  content.title = column.name;
  content.model_file =
      arguments.model.empty() ? domain_file<Dim>() : path_beside(page, arguments.model);
  content.weights_file = "weights_" + column.name + ".npy";
  content.cage_file = path_beside(page, arguments.cage);
  content.cage = load_shown_cage<Dim>(arguments.cage);
  content.points = column.points;
  content.surface = all.shape.surface;
  content.weights = view::limit_influences<Dim>(all.cage.points, column.points, column.rows.dense(),
                                                view::kMostInfluences);
  if (all.pose.cols() > 0) content.poses = {{arguments.pose, 1, all.pose}};
  return view::make_page(content);
}

template <int Dim>
std::string page_of(const Comparison<Dim>& all) {
  std::ostringstream page;
  page << "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n"
       << "<title>Coordinates of " << io::escaped(all.arguments.cage) << "</title>\n"
       << "<style>body{font:15px sans-serif;margin:2em}table{border-collapse:collapse}"
       << "td,th{border:1px solid #999;padding:4px 8px;text-align:right}"
       << "td:first-child{text-align:left}img{max-width:100%}"
       << "iframe{width:100%;height:80vh;border:1px solid #999}</style>\n"
       << "<h1>Coordinates of " << io::escaped(all.arguments.cage) << "</h1>\n<table>\n";
  const char* cell = "th";
  for (const auto& row : table_of(all)) {
    page << "<tr>";
    for (const auto& text : row) page << '<' << cell << '>' << text << "</" << cell << '>';
    page << "</tr>\n";
    cell = "td";
  }
  page << "</table>\n";
  for (const auto& column : all.columns) {
    if (column.failure.empty()) continue;
    page << "<p>" << column.name << " failed: " << io::escaped(column.failure) << "</p>\n";
  }
  for (const auto& file : all.files) {
    const auto name = file.template get<std::string>();
    if (io::extension_of(name) == "png" || io::extension_of(name) == "svg") {
      page << "<p><img src=\"" << name << "\" alt=\"all coordinates next to each other\"></p>\n";
    }
  }
  page << "<p><label>Drag the cage with <select onchange=\"document.querySelector('iframe').src="
       << "'model_'+this.value+'.html'\">";
  for (const auto* column : all.succeeded()) page << "<option>" << column->name << "</option>";
  page << "</select> coordinates</label></p>\n<iframe src=\"model_" << all.succeeded().front()->name
       << ".html\" title=\"model\"></iframe>\n</html>\n";
  return page.str();
}

template <int Dim>
void fill_cage(Comparison<Dim>& all, const PointList<Dim>& model) {
  const auto settings = settings_of<Dim>(all.arguments);
  CageSolver<Dim> solver(all.cage, model, settings);
  solver.make_domain(all.arguments.quiet);
  all.domain = solver.domain();
  if (all.arguments.model.empty()) all.shape = shape_of(all.domain);
  const auto name = domain_file<Dim>();
  require_distinct({all.arguments.cage, all.arguments.model, all.arguments.pose},
                   {all.path_of(name)});
  io::write_domain(all.path_of(name), all.domain);
  all.files.push_back(name);
}

template <int Dim>
void solve_columns(Comparison<Dim>& all) {
  for (auto& column : all.columns) {
    if (!all.arguments.quiet) std::cerr << "flbc: " << column.name << '\n';
    try {
      solve_column(all, column);
      const auto name = "weights_" + column.name + ".npy";
      io::write_weights(all.path_of(name), column.rows);
      all.files.push_back(name);
    } catch (const Error& error) {
      column.failure = in_words_of_program(error.what());
    }
  }
  if (all.succeeded().empty()) {
    throw InputError(all.arguments.cage +
                     ": all methods failed; the first one: " + all.columns.front().failure);
  }
}

template <int Dim>
int compare_in(const Cage<Dim>& cage, const CompareArguments& arguments) {
  Comparison<Dim> all{arguments, cage};
  all.columns = columns_of<Dim>(arguments.methods);
  if (arguments.control_point != -1) require_control_point(arguments.control_point, cage.size());
  if (!arguments.pose.empty()) {
    all.pose = load_control_points<Dim>(arguments.pose);
    require_control_points(arguments.pose, all.pose.cols(), cage.size(), arguments.cage);
  }
  if (!arguments.model.empty()) {
    auto model = load_shown_model<Dim>(arguments.model);
    all.shape.points = std::move(model.points);
    all.shape.surface = std::move(model.surface);
  }
  make_folder(arguments.output);
  fill_cage(all, all.shape.points);
  solve_columns(all);
  all.control_point = choose_control_point(all);
  draw_grids(all);
  for (const auto* column : all.succeeded()) {
    const ProgressBar bar(arguments.quiet, "writing pages");
    all.add_text("model_" + column->name + ".html", viewer_of(all, *column));
  }
  const auto table = text_table(all);
  all.add_text("table.txt", table);
  all.add_text("index.html", page_of(all));
  Json report{{"command", "compare"},
              {"cage", arguments.cage},
              {"model", arguments.model},
              {"vertices", all.domain.num_vertices()},
              {"control_point", all.control_point},
              {"columns", Json::object()},
              {"failures", Json::object()}};
  for (const auto& column : all.columns) {
    if (column.failure.empty()) {
      report["columns"][column.name] = column.facts;
    } else {
      report["failures"][column.name] = column.failure;
    }
  }
  report["files"] = all.files;
  write_text(all.path_of("table.json"), to_text(report));
  if (!arguments.quiet) std::cerr << table;
  return kDone;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<CompareArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("compare", "compare several kinds of coordinates of the same cage");
  command->footer(
      "OUTDIR receives a table (table.txt, table.json), pictures of one coordinate function and "
      "of\n"
      "the pose by all methods, weights, and index.html, a page with all of these in which the\n"
      "cage can be moved. A method that fails is listed with the reason; the others continue.");
  command->add_option("CAGE", a.cage, "closed polylines (2D) or surface (3D)")->required();
  command->add_option("MODEL", a.model,
                      "model inside the cage (default: the mesh of the cage interior)");
  command->option_defaults()->group("Output");
  command->add_option("-o,--output", a.output, "folder for all results")
      ->required()
      ->type_name("OUTDIR");
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  add_choice(*command, "--pictures", {"png", "svg", "pdf"}, a.pictures,
             "format of the pictures (default: png)");
  command->add_option("--control-point", a.control_point,
                      "control point to draw, counted from 0 (default: the one that moves most)");
  command->option_defaults()->group("Comparison");
  command
      ->add_option("--methods", a.methods,
                   "coordinates, separated by commas (default: all). local: two columns, with "
                   "smoothness 0 and 0.003")
      ->delimiter(',')
      ->check(CLI::IsMember(known_methods()))
      ->type_name("local|harmonic|meanvalue|maxentropy|maxlikelihood|blended");
  command->add_option("--pose", a.pose, "deformed cage for pictures and seconds per frame");
  command->add_option("--vertices", a.vertices, "number of mesh vertices (default: 10000)")
      ->check(refuse_vertex_count);
  add_mesher_options(*command, a.meshing);
  command->callback([arguments, &exit_status] {
    const auto cage = load_cage(arguments->cage);
    exit_status = std::visit([&](const auto& any) { return compare_in(any, *arguments); }, cage);
  });
}

}  // namespace flbc::app
