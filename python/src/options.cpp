// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include <functional>
#include <optional>
#include <type_traits>

#include "flbc/errors.h"
#include "flbc/names.h"

namespace flbc::python {
namespace {

template <class Value>
struct IsOptional : std::false_type {};
template <class Value>
struct IsOptional<std::optional<Value>> : std::true_type {};

template <class Value>
const char* kind_of() {
  if constexpr (std::is_same_v<Value, bool>) return "True or False";
  if constexpr (std::is_integral_v<Value>) return "an integer";
  return "a number";
}

template <class Value>
Value value_of(const std::string& option, const py::handle& given) {
  if constexpr (IsOptional<Value>::value) {
    if (given.is_none()) return std::nullopt;
    return value_of<typename Value::value_type>(option, given);
  } else {
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
}

template <class Value>
py::object as_object(const Value& value) {
  if constexpr (IsOptional<Value>::value) {
    return value ? as_object(*value) : py::none();
  } else if constexpr (std::is_enum_v<Value>) {
    return py::str(name_of(value));
  } else {
    return py::cast(value);
  }
}

struct Field {
  const char* name;
  std::function<void(SolverOptions&, const py::handle&)> set;
  std::function<py::object(const SolverOptions&)> get;
};

//! \param place  returns a reference to the field of options
template <class Place>
Field field(const char* name, const Place& place) {
  return {name,
          [name, place](SolverOptions& options, const py::handle& value) {
            auto& target = place(options);
            target = value_of<std::decay_t<decltype(target)>>(name, value);
          },
          [place](const SolverOptions& options) { return as_object(place(options)); }};
}

// A mask of a row per point and a column per control point; or a list, as masks_as_object() makes.
std::vector<Mask> masks_of(const py::handle& given) {
  if (given.is_none()) return {};
  std::vector<Mask> masks;
  if (py::isinstance<py::list>(given)) {
    for (const auto& [control_points, points] :
         given.cast<std::vector<std::pair<std::vector<Index>, std::vector<Index>>>>()) {
      masks.push_back({control_points, points});
    }
    return masks;
  }
  const auto array = given.cast<py::array_t<bool>>();
  const auto masked = array.unchecked<2>();
  for (py::ssize_t i = 0; i < masked.shape(1); ++i) {
    Mask mask{{static_cast<Index>(i)}, {}};
    for (py::ssize_t p = 0; p < masked.shape(0); ++p) {
      if (masked(p, i)) mask.points.push_back(static_cast<Index>(p));
    }
    if (!mask.points.empty()) masks.push_back(std::move(mask));
  }
  return masks;
}

py::object masks_as_object(const std::vector<Mask>& masks) {
  if (masks.empty()) return py::none();
  py::list list;
  for (const auto& mask : masks) list.append(py::make_tuple(mask.control_points, mask.points));
  return std::move(list);
}

#define FLBC_FIELD(name, member) \
  field(                         \
      name, [](auto& options) -> auto& { return options.member; })

const std::vector<Field>& fields() {
  static const std::vector<Field> table{
      FLBC_FIELD("method", method),
      FLBC_FIELD("tolerance", tolerance),
      FLBC_FIELD("gap", gap),
      FLBC_FIELD("max_iterations", max_iterations),
      FLBC_FIELD("certify", certify),
      FLBC_FIELD("threads", threads),
      FLBC_FIELD("non_negative", non_negative),
      FLBC_FIELD("phi", phi),
      FLBC_FIELD("smoothness", smoothness),
      FLBC_FIELD("distances", distances),
      FLBC_FIELD("precision", precision),
      FLBC_FIELD("active_set", active_set),
      FLBC_FIELD("penalty", penalty),
      {"mask",
       [](SolverOptions& options, const py::handle& value) { options.masks = masks_of(value); },
       [](const SolverOptions& options) { return masks_as_object(options.masks); }},
      {"reach",
       [](SolverOptions& options, const py::handle& value) {
         options.reach.clear();
         if (!value.is_none()) options.reach = value.cast<std::vector<double>>();
       },
       [](const SolverOptions& options) -> py::object {
         return options.reach.empty() ? py::none() : py::cast(options.reach);
       }},
  };
  return table;
}
#undef FLBC_FIELD

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

std::vector<std::string> option_names() {
  std::vector<std::string> names;
  for (const auto& field : fields()) names.emplace_back(field.name);
  return names;
}

SolverOptions options_of(const py::dict& keywords) {
  SolverOptions options;
  for (const auto& field : fields()) {
    if (keywords.contains(field.name)) field.set(options, keywords[field.name]);
  }
  return options;
}

std::optional<Coordinates> coordinates_of(const py::dict& keywords) {
  if (!keywords.contains("method")) return {};
  return value_named<Coordinates>(py::str(keywords["method"]));
}

SolverOptions coordinates_options_of(const py::dict& keywords) {
  py::dict used;
  for (const auto& [key, value] : keywords) {
    const auto name = key.cast<std::string>();
    if (name == "method" || value.is_none()) continue;
    if (name != "threads" && name != "non_negative") {
      throw OptionError(name + ": the method " + keywords["method"].cast<std::string>() +
                        " does not use it; leave out this option");
    }
    used[key] = value;
  }
  return options_of(used);
}

py::dict as_dict(const SolverOptions& options) {
  py::dict dict;
  for (const auto& field : fields()) dict[field.name] = field.get(options);
  return dict;
}

py::dict as_dict(const SolveReport& report, const std::optional<Coordinates>& coordinates) {
  using namespace py::literals;
  const auto& seconds = report.seconds;
  const auto& quality = report.quality;
  py::dict dict(
      "method"_a = coordinates ? name_of(*coordinates) : name_of(report.method),
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
    for (const auto& part : report.parts) parts.append(as_dict(part, coordinates));
    dict["parts"] = parts;
  }
  return dict;
}

}  // namespace flbc::python
