// SPDX-License-Identifier: BSD-3-Clause
#include "work.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "draw/base64.h"
#include "files/load.h"
#include "files/up_axis.h"
#include "flbc/bounding_box.h"
#include "flbc/cage_facts.h"
#include "flbc/coordinates.h"
#include "flbc/deform.h"
#include "flbc/io/files.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/weights_io.h"
#include "flbc/names.h"
#include "flbc/sparsify.h"
#include "gltf/look.h"
#include "gltf/skin.h"
#include "picture.h"
#include "solve/estimate.h"
#include "solve/make_domain.h"
#include "view/model_page.h"
#ifdef FLBC_WITH_CGAL
#include "flbc/cage_from_model.h"
#include "flbc/repair_cage.h"
#endif

namespace flbc::web {
namespace {

constexpr const char* kCageFile = "cage.obj";

template <class Enum>
Enum named(const Json& options, const char* option, Enum usual) {
  if (!options.contains(option)) return usual;
  const auto name = options[option].get<std::string>();
  if (const auto value = value_named<Enum>(name)) return *value;
  throw OptionError(std::string(option) + ": invalid value '" + name + "'");
}

template <int Dim>
PointList<Dim> points_in(const Json& numbers, Index count) {
  const auto values = numbers.get<std::vector<double>>();
  if (values.size() != static_cast<std::size_t>(Dim) * count) {
    throw InputError("this shape has " + std::to_string(values.size()) + " coordinates, not " +
                     std::to_string(Dim * count));
  }
  return Eigen::Map<const PointList<Dim>>(values.data(), Dim, count);
}

// Writes a file by its name and takes its bytes.
template <class Write>
std::string bytes_of(const std::string& file, const Write& write) {
  write(file);
  auto bytes = io::read_file(file);
  std::filesystem::remove(file);
  return bytes;
}

// A polygon as triangles of its interior, in 2D.
io::Model fill(const app::ModelFacets<2>& outline) {
  constexpr Index kVertices = 2000;
  const Cage<2> polygon{outline.points, outline.facets};
  const auto mesh = app::make_domain<2>({polygon, "the polygon", kVertices}).mesh;
  io::Model model{io::to_polygons(mesh)};
  spread_picture(model, outline.points.rowwise().minCoeff(), outline.points.rowwise().maxCoeff());
  return model;
}

#ifdef FLBC_WITH_CGAL
const char* name_of(CagingStage stage) {
  constexpr const char* kNames[] = {"simplifying the model", "wrapping the model",
                                    "reducing control points", "checking the cage"};
  return kNames[static_cast<int>(stage)];
}

CageSymmetry symmetry_of(const Json& options) {
  const auto name = options.value("symmetry", std::string("auto"));
  constexpr const char* kNames[] = {"none", "x", "y", "z", "auto"};
  for (int k = 0; k < 5; ++k) {
    if (name == kNames[k]) return static_cast<CageSymmetry>(k);
  }
  throw OptionError("symmetry: invalid value '" + name + "' (choose from none, x, y, z, auto)");
}
#endif

SolverOptions solver_options(const Json& options) {
  SolverOptions result;
  if (options.contains("smoothness")) result.smoothness = options["smoothness"].get<double>();
  if (options.contains("tolerance")) result.tolerance = options["tolerance"].get<double>();
  result.distances = named(options, "distances", Distances::kAuto);
  result.precision = named(options, "precision", Precision::kAuto);
  make_smooth(result);
  return result;
}

}  // namespace

template <int Dim>
Work<Dim>::Work(const std::string& name, app::ModelFacets<Dim> facets)
    : name_(name), facets_(std::move(facets)) {
  if constexpr (Dim == 2) {
    const bool is_outline = !is_picture(name) && io::read_polygons(name).polygons.empty();
    if (is_picture(name) || is_outline) {
      take(is_outline ? fill(facets_) : grid_of_picture(read_mask(name)));
      return;
    }
  }
  file_.emplace(app::MovedFile{name, name});
  points_ = file_->points();
  edges_ = file_->edges();
  if (!file_->model()->soup.polygons.empty()) surface_ = file_->surface();
}

template <int Dim>
Work<Dim>::Work(const std::string& name, io::Model model) : name_(name) {
  facets_.points = io::to_points<Dim>(model.soup, name);
  const auto& polygons = model.soup.polygons;
  if constexpr (Dim == 3) {
    facets_.facets.resize(3, static_cast<Eigen::Index>(polygons.size()));
    for (std::size_t t = 0; t < polygons.size(); ++t) {
      for (int k = 0; k < 3; ++k) facets_.facets(k, static_cast<Eigen::Index>(t)) = polygons[t][k];
    }
  } else {
    const auto edges = view::edges_of_cage<2>(polygons, {});
    facets_.facets = view::as_facets(edges);
  }
  take(std::move(model));
}

template <int Dim>
void Work<Dim>::take(io::Model model) {
  made_ = std::move(model);
  points_ = io::to_points<Dim>(made_.soup, name_);
  edges_ = edges_of_polygons(points_, made_.soup.polygons, {});
  surface_ = gltf::surface_of_model<Dim>(made_);
}

// ------------------------------------------------------------------------------------------ cages

template <int Dim>
Json Work<Dim>::cage_facts() const {
  return {{"controlPoints", cage_.size()}, {"facets", cage_.facets.cols()}};
}

template <int Dim>
void Work<Dim>::set_cage(Cage<Dim> cage) {
  app::write_cage(kCageFile, cage);
  solver_.reset();
  weights_ = {};
  cage_ = std::move(cage);
  shown_ = app::load_shown_cage<Dim>(kCageFile);
}

#ifdef FLBC_WITH_CGAL
template <int Dim>
Json Work<Dim>::make_cage(const Json& options, const Report& report) {
  CagingOptions caging;
  caging.control_points = options.value("controlPoints", 0);
  caging.offset = options.value("offset", 0.0) * bounding_box_diagonal<Dim>(facets_.points);
  caging.symmetry = symmetry_of(options);
  caging.stage = [&](CagingStage stage, double done) { report(name_of(stage), done); };
  const auto made = app::naming(
      name_, [&] { return cage_from_model<Dim>(facets_.points, facets_.facets, caging); });
  set_cage(made.cage);
  auto facts = cage_facts();
  facts["offset"] = made.offset / bounding_box_diagonal<Dim>(facets_.points);
  facts["symmetry"] = made.symmetry_axis < 0 ? "none" : std::string(1, "xyz"[made.symmetry_axis]);
  return facts;
}

template <int Dim>
Json Work<Dim>::repair_cage() {
  const auto repaired = flbc::repair_cage<Dim>(cage_);
  set_cage(repaired.cage);
  auto facts = cage_facts();
  facts["changes"] = repaired.changes;
  return facts;
}
#else
template <int Dim>
Json Work<Dim>::make_cage(const Json&, const Report&) {
  throw OptionError("this module was built without CGAL and cannot make cages");
}
template <int Dim>
Json Work<Dim>::repair_cage() {
  throw OptionError("this module was built without CGAL and cannot repair cages");
}
#endif

template <int Dim>
Json Work<Dim>::read_cage(const std::string& file) {
  const auto soup = io::read_polygons(file);
  const auto any = io::to_cage(soup, file);
  const auto* const cage = std::get_if<Cage<Dim>>(&any);
  if (cage == nullptr) {
    throw InputError(file + ": the model is in " + std::to_string(Dim) +
                     "D, but the cage is not; both need the same dimension");
  }
  solver_.reset();
  weights_ = {};
  cage_ = *cage;
  shown_ = app::load_shown_cage<Dim>(file);
  auto defects = find_defects(cage_);
#ifdef FLBC_WITH_CGAL
  if (defects.empty()) defects = find_self_intersections(cage_);
#endif
  if (defects.empty()) return cage_facts();
  std::vector<Index> where;
  for (const auto& defect : defects) {
    where.insert(where.end(), defect.vertices.begin(), defect.vertices.end());
    for (const Index f : defect.facets) {
      where.insert(where.end(), cage_.facets.col(f).begin(), cage_.facets.col(f).end());
    }
  }
  throw DefectiveCage(file + ": " + defects.front().message, where);
}

// ------------------------------------------------------------------------------- mesh and weights

template <int Dim>
Json Work<Dim>::make_mesh(const Json& options, const Report& report) {
  place_in_cage();
  report("filling the cage", 0);
  auto made = app::make_domain<Dim>({cage_, kCageFile, options.value("vertices", 0)});
  set_mesh(std::move(made.mesh));
  mesher_ = made.mesher;
  // Twice the time of the native program.
  const auto estimate = app::estimate_solve(Dim, cage_.size(), mesh_.num_vertices(), {});
  return {{"vertices", mesh_.num_vertices()},
          {"cells", mesh_.num_cells()},
          {"note", made.note},
          {"seconds", 2 * estimate.seconds}};
}

template <int Dim>
void Work<Dim>::set_mesh(DomainMesh<Dim> mesh) {
  solver_.reset();
  mesh_ = std::move(mesh);
  mesher_ = app::Mesher::kAuto;
}

// Refuses vertices of faces outside. What a picture shows is inside, but not all corners of its
// grid are.
template <int Dim>
void Work<Dim>::place_in_cage() {
  outside_ = is_picture(name_) ? OutsidePoints::kNearest : OutsidePoints::kFail;
  try {
    place_points(cage_, points_, outside_);
  } catch (const InputError& error) {
    if (!file_ || !app::only_loose_are_outside(cage_, points_, file_->model()->soup)) {
      const std::string message = error.what();  // with advice for users of the library
      throw InputError(name_ + ": " + message.substr(0, message.find("; choose")) +
                       "; enlarge the cage, or make one around the model");
    }
    outside_ = OutsidePoints::kNearest;
  }
}

template <int Dim>
void Work<Dim>::update_weights(const SparseWeights& of_mesh) {
  of_mesh_ = of_mesh;
  placement_ = place_points(cage_, mesh_, points_, outside_);
  weights_ = weights_at(cage_, mesh_, of_mesh_, placement_);
}

template <int Dim>
Json Work<Dim>::solve(const Json& options, const Report& report) {
  double first = 0;
  Observer observer;
  observer.progress = [&](const Progress& progress) {
    const double excess = std::log(
        std::max({progress.relative_primal_residual, progress.relative_dual_residual, 1.0}));
    first = std::max(first, excess);
    report("solving", first > 0 ? 1 - excess / first : 0);
    return true;
  };
  observer.stage = [&](Stage stage, double done) {
    report(stage == Stage::kDistances ? "measuring distances" : "solving", done);
  };
  const auto solver = solver_options(options);
  const auto mesher = app::coarse_mesher<Dim>(mesher_);
  const auto facts = [](const SolveReport& of) -> Json {
    return {{"iterations", of.iterations},
            {"objective", of.objective},
            {"converged", of.status == SolveStatus::kConverged}};
  };
  if (cage_parts(cage_).size() > 1) {
    const auto solution = flbc::solve(cage_, mesh_, solver, mesher, observer);
    update_weights(solution.weights);
    return facts(solution.report);
  }
  solver_ = std::make_unique<Solver<Dim>>(cage_, mesh_, solver, mesher);
  const auto& solution = solver_->solve({}, observer);
  report("computing weights of the model", 0);
  update_weights(solution.weights);
  return facts(solution.report);
}

template <int Dim>
void Work<Dim>::set_solution(DomainMesh<Dim> mesh, const SparseWeights& weights) {
  place_in_cage();
  set_mesh(std::move(mesh));
  update_weights(weights);
}

template <int Dim>
Json Work<Dim>::move(const Json& request) {
  if (cage_parts(cage_).size() > 1) {
    throw InputError("a cage with several parts cannot be reshaped");
  }
  if (!solver_) {
    solver_ = std::make_unique<Solver<Dim>>(cage_, mesh_, solver_options({}),
                                            app::coarse_mesher<Dim>(mesher_));
    solver_->solve();
  }
  // Long enough to converge after most moves, short enough to be interrupted.
  constexpr Budget kBudget{0, 0.25};
  const auto start = std::chrono::steady_clock::now();
  const PointList<Dim> before = cage_.points;
  const bool refines = request.value("refine", false);
  try {
    const auto points = refines ? before : points_in<Dim>(request["points"], cage_.size());
    const auto change = [&] { refines ? solver_->solve(kBudget) : solver_->move(points, kBudget); };
    try {
      change();
    } catch (const InputError&) {
      // On the way from the anchored shape cells may be inverted that are not from the present one.
      solver_->anchor();
      change();
    }
    cage_ = solver_->cage();
    mesh_ = solver_->mesh();
    update_weights(solver_->solution().weights);
  } catch (const Error& error) {
    if (solver_->cage().points != before)
      solver_->move(before);  // the model reached out of the cage
    cage_ = solver_->cage();
    mesh_ = solver_->mesh();
    return {{"refused", error.what()}};
  }
  shown_.points = cage_.points;
  const auto& report = solver_->solution().report;
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  return {{"converged", report.status == SolveStatus::kConverged},
          {"iterations", report.iterations},
          {"residual", std::max(report.relative_primal_residual, report.relative_dual_residual)},
          {"milliseconds", taken.count()}};
}

template <int Dim>
Json Work<Dim>::reduce(const Json& options, const Report& report) {
  SparsifyOptions sparsify{options.value("influences", 8)};
  sparsify.progress = [&](double done) { report("reducing influences", done); };
  weights_ =
      reduce_influences<Dim>(cage_.points, placement_.points, edges_, weights_, {}, sparsify);
  return {{"influences", sparsify.max_influences}};
}

template <int Dim>
SparseWeights Work<Dim>::harmonic() const {
  const auto solution = compute_coordinates(cage_, mesh_, Coordinates::kHarmonic);
  return weights_at(cage_, mesh_, solution.weights, placement_);
}

// ----------------------------------------------------------------------------- what is shown,
// files

template <int Dim>
SparseWeights Work<Dim>::shown_weights() const {
  if (weights_.num_points() == 0) {
    const auto none = std::vector<std::int64_t>(points_.cols() + 1, 0);
    return {cage_.size(), none, {}, {}};
  }
  return view::limit_influences<Dim>(cage_.points, placement_.points, weights_,
                                     view::kMostInfluences);
}

template <int Dim>
view::PageContent<Dim> Work<Dim>::page_content(const std::string& picture) const {
  view::PageContent<Dim> content;
  content.title = std::filesystem::path(name_).stem().string();
  content.model_file = name_;
  content.weights_file = "weights.npy";
  content.cage_file = kCageFile;
  content.cage = shown_;
  content.points = points_;
  content.surface = surface_;
  content.weights = shown_weights();
  content.up = app::up_axis(app::UpAxis::kAuto, points_);
  content.picture = picture;
  const auto look = gltf::look_of(surface_);
  if (picture.empty() && !look.pictures.empty()) {
    const auto& [media_type, bytes] = look.pictures.front();
    content.picture = app::data_uri(media_type, bytes);
  }
  return content;
}

template <int Dim>
std::string Work<Dim>::content(const std::string& picture) const {
  return view::make_content(page_content(picture));
}

template <int Dim>
std::string Work<Dim>::page(const std::string& picture) const {
  return view::make_page(page_content(picture));
}

template <int Dim>
std::string Work<Dim>::glb(const Json& options) const {
  gltf::SkinOptions skin;
  skin.max_influences = options.value("influences", 4);
  skin.name = std::filesystem::path(name_).stem().string();
  skin.edges = edges_;
  skin.turn = app::turn_upright(app::up_axis(app::UpAxis::kAuto, points_));
  skin.cage_edges = view::as_facets(shown_.edges);
  return gltf::export_skin<Dim>(cage_.points, points_, weights_, surface_, skin).content;
}

template <int Dim>
std::string Work<Dim>::weight_file(const Json& options) const {
  const bool is_of_mesh = options.value("of", std::string("model")) == "mesh";
  return bytes_of("weights." + options.value("format", std::string("npy")), [&](const auto& file) {
    io::write_weights(file, is_of_mesh ? of_mesh_ : weights_);
  });
}

template <int Dim>
std::string Work<Dim>::cage_file() const {
  return bytes_of("saved_cage.obj", [&](const auto& file) { app::write_cage(file, cage_); });
}

template <int Dim>
std::string Work<Dim>::mesh_file() const {
  return bytes_of(Dim == 2 ? "domain.obj" : "domain.mesh",
                  [&](const auto& file) { io::write_domain<Dim>(file, mesh_); });
}

template <int Dim>
PointList<Dim> Work<Dim>::posed(const PointList<Dim>& control_points) const {
  return points_ + deform<Dim>(weights_, control_points - cage_.points);
}

template <int Dim>
std::string Work<Dim>::model_file(const PointList<Dim>& control_points,
                                  const std::string& extension) const {
  const auto points = posed(control_points);
  return bytes_of("posed." + extension, [&](const std::string& file) {
    if (file_) return app::MovableModel<Dim>({name_, file}).write(file, points, {}, 0);
    auto model = made_;
    for (std::size_t p = 0; p < model.soup.points.size(); ++p) {
      model.soup.points[p].template head<Dim>() = points.col(static_cast<Eigen::Index>(p));
    }
    io::write_model(file, model);
  });
}

template class Work<2>;
template class Work<3>;

}  // namespace flbc::web
