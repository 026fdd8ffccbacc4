// SPDX-License-Identifier: BSD-3-Clause
// A model with its cage and weights, as JavaScript calls it: call(name, arguments, report). Names
// and arguments are in flbc.d.ts. Exceptions of C++ mean nothing to JavaScript, so they become
// {error}.
#include <emscripten.h>
#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "flbc/bounding_box.h"
#include "flbc/cage_facts.h"
#include "flbc/coordinates.h"
#include "flbc/deform.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "flbc/masks.h"
#include "flbc/report.h"
#include "flbc/rig.h"
#include "flbc/sparsify.h"
#include "flbc/version.h"
#include "front/bound_model.h"
#include "front/estimate.h"
#include "front/load.h"
#include "front/locality_file.h"
#include "front/make_domain.h"
#include "front/model_facets.h"
#include "front/model_page.h"
#include "front/movable_model.h"
#include "front/up_axis.h"
#include "gltf/skin.h"
#include "model/bitmap.h"
#ifdef FLBC_LINKS_CGAL
#include "flbc/cage_from_model.h"
#include "flbc/repair_cage.h"
#endif

namespace flbc::web {
namespace {

using emscripten::val;
using Json = nlohmann::ordered_json;

// Receives the name of a stage and its progress in [0, 1].
using Report = std::function<void(const char* stage, double done)>;

constexpr const char* kCageFile = "cage.obj";
constexpr const char* kLocalityFile = "locality.json";
// Files of the model, and those of the session, which replace none of them.
const std::string kModelFolder = "/model/", kOwnFolder = "/own/";

void write_file(const std::string& name, const val& bytes) {
  const auto folder = std::filesystem::path(name).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  std::ofstream file(name, std::ios::binary);
  if (!(file << bytes.as<std::string>() << std::flush)) {
    throw InputError(name + ": there cannot be a file of this name");
  }
}

// While files of the session are read by their names.
struct InOwnFolder {
  InOwnFolder() { std::filesystem::current_path(kOwnFolder); }
  ~InOwnFolder() { std::filesystem::current_path(kModelFolder); }
};

// A cage with defects, and where they are.
class DefectiveCage : public InputError {
 public:
  DefectiveCage(const std::string& message, std::vector<Index> control_points)
      : InputError(message), control_points(std::move(control_points)) {}
  std::vector<Index> control_points;
};

// ----------------------------------------------------------------------------- objects and arrays

val from_json(const Json& facts) {
  return val::global("JSON").call<val>("parse", facts.dump());
}

Json to_json(const val& object) {
  return Json::parse(val::global("JSON").call<std::string>("stringify", object));
}

// Copied out of the memory of the module, which may grow.
template <class Number>
val array_of(const Number* numbers, std::size_t count) {
  return val(emscripten::typed_memory_view(count, numbers)).template call<val>("slice");
}

template <class Numbers>
val array_of(const Numbers& numbers) {
  return array_of(numbers.data(), static_cast<std::size_t>(numbers.size()));
}

val bytes_of(const std::string& text) {
  return array_of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

// Writes a file by its name and takes its bytes.
template <class Write>
val bytes_of(const std::string& name, const Write& write) {
  const auto file = kOwnFolder + name;
  write(file);
  const auto bytes = io::read_file(file);
  std::filesystem::remove(file);
  return bytes_of(bytes);
}

template <class Matrix>
Matrix matrix_in(const val& array) {
  using Number = typename Matrix::Scalar;
  const auto numbers = emscripten::convertJSArrayToNumberVector<Number>(array);
  constexpr Eigen::Index kRows = Matrix::RowsAtCompileTime;
  return Eigen::Map<const Matrix>(numbers.data(), kRows,
                                  static_cast<Eigen::Index>(numbers.size()) / kRows);
}

template <class Number>
void set_weights(val& object, const SparseWeights& weights) {
  const std::vector<std::uint32_t> starts(weights.starts().begin(), weights.starts().end());
  const std::vector<Number> values(weights.values().begin(), weights.values().end());
  object.set("starts", array_of(starts));
  object.set("controlPoints", array_of(weights.control_points().data(), values.size()));
  object.set("values", array_of(values));
}

val weight_arrays(const SparseWeights& weights) {
  auto result = val::object();
  set_weights<float>(result, weights);
  return result;
}

SparseWeights weights_in(const val& arrays, Index num_control_points) {
  using emscripten::convertJSArrayToNumberVector;
  const auto starts = convertJSArrayToNumberVector<std::uint32_t>(arrays["starts"]);
  return {num_control_points,
          {starts.begin(), starts.end()},
          convertJSArrayToNumberVector<std::uint32_t>(arrays["controlPoints"]),
          convertJSArrayToNumberVector<double>(arrays["values"])};
}

// ---------------------------------------------------------------------------------------- options

SolverOptions solver_options(const Json& options) {
  SolverOptions result;
  if (options.contains("smoothness")) result.smoothness = options["smoothness"].get<double>();
  if (options.contains("tolerance")) result.tolerance = options["tolerance"].get<double>();
  const auto take_named = [&](const char* option, auto& value) {
    if (!options.contains(option)) return;
    const auto name = options[option].get<std::string>();
    const auto named = value_named<std::decay_t<decltype(value)>>(name);
    if (!named) throw OptionError(std::string(option) + ": invalid value '" + name + "'");
    value = *named;
  };
  take_named("distances", result.distances);
  take_named("precision", result.precision);
  return result;
}

// Writes an outline as triangles of its interior. Texture coordinates spread a picture over it.
void write_filled(const std::string& file, const app::ModelFacets<2>& outline) {
  constexpr Index kVertices = 2000;
  const Cage<2> cage{outline.points, outline.facets};
  const auto mesh = app::make_domain<2>({cage, "the polygon", kVertices}).mesh;
  io::Model model{io::to_polygons(mesh)};
  const Vector<2> low = outline.points.rowwise().minCoeff();
  const Vector<2> size = outline.points.rowwise().maxCoeff() - low;
  model.attributes.texture_coordinates =
      (mesh.points.colwise() - low).array().colwise() / size.array();
  for (const auto& polygon : model.soup.polygons) {
    auto& corners = model.attributes.corners.emplace_back();
    for (const Index p : polygon) corners.push_back({p, -1});
  }
  io::write_model(file, model);
}

void write_triangles(const std::string& file, const app::ModelFacets<3>& triangles) {
  io::Model model;
  for (const auto& point : triangles.points.colwise()) model.soup.points.emplace_back(point);
  for (const auto& corner : triangles.facets.colwise()) {
    if (corner.minCoeff() < 0 || corner.maxCoeff() >= triangles.points.cols()) {
      throw InputError("triangles: an index is out of range");
    }
    model.soup.polygons.emplace_back(corner.begin(), corner.end());
  }
  io::write_model(file, model);
}

// ---------------------------------------------------------------------------------- model and cage

template <int Dim>
class Work {
 public:
  // \param facets  of the file
  Work(const std::string& name, app::ModelFacets<Dim> facets)
      : name_(name), file_(name), facets_(std::move(facets)) {
    if constexpr (Dim == 2) {
      if (io::read_polygons(name).polygons.empty()) {
        file_ = kOwnFolder + "filled.obj";
        write_filled(file_, facets_);
      }
    }
    model_.emplace(app::MovedFile{file_, file_});
    edges_ = model_->edges();
    if (!model_->model()->soup.polygons.empty()) surface_ = model_->surface();
  }

  val facts() const {
    return from_json({{"dim", Dim}, {"vertices", points().cols()}, {"isFilled", file_ != name_}});
  }

  val call(const std::string& name, const val& given, const Report& report) {
    const auto options = [&] { return to_json(given); };
    const auto text = [&](const char* key, const char* usual = "") {
      const bool is_given = given.hasOwnProperty(key) && !given[key].isUndefined();
      return is_given ? given[key].template as<std::string>() : usual;
    };
    const auto places = [&] { return matrix_in<PointList<Dim>>(given["points"]); };
    const auto pose = [&] { return pose_in(given["points"]); };
    const auto mesh = [&]() -> DomainMesh<Dim> {
      return {places(), matrix_in<CellList<Dim>>(given["cells"])};
    };
    report_ = name == "move" ? Report() : report;  // moves are short
    first_excess_ = 0;
    if (name == "makeCage") {
      const auto density = density_in(given["density"]);
      auto others = given;
      others.set("density", val::undefined());  // as text it would be long
      return make_cage(options(), density, report);
    }
    if (name == "readCage") return read_cage(text("name"), given["bytes"]);
    if (name == "repairCage") return repair_cage();
    if (name == "setCage") return set_cage({places(), matrix_in<FacetList<Dim>>(given["facets"])});
    if (name == "compose") {
      return compose({places(), matrix_in<FacetList<Dim>>(given["facets"])},
                     weights_in(given, places().cols()), given["isCurved"].isTrue());
    }
    if (name == "makeMesh") return make_mesh(options(), report);
    if (name == "setMesh") return set_mesh(mesh(), {});
    if (name == "setSolution") {
      return set_solution(
          mesh(), weights_in(given, inner().size()),
          given.hasOwnProperty("options") ? to_json(given["options"]) : Json::object());
    }
    if (name == "solve") return solve(options());
    if (name == "protect") return protect();
    if (name == "reduce") return reduce(options(), report);
    if (name == "move") return move(given);
    if (name == "solution") return solution();
    if (name == "points") return array_of(points());
    if (name == "cage") return cage();
    if (name == "weights") return weight_arrays(weights());
    if (name == "harmonicWeights") return weight_arrays(harmonic());
    if (name == "deform") return array_of(binding().deform(pose()));
    if (name == "content") return bytes_of(view::make_content(content(text("picture"))));
    if (name == "glb") return glb(given);
    if (name == "weightFile") return weight_file(text("of"), text("format", "npy"));
    if (name == "cageFile") return cage_file();
    if (name == "meshFile") return mesh_file();
    if (name == "modelFile") return model_file(pose(), text("extension", "obj"));
    if (name == "picture") return picture(given);
    if (name == "drawing") return drawing(text("text"), given["placing"], pose());
    throw OptionError(name + ": there is no such step");
  }

 private:
  const PointList<Dim>& points() const { return model_->points(); }

  Json cage_facts() const {
    return {{"controlPoints", cage_.size()}, {"facets", cage_.facets.cols()}};
  }

  val cage() const {
    auto result = val::object();
    result.set("points", array_of(cage_.points));
    result.set("facets", array_of(cage_.facets));
    return result;
  }

  val set_cage(Cage<Dim> cage) {
    const InOwnFolder folder;
    app::write_cage(kCageFile, cage);
    show_cage(std::move(cage), kCageFile);
    return from_json(cage_facts());
  }

  void show_cage(Cage<Dim> cage, const std::string& file) {
    rig_.reset();
    bound_.reset();
    few_ = {};
    map_.reset();
    cage_ = std::move(cage);
    shown_ = app::load_shown_cage<Dim>(file);
  }

  // Other control points, which move those of the cage.
  val compose(Cage<Dim> outer, SparseWeights map, bool is_curved) {
    auto solved = inner();
    set_cage(std::move(outer));
    inner_ = std::move(solved);
    map_ = std::move(map);
    shown_.is_curved = is_curved;
    return from_json(cage_facts());
  }

  // The cage whose interior is meshed.
  const Cage<Dim>& inner() const { return map_ ? inner_ : cage_; }

  // By the control points that are shown.
  SparseWeights composed(const SparseWeights& weights) const {
    return map_ ? flbc::compose(weights, *map_) : weights;
  }
  Binding<Dim> whole_binding() {
    auto binding = rig().binding();
    return map_ ? binding.composed(*map_, cage_) : binding;
  }

  // A binding by the inner cage, with its mesh, and a pose of that cage.
  Binding<Dim> inner_binding() { return map_ ? rig().binding() : binding(); }
  PointList<Dim> inner_pose(const PointList<Dim>& pose) const {
    return map_ ? flbc::deform<Dim>(*map_, pose) : pose;
  }

  // Control points of the inner cage that others move, or the other way around.
  std::vector<Index> linked(const std::vector<Index>& control_points, bool outward) const {
    if (!map_) return control_points;
    std::set<Index> result;
    const std::set<Index> given(control_points.begin(), control_points.end());
    for (Index i = 0; i < map_->num_points(); ++i) {
      map_->visit(i, [&](Index j, double) {
        if (given.count(outward ? i : j) > 0) result.insert(outward ? j : i);
      });
    }
    return {result.begin(), result.end()};
  }

  // Of what the cage encloses. \param given  a number for each vertex, or undefined
  Eigen::VectorXd density_in(const val& given) const {
    if (given.isUndefined()) return {};
    const auto all = emscripten::convertJSArrayToNumberVector<double>(given);
    const Eigen::Map<const Eigen::VectorXd> numbers(all.data(), Index(all.size()));
    if (numbers.size() != points().cols()) {
      throw OptionError("density: needs a number for each of " + std::to_string(points().cols()) +
                        " vertices");
    }
    if (file_ == name_) return facets_.left_of(numbers);
    Eigen::VectorXd result(
        facets_.points.cols());  // of an outline, whose interior has the vertices
    for (Index v = 0; v < result.size(); ++v) {
      Index nearest = 0;
      (points().colwise() - facets_.points.col(v)).colwise().squaredNorm().minCoeff(&nearest);
      result(v) = numbers(nearest);
    }
    return result;
  }

#ifdef FLBC_LINKS_CGAL
  val make_cage(const Json& options, const Eigen::VectorXd& density, const Report& report) {
    const double size = bounding_box_diagonal<Dim>(facets_.points);
    CagingOptions caging;
    caging.control_points = options.value("controlPoints", 0);
    caging.offset = options.value("offset", 0.0) * size;
    caging.symmetry = symmetry_named(options.value("symmetry", "auto"));
    caging.density = density;
    caging.stage = [&](CagingStage stage, double done) { report(name_of(stage), done); };
    const auto made = app::naming(
        name_, [&] { return cage_from_model<Dim>(facets_.points, facets_.facets, caging); });
    set_cage(made.cage);
    auto facts = cage_facts();
    facts["offset"] = made.offset / size;
    facts["note"] = describe_bridged_gaps(made);
    facts["symmetry"] = made.symmetry_axis < 0 ? "none" : std::string(1, "xyz"[made.symmetry_axis]);
    return from_json(facts);
  }

  val repair_cage() {
    const auto repaired = flbc::repair_cage<Dim>(cage_);
    set_cage(repaired.cage);
    auto facts = cage_facts();
    facts["changes"] = repaired.changes;
    return from_json(facts);
  }
#else
  val make_cage(const Json&, const Eigen::VectorXd&, const Report&) {
    return repair_cage();
  }
  val repair_cage() {
    throw OptionError("this module was built without CGAL and cannot make or repair cages");
  }
#endif

  // A defective cage is kept, to be shown or repaired.
  val read_cage(const std::string& file, const val& bytes) {
    const InOwnFolder folder;
    write_file(file, bytes);
    const auto any = io::to_cage(io::read_polygons(file), file);
    const auto* const cage = std::get_if<Cage<Dim>>(&any);
    if (cage == nullptr) {
      throw InputError(file + ": the model is in " + std::to_string(Dim) +
                       "D, but the cage is not; both need the same dimension");
    }
    show_cage(*cage, file);
    auto defects = find_defects(cage_);
#ifdef FLBC_LINKS_CGAL
    if (defects.empty()) defects = find_self_intersections(cage_);
#endif
    if (defects.empty()) return from_json(cage_facts());
    std::vector<Index> where;
    for (const auto& defect : defects) {
      where.insert(where.end(), defect.vertices.begin(), defect.vertices.end());
      for (const Index f : defect.facets) {
        where.insert(where.end(), cage_.facets.col(f).begin(), cage_.facets.col(f).end());
      }
    }
    throw DefectiveCage(file + ": " + defects.front().message, where);
  }

  // ----------------------------------------------------------------------------- mesh and weights

  val make_mesh(const Json& options, const Report& report) {
    require_inside();
    report("filling the cage", 0);
    auto made = app::make_domain<Dim>({inner(), kCageFile, options.value("vertices", 0)});
    const auto note = made.note;
    set_mesh(std::move(made), {});
    const auto& mesh = rig_->mesh();
    // Twice the time of the native program.
    const auto estimate = app::estimate_solve(Dim, inner().size(), mesh.num_vertices(), {});
    return from_json({{"vertices", mesh.num_vertices()},
                      {"cells", mesh.num_cells()},
                      {"note", note},
                      {"seconds", 2 * estimate.seconds}});
  }

  // \param mesh  a DomainMesh or a MadeDomain \param options  of the solver
  template <class Mesh>
  val set_mesh(Mesh mesh, const Json& options) {
    require_inside();
    BindOptions binding;
    binding.solver = solver_options(options);
    binding.observer.progress = [this](const Progress& progress) {
      show_progress(progress);
      return true;
    };
    binding.observer.stage = [this](Stage stage, double done) {
      if (report_) report_(stage == Stage::kDistances ? "measuring distances" : "solving", done);
    };
    rig_ = std::make_unique<Rig<Dim>>(inner(), std::move(mesh), points(), edges_, binding);
    bound_.reset();
    return val::undefined();
  }

  void show_progress(const Progress& progress) {
    if (!report_) return;
    const double excess = std::log(
        std::max({progress.relative_primal_residual, progress.relative_dual_residual, 1.0}));
    first_excess_ = std::max(first_excess_, excess);
    report_("solving", first_excess_ > 0 ? 1 - excess / first_excess_ : 0);
  }

  Rig<Dim>& rig() {
    if (!rig_) throw OptionError("there is no mesh of the cage yet: call makeMesh");
    return *rig_;
  }

  // Refuses vertices of faces outside, before a mesher starts.
  void require_inside() const {
    if (usual_policy(inner(), points(), edges_) != OutsidePoints::kFail) return;
    try {
      place_points(inner(), points());
    } catch (const InputError& error) {
      const std::string message = error.what();  // with advice for users of the library
      throw InputError(name_ + ": " + message.substr(0, message.find("; choose")) +
                       "; enlarge the cage, or make one around the model");
    }
  }

  // The model in the present cage, reduced if it was.
  const Binding<Dim>& binding() {
    if (!bound_) bound_ = whole_binding();
    return *bound_;
  }
  const SparseWeights& weights() {
    return binding().weights;
  }

  val solve(const Json& options) {
    auto binding = rig().options();
    const auto before = binding.solver;
    binding.solver = solver_options(options);
    binding.solver.reach = before.reach;
    binding.solver.falloff = before.falloff;
    rig_->set_options(binding);
    solver_given_ = options;
    const auto& of = rig_->solve().report;
    bound_.reset();
    return from_json({{"iterations", of.iterations},
                      {"objective", of.objective},
                      {"converged", of.status == SolveStatus::kConverged}});
  }

  // Takes masks, reach, and falloff of a locality file for the next solve, unless vertices cannot
  // obey.
  val protect() {
    auto binding = rig().options();
    const auto locality = app::load_locality(kLocalityFile, cage_, points(), file_);
    binding.masks = locality.masks;
    for (auto& mask : binding.masks) mask.control_points = linked(mask.control_points, false);
    binding.solid = locality.solid;
    binding.solver.reach = locality.reach;
    if (map_ && !locality.reach.empty()) {
      auto& reach = binding.solver.reach;
      reach.assign(inner_.size(), 0);
      for (Index i = 0; i < inner_.size(); ++i) {
        map_->visit(i, [&](Index j, double share) { reach[i] += share * locality.reach[j]; });
      }
    }
    binding.solver.falloff = locality.falloff;
    Index on_facets = 0;
    end_at_facets(inner(), points(), binding.masks, &on_facets);
    Json reply{{"masks", Json::array()},  {"reach", locality.reach}, {"falloff", locality.falloff},
               {"solid", locality.solid}, {"freed", locality.freed}, {"onFacets", on_facets}};
    for (const auto& [control_points, region] : locality.masks) {
      reply["masks"].push_back({{"controlPoints", control_points}, {"vertices", region}});
    }
    try {
      rig_->set_options(binding);
      bound_.reset();
    } catch (const MaskConflict& conflict) {
      reply["conflict"] = {{"vertices", conflict.points},
                           {"controlPoints", linked(conflict.control_points, true)}};
    }
    return from_json(reply);
  }

  // In double precision, so that another worker continues from the same numbers.
  val solution() {
    auto result = val::object();
    result.set("points", array_of(rig().mesh().points));
    result.set("cells", array_of(rig().mesh().cells));
    set_weights<double>(result, rig().solution().weights);
    result.set("options", from_json(solver_given_));
    return result;
  }

  val set_solution(DomainMesh<Dim> mesh, SparseWeights weights, const Json& options) {
    set_mesh(std::move(mesh), options);
    solver_given_ = options;
    rig_->set_solution({std::move(weights), {}});
    return val::undefined();
  }

  val move(const val& request) {
    // Long enough to converge after most moves, short enough to be interrupted.
    const auto options = to_json(request);
    const Budget budget{0, options.value("seconds", 0.25)};
    try {
      if (options.value("refine", false)) {
        rig().solve(budget);
      } else {
        const auto rest = pose_in(request["points"]);
        rig().reshape(inner_pose(rest), budget);
        cage_.points = rest;
      }
    } catch (const Error& error) {
      return from_json({{"refused", error.what()}});
    }
    bound_.reset();
    (map_ ? inner_ : cage_) = rig_->cage();
    shown_.points = cage_.points;
    const auto& report = rig_->solution().report;
    auto reply = from_json(
        {{"converged", report.status == SolveStatus::kConverged},
         {"iterations", report.iterations},
         {"residual", std::max(report.relative_primal_residual, report.relative_dual_residual)}});
    reply.set("rest", array_of(cage_.points));
    reply.set("weights", weight_arrays(shown_weights()));
    return reply;
  }

  val reduce(const Json& options, const Report& report) {
    SparsifyOptions limits{options.value("influences", 8)};
    limits.progress = [&](double done) { report("reducing influences", done); };
    limits.start = few_;
    bound_ = whole_binding().reduced(limits);
    few_ = bound_->weights;
    return from_json({{"influences", limits.max_influences}});
  }

  SparseWeights harmonic() {
    const auto solution = compute_coordinates(inner(), rig().mesh(), Coordinates::kHarmonic);
    return composed(weights_at(inner(), rig_->mesh(), solution.weights, rig_->placement()));
  }

  PointList<Dim> pose_in(const val& numbers) const {
    const auto count = numbers.isUndefined() ? 0 : numbers["length"].template as<Eigen::Index>();
    if (count == cage_.points.size()) return matrix_in<PointList<Dim>>(numbers);
    throw InputError("a pose of " + std::to_string(count) +
                     " numbers is not one of this cage, which has " +
                     std::to_string(cage_.points.size()));
  }

  // ------------------------------------------------------------------------------ page and files

  // With as few influences as a page shows; none before solve().
  SparseWeights shown_weights() {
    if (!rig_ || rig_->solution().weights.num_points() == 0) {
      return {cage_.size(), std::vector<std::int64_t>(points().cols() + 1), {}, {}};
    }
    return view::limit_influences(binding(), view::kMostInfluences);
  }

  std::string title() const {
    return std::filesystem::path(name_).stem().string();
  }

  // \param picture  data URI of a texture in place of the materials, or empty
  view::PageContent<Dim> content(const std::string& picture) {
    view::PageContent<Dim> result{title(), name_,    "weights.npy", kCageFile,
                                  shown_,  points(), surface_,      shown_weights()};
    app::look_from_front(result, app::up_of(app::UpAxis::kAuto, file_));
    result.picture = picture;
    return result;
  }

  val glb(const val& given) {
    const auto options = to_json(given);
    gltf::SkinOptions skin;
    skin.max_influences = options.value("influences", 4);
    skin.rigid = options.value("rigid", false);
    skin.name = title();
    const auto up = app::up_of(app::UpAxis::kAuto, file_);
    skin.turn = app::turn_upright(app::up_axis(up, points()));
    gltf::Animation<Dim> animation{options.value("times", std::vector<double>())};
    if (given.hasOwnProperty("poses")) {
      for (const auto& pose : emscripten::vecFromJSArray<val>(given["poses"])) {
        animation.poses.push_back(pose_in(pose));
      }
    }
    return bytes_of(gltf::export_skin<Dim>(binding(), surface_, skin, animation).content);
  }

  val weight_file(const std::string& of, const std::string& format) {
    return bytes_of("weights." + format, [&](const auto& file) {
      if (of == "mesh") return io::write_weights(file, composed(rig().solution().weights));
      app::write_binding(file, binding());
    });
  }

  val cage_file() const {
    return bytes_of("saved_cage.obj", [&](const auto& file) { app::write_cage(file, cage_); });
  }

  val mesh_file() {
    return bytes_of(Dim == 2 ? "domain.obj" : "domain.mesh",
                    [&](const auto& file) { io::write_domain<Dim>(file, rig().mesh()); });
  }

  val model_file(const PointList<Dim>& pose, const std::string& extension) {
    return bytes_of("posed." + extension, [&](const std::string& file) {
      app::MovableModel<Dim>({file_, file}).write(file, binding().deform(pose), {}, 0);
    });
  }

  // A document in SVG where the pose takes it. What is outside of the cage stays.
  // \param placing  page: its width and height; matrix: from there to the model, as in SVG
  val drawing(const std::string& text, const val& placing, const PointList<Dim>& pose) {
    if constexpr (Dim == 3) {
      throw InputError("a drawing needs a model in 2D");
    } else {
      Eigen::Affine2d to_model;
      to_model.matrix() << matrix_in<Eigen::Matrix<double, 2, Eigen::Dynamic>>(placing["matrix"]),
          Eigen::RowVector3d(0, 0, 1);
      const Vector<2> page = matrix_in<PointList<2>>(placing["page"]).col(0);
      const io::SvgDocument document(text, name_, page, to_model);
      const auto moved =
          inner_binding().deform(inner_pose(pose), document.points(), OutsidePoints::kKeep);
      auto result = val::object();
      result.set("text", document.moved(moved));
      result.set("notes", from_json(Json(document.notes())));
      return result;
    }
  }

  // A picture where poses take it, and a sprite sheet of them if it has a name. Arguments as in
  // flbc.d.ts.
  val picture(const val& given) {
    if constexpr (Dim == 3) {
      throw InputError("a picture needs a model in 2D");
    } else {
      const auto pixels = given["pixels"];
      const io::Bitmap source{
          pixels["width"].template as<Index>(), pixels["height"].template as<Index>(), 4,
          emscripten::convertJSArrayToNumberVector<std::uint8_t>(pixels["data"])};
      std::vector<PointList<2>> poses;
      for (const auto& pose : emscripten::vecFromJSArray<val>(given["poses"])) {
        poses.push_back(inner_pose(pose_in(pose)));
      }
      const auto has = [&](const char* key) { return !given[key].isUndefined(); };
      Vector<2> size(0, 0);
      if (has("size")) size = matrix_in<PointList<2>>(given["size"]).col(0);
      const auto number = [&](const char* key, double usual) {
        return has(key) ? given[key].template as<double>() : usual;
      };
      const auto shown = [](const io::Bitmap& moved) {
        auto result = from_json({{"width", moved.width},
                                 {"height", moved.height},
                                 {"left", moved.left},
                                 {"top", moved.top}});
        result.set("data", array_of(std::get<std::vector<std::uint8_t>>(moved.samples)));
        return result;
      };
      const auto sheet = has("sheet") ? given["sheet"].template as<std::string>() : "";
      std::vector<io::Bitmap> cells;
      std::vector<std::string> names;
      auto frames = val::array();
      io::warp(source, inner_binding(), poses, number("scale", 1), size,
               [&](std::size_t k, io::Bitmap moved) {
                 frames.call<void>("push", shown(moved));
                 names.push_back(app::with_number("frame_%04d.png", std::int64_t(k) + 1));
                 if (!sheet.empty()) cells.push_back(std::move(moved));
               });
      auto result = val::object();
      result.set("frames", frames);
      if (sheet.empty()) return result;
      std::string json;
      const double seconds = 1 / number("fps", 12);
      result.set("sheet", shown(io::sprite_sheet(cells, names, sheet, seconds, json)));
      result.set("json", json);
      return result;
    }
  }

  std::string name_;
  std::string file_;              // of the model, or of its interior if it is an outline
  app::ModelFacets<Dim> facets_;  // what the cage is to enclose
  std::optional<app::MovableModel<Dim>> model_;
  gltf::Surface surface_;
  EdgeList edges_;
  Cage<Dim> cage_;                    // of the control points that are shown
  Cage<Dim> inner_;                   // that these move, if there is a map
  std::optional<SparseWeights> map_;  // weights of the inner cage for them
  view::ShownCage<Dim> shown_;
  std::unique_ptr<Rig<Dim>> rig_;      // once there is a mesh
  std::optional<Binding<Dim>> bound_;  // of the last solve
  SparseWeights few_{};                // of the last reduction
  Json solver_given_ = Json::object();
  Report report_;  // of the present step
  double first_excess_ = 0;
};

// -------------------------------------------------------------------------------- calls and errors

// Calls the page at most every 50 ms, but for new stages.
Report throttled(const val& report) {
  struct Last {
    std::string stage;
    double time = 0;
  };
  return [report, last = std::make_shared<Last>()](const char* stage, double done) {
    constexpr double kPause = 50;
    const double now = emscripten_get_now();
    if (report.isUndefined() || (last->stage == stage && now - last->time < kPause)) return;
    *last = {stage, now};
    report(std::string(stage), done);
  };
}

val error_object(const char* kind, const std::string& message,
                 const std::vector<Index>& where = {}) {
  auto error = val::object();
  error.set("kind", std::string(kind));
  error.set("message", message);
  error.set("controlPoints", array_of(where));
  auto result = val::object();
  result.set("error", error);
  return result;
}

class Session {
 public:
  Session() {
    for (const auto& folder : {kOwnFolder, kModelFolder}) {
      std::filesystem::create_directory(folder);
      std::filesystem::current_path(folder);
    }
  }

  val call(const std::string& name, const val& given, const val& report) {
    try {
      auto result = val::object();
      result.set("result", run(name, given, throttled(report)));
      return result;
    } catch (const DefectiveCage& error) {
      return error_object("DefectiveCage", error.what(), error.control_points);
    } catch (const InputError& error) {
      return error_object("InputError", error.what());
    } catch (const OptionError& error) {
      return error_object("OptionError", error.what());
    } catch (const std::bad_alloc&) {
      return error_object("OutOfMemory", "the memory that the browser gives to a page is used up");
    } catch (const std::exception& error) {
      return error_object("Error", error.what());
    } catch (...) {
      return error_object("Error", "an unknown error");
    }
  }

 private:
  val run(const std::string& name, const val& given, const Report& report) {
    if (name == "version") return val(std::string(FLBC_VERSION));
    if (name == "memory") return val(static_cast<double>(emscripten_get_heap_size()));
    if (name == "addFile" || name == "readModel") {
      const auto file = given["name"].as<std::string>();
      write_file(file, given["bytes"]);
      return name == "addFile" ? val::undefined() : read_model(file);
    }
    if (name == "setModel") {
      const app::ModelFacets<3> facets{matrix_in<PointList<3>>(given["points"]),
                                       matrix_in<FacetList<3>>(given["triangles"])};
      write_triangles("model.obj", facets);
      return work_.emplace<Work<3>>("model.obj", facets).facts();
    }
    if (work_.valueless_by_exception()) work_ = std::monostate();  // the model was refused
    return std::visit(
        [&](auto& work) -> val {
          if constexpr (std::is_same_v<std::decay_t<decltype(work)>, std::monostate>) {
            throw OptionError(name + ": there is no model yet");
          } else {
            return work.call(name, given, report);
          }
        },
        work_);
  }

  val read_model(const std::string& file) {
    work_ = std::monostate();  // its memory comes first
    return std::visit(
        [&](auto facets) {
          constexpr int kDim = decltype(facets.points)::RowsAtCompileTime;
          return work_.emplace<Work<kDim>>(file, std::move(facets)).facts();
        },
        app::load_model_facets(file));
  }

  std::variant<std::monostate, Work<2>, Work<3>> work_;
};

EMSCRIPTEN_BINDINGS(flbc) {
  emscripten::class_<Session>("Session").constructor<>().function("call", &Session::call);
}

}  // namespace
}  // namespace flbc::web

// The page makes models of pictures.
flbc::app::ModelFacets<2> flbc::app::load_silhouette(const std::string& file) {
  throw OptionError(file + ": pictures cannot be read");
}
