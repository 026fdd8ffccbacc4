// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include <memory>
#include <optional>
#include <type_traits>

#include "flbc/errors.h"
#include "flbc/report.h"

namespace flbc::python {
namespace {

template <class Value>
const char* kind_of() {
  if constexpr (std::is_same_v<Value, bool>) return "True or False";
  if constexpr (std::is_integral_v<Value>) return "an integer";
  return "a number";
}

template <class Value>
Value value_of(const std::string& option, const py::handle& given) {
  try {
    if constexpr (std::is_enum_v<Value>) {
      return named<Value>(option, given.cast<std::string>());
    } else {
      return given.cast<Value>();
    }
  } catch (const py::cast_error&) {
    const std::string wanted = std::is_enum_v<Value> ? "a name" : kind_of<Value>();
    throw OptionError(option + " must be " + wanted + ", not " +
                      py::repr(given).cast<std::string>());
  }
}

void set(SolverOptions& options, const std::string& name, const py::handle& value) {
  const auto take = [&](const char* option, auto& target) {
    if (name == option) target = value_of<std::decay_t<decltype(target)>>(name, value);
  };
  take("method", options.method);
  take("tolerance", options.tolerance);
  take("gap", options.gap);
  take("max_iterations", options.max_iterations);
  take("certify", options.certify);
  take("threads", options.threads);
  take("non_negative", options.non_negative);
  take("phi", options.phi);
  take("smoothness", options.smoothness);
  take("distances", options.distances);
  take("precision", options.precision);
  take("active_set", options.active_set);
  take("penalty", options.penalty);
  take("falloff", options.falloff);
  if (name == "mask" && !value.is_none()) options.masks = masks_of(value.cast<MaskLists>());
  if (name == "reach" && !value.is_none()) options.reach = value.cast<std::vector<double>>();
}

py::list levels_of(const SolveReport& report) {
  using namespace py::literals;
  py::list levels;
  for (const auto& level : report.coarse_levels) {
    levels.append(py::dict("vertices"_a = level.vertices, "cells"_a = level.cells,
                           "iterations"_a = level.iterations,
                           "seconds"_a = py::dict("solve"_a = level.solve_seconds)));
  }
  return levels;
}

}  // namespace

template <class Enum>
Enum named(const std::string& option, const std::string& name) {
  if (const auto value = value_named<Enum>(name)) return *value;
  std::string all;
  auto known = names_of<Enum>();
  if constexpr (std::is_same_v<Enum, Method>) {
    // solve() also takes coordinates, of which Green's have no weights. Solver refuses them here.
    for (const auto& other : names_of<Coordinates>()) {
      if (value_named<Coordinates>(name) || other == name_of(Coordinates::kGreen)) continue;
      known.push_back(other);
    }
  }
  for (const auto& one : known) all += (all.empty() ? "" : ", ") + one;
  throw OptionError(option + " must be one of " + all + ", not " + name);
}
template OutsidePoints named(const std::string&, const std::string&);

BindOptions options_of(const py::dict& keywords) {
  BindOptions options;
  const auto method =
      keywords.contains("method") ? py::str(keywords["method"]).cast<std::string>() : std::string();
  options.coordinates = value_named<Coordinates>(method);
  for (const auto& [key, value] : keywords) {
    const auto name = key.cast<std::string>();
    if (name == "max_influences") {
      options.max_influences = value_of<Index>(name, value);
    } else if (name == "outside") {
      options.outside = value_of<OutsidePoints>(name, value);
    } else if (name == "solid") {
      if (!value.is_none()) options.solid = regions_of(value.cast<std::vector<Indices>>());
    } else if (name == "mirror_axis") {
      options.mirror_axis = value.cast<int>();
    } else if (options.coordinates && (name == "method" || name == "relax" || value.is_none())) {
      continue;
    } else if (options.coordinates && name != "threads" && name != "non_negative") {
      throw OptionError(name + ": the method " + method +
                        " does not use it; leave out this option");
    } else if (name == "phi" && py::isinstance<py::array>(value)) {
      const auto phi = value.cast<Doubles>();
      options.phi = WeightMatrix::Map(phi.data(), phi.shape(1), phi.shape(0));
    } else {
      set(options.solver, name, value);
    }
  }
  return options;
}

py::dict as_dict(const SolveReport& report, const std::string& method) {
  using namespace py::literals;
  const auto& seconds = report.seconds;
  const auto& quality = report.quality;
  py::dict dict(
      "method"_a = method.empty() ? name_of(report.method) : method,
      "control_points"_a = report.control_points, "vertices"_a = report.vertices,
      "cells"_a = report.cells, "iterations"_a = report.iterations,
      "converged"_a = report.status == SolveStatus::kConverged, "status"_a = name_of(report.status),
      "criterion"_a = name_of(report.criterion),
      "relative_primal_residual"_a = report.relative_primal_residual,
      "relative_dual_residual"_a = report.relative_dual_residual, "objective"_a = report.objective,
      "seconds"_a = py::dict("setup"_a = seconds.setup, "solve"_a = seconds.solve,
                             "recover"_a = seconds.recover, "certify"_a = seconds.certify),
      "distances"_a = py::dict("source"_a = name_of(report.distances.source),
                               "vertices"_a = report.distances.vertices,
                               "phi_error"_a = report.distances.phi_error),
      "active_set"_a = py::dict("density"_a = report.active_set.density,
                                "growths"_a = report.active_set.growths),
      "coarse_levels"_a = levels_of(report), "mesh_error"_a = report.mesh_error,
      "min_weight"_a = quality.min_weight, "max_partition_error"_a = quality.max_partition_error,
      "max_reproduction_error"_a = quality.max_reproduction_error,
      "mean_influences"_a = quality.mean_influences, "penalty"_a = report.published_penalty);
  if (report.certificate.objective > 0) {
    dict["lower_bound"] = report.certificate.lower_bound;
    dict["certified_objective"] = report.certificate.objective;
    dict["relative_gap"] = report.certificate.relative_gap;
  }
  if (!report.parts.empty()) {
    py::list parts;
    for (const auto& part : report.parts) parts.append(as_dict(part, method));
    dict["parts"] = parts;
  }
  return dict;
}

py::dict as_dict(const BindReport& report) {
  using namespace py::literals;
  const auto& solve = report.solve;
  // A file has only these of a solve.
  auto dict = solve.control_points > 0
                  ? as_dict(solve, report.method)
                  : py::dict("method"_a = report.method, "iterations"_a = solve.iterations,
                             "converged"_a = solve.status == SolveStatus::kConverged,
                             "status"_a = name_of(solve.status));
  dict["options"] = report.options;
  dict["mesher"] = report.mesher;
  dict["note"] = report.note;
  return dict;
}

py::object as_python(const std::shared_ptr<const Proof>& proof) {
  if (!proof) return py::none();
  const auto cells = proof->phi.cols(), n = proof->phi.rows(), axes = proof->multipliers.rows();
  const auto phi = proof->phi.dense();
  py::dict arrays;
  arrays["phi"] = py::array_t<double>({cells, n}, phi.data());
  arrays["flux"] = py::array_t<float>({cells, axes, n}, proof->flux.data());
  arrays["multipliers"] =
      py::array_t<double>({proof->multipliers.cols(), axes}, proof->multipliers.data());
  arrays["smoothness"] = proof->smoothness;
  arrays["masked"] =
      py::array_t<Index>({proof->masked.cols(), Eigen::Index(2)}, proof->masked.data());
  return arrays;
}

}  // namespace flbc::python
