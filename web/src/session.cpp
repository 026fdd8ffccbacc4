// SPDX-License-Identifier: BSD-3-Clause
// What JavaScript calls: call(name, arguments, report). Exceptions of C++ mean nothing to
// JavaScript, so they become objects {error}.
#include <emscripten.h>
#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <filesystem>
#include <fstream>

#include "flbc/version.h"
#include "work.h"

namespace flbc::web {
namespace {

using emscripten::val;

val from_json(const std::string& text) {
  return val::global("JSON").call<val>("parse", text);
}

Json to_json(const val& object) {
  if (object.isUndefined() || object.isNull()) return Json::object();
  return Json::parse(val::global("JSON").call<std::string>("stringify", object));
}

// Copied out of the memory of the module, which may grow.
template <class Number>
val array_of(const Number* numbers, std::size_t count) {
  return val(emscripten::typed_memory_view(count, numbers)).template call<val>("slice");
}

val bytes_of(const std::string& text) {
  return array_of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

template <class Matrix>
val matrix_array(const Matrix& matrix) {
  return array_of(matrix.data(), static_cast<std::size_t>(matrix.size()));
}

template <class Matrix>
Matrix matrix_in(const val& array) {
  using Number = typename Matrix::Scalar;
  const auto numbers = emscripten::convertJSArrayToNumberVector<Number>(array);
  constexpr Eigen::Index kRows = Matrix::RowsAtCompileTime;
  return Eigen::Map<const Matrix>(numbers.data(), kRows,
                                  static_cast<Eigen::Index>(numbers.size()) / kRows);
}

val weight_arrays(const SparseWeights& weights) {
  const std::vector<std::uint32_t> starts(weights.starts().begin(), weights.starts().end());
  const std::vector<float> values(weights.values().begin(), weights.values().end());
  auto result = val::object();
  result.set("starts", array_of(starts.data(), starts.size()));
  result.set("controlPoints", array_of(weights.control_points().data(), values.size()));
  result.set("values", array_of(values.data(), values.size()));
  return result;
}

// In double precision, so that another worker continues from the same numbers.
template <int Dim>
val solution_arrays(const Work<Dim>& work) {
  const auto& weights = work.weights_of_mesh();
  const std::vector<std::uint32_t> starts(weights.starts().begin(), weights.starts().end());
  auto result = val::object();
  result.set("points", matrix_array(work.mesh().points));
  result.set("cells", matrix_array(work.mesh().cells));
  result.set("starts", array_of(starts.data(), starts.size()));
  result.set("controlPoints", array_of(weights.control_points().data(), weights.values().size()));
  result.set("values", array_of(weights.values().data(), weights.values().size()));
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

io::Model model_of_triangles(const val& points, const val& triangles) {
  const auto places = matrix_in<PointList<3>>(points);
  const auto corners = matrix_in<FacetList<3>>(triangles);
  io::Model model;
  for (const auto& place : places.colwise()) model.soup.points.emplace_back(place);
  for (const auto& corner : corners.colwise()) {
    if (corner.minCoeff() < 0 || corner.maxCoeff() >= places.cols()) {
      throw InputError("triangles: an index is out of range");
    }
    model.soup.polygons.emplace_back(corner.begin(), corner.end());
  }
  return model;
}

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

using Session = std::variant<std::monostate, Work<2>, Work<3>>;

template <int Dim>
val call_work(Work<Dim>& work, const std::string& name, const val& given, const Report& report) {
  const auto json = [](const Json& facts) { return from_json(facts.dump()); };
  const auto options = [&] { return to_json(given); };
  const auto text = [&](const char* key, const char* usual = "") {
    return given.hasOwnProperty(key) ? given[key].template as<std::string>() : std::string(usual);
  };
  const auto pose = [&] { return matrix_in<PointList<Dim>>(given["points"]); };
  if (name == "makeCage") return json(work.make_cage(options(), report));
  if (name == "readCage") return json(work.read_cage(text("name")));
  if (name == "repairCage") return json(work.repair_cage());
  if (name == "setCage") {
    work.set_cage({pose(), matrix_in<FacetList<Dim>>(given["facets"])});
  } else if (name == "setMesh") {
    work.set_mesh({pose(), matrix_in<CellList<Dim>>(given["cells"])});
  } else if (name == "setSolution") {
    work.set_solution({pose(), matrix_in<CellList<Dim>>(given["cells"])},
                      weights_in(given, work.cage().size()));
  } else if (name == "solution") {
    return solution_arrays(work);
  } else if (name == "makeMesh") {
    return json(work.make_mesh(options(), report));
  } else if (name == "solve") {
    return json(work.solve(options(), report));
  } else if (name == "move") {
    const auto facts = work.move(options());
    auto reply = json(facts);
    if (facts.contains("refused")) return reply;
    reply.set("rest", matrix_array(work.cage().points));
    reply.set("weights", weight_arrays(work.shown_weights()));
    return reply;
  } else if (name == "reduce") {
    return json(work.reduce(options(), report));
  } else if (name == "points") {
    return matrix_array(work.points());
  } else if (name == "cage") {
    auto cage = val::object();
    cage.set("points", matrix_array(work.cage().points));
    cage.set("facets", matrix_array(work.cage().facets));
    return cage;
  } else if (name == "weights") {
    return weight_arrays(work.weights());
  } else if (name == "harmonicWeights") {
    return weight_arrays(work.harmonic());
  } else if (name == "deform") {
    return matrix_array(work.posed(pose()));
  } else if (name == "content") {
    return bytes_of(work.content(text("picture")));
  } else if (name == "page") {
    return bytes_of(work.page(text("picture")));
  } else if (name == "glb") {
    return bytes_of(work.glb(options()));
  } else if (name == "weightFile") {
    return bytes_of(work.weight_file(options()));
  } else if (name == "cageFile") {
    return bytes_of(work.cage_file());
  } else if (name == "meshFile") {
    return bytes_of(work.mesh_file());
  } else if (name == "modelFile") {
    return bytes_of(work.model_file(pose(), text("extension", "obj")));
  } else {
    throw OptionError(name + ": there is no such step");
  }
  return val::undefined();
}

template <int Dim>
val facts_of(const Work<Dim>& work) {
  auto facts = val::object();
  facts.set("dim", Dim);
  facts.set("vertices", static_cast<int>(work.points().cols()));
  return facts;
}

val run(Session& session, const std::string& name, const val& given, const Report& report) {
  if (name == "version") return val(std::string(FLBC_VERSION));
  if (name == "memory") return val(static_cast<double>(emscripten_get_heap_size()));
  if (name == "addFile") {
    const auto bytes = given["bytes"].as<std::string>();
    std::ofstream file(given["name"].as<std::string>(), std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return val::undefined();
  }
  if (name == "readModel") {
    const auto file = given["name"].as<std::string>();
    session = std::monostate();  // its memory comes first
    return std::visit(
        [&](auto facets) {
          constexpr int kDim = decltype(facets.points)::RowsAtCompileTime;
          return facts_of(session.emplace<Work<kDim>>(file, std::move(facets)));
        },
        app::load_model_facets(file));
  }
  if (name == "setModel") {
    auto model = model_of_triangles(given["points"], given["triangles"]);
    return facts_of(session.emplace<Work<3>>("model.obj", std::move(model)));
  }
  return std::visit(
      [&](auto& work) -> val {
        if constexpr (std::is_same_v<std::decay_t<decltype(work)>, std::monostate>) {
          throw OptionError(name + ": there is no model yet");
        } else {
          return call_work(work, name, given, report);
        }
      },
      session);
}

val error_object(const char* kind, const std::string& message,
                 const std::vector<Index>& where = {}) {
  auto error = val::object();
  error.set("kind", std::string(kind));
  error.set("message", message);
  error.set("controlPoints", array_of(where.data(), where.size()));
  auto result = val::object();
  result.set("error", error);
  return result;
}

class Bound {
 public:
  Bound() {
    std::filesystem::create_directory("/work");
    std::filesystem::current_path("/work");
  }

  val call(const std::string& name, const val& given, const val& report) {
    try {
      auto result = val::object();
      result.set("result", run(session_, name, given, throttled(report)));
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
  Session session_;
};

EMSCRIPTEN_BINDINGS(flbc) {
  emscripten::class_<Bound>("Session").constructor<>().function("call", &Bound::call);
}

}  // namespace
}  // namespace flbc::web
