// SPDX-License-Identifier: BSD-3-Clause
#include "front/locality_file.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/formats.h"
#include "flbc/io/model_file.h"
#include "flbc/options.h"
#include "flbc/place_masks.h"
#include "front/facts.h"
#include "front/instantiate.h"
#include "front/load.h"

namespace flbc::app {
namespace {

using LocalityJson = nlohmann::json;

constexpr const char* kExample = R"([{"control_points": [3], "region": {"vertices": [0, 1]}}])";

// A misspelled key would mean another mask.
void require_keys(const LocalityJson& object, const std::set<std::string>& known) {
  if (!object.is_object()) throw InputError(object.dump() + " is not an object with keys");
  for (const auto& entry : object.items()) {
    if (known.count(entry.key()) > 0) continue;
    throw InputError("unknown key \"" + entry.key() + "\"; choose from " + joined(known));
  }
}

// Without backslashes at the end of lines, which continue them.
std::string joined_lines(std::string text) {
  for (const std::string end : {"\\\n", "\\\r\n"}) {
    for (auto at = text.find(end); at != std::string::npos; at = text.find(end, at)) {
      text.replace(at, end.size(), " ");
    }
  }
  return text;
}

// The vertices of the faces, lines, and points that follow "g NAME" in a .obj file.
std::vector<Index> vertices_of_group(const std::string& model, const std::string& name) {
  if (io::extension_of(model) != "obj") {
    throw InputError("group \"" + name +
                     "\": only .obj models have groups; give vertices or a box");
  }
  std::istringstream file(joined_lines(io::read_file(model)));
  std::vector<Index> vertices;
  Index count = 0;  // of the vertices so far, to which negative numbers refer
  bool is_inside = false;
  std::set<std::string> groups;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string word;
    words >> word;
    if (word == "v") ++count;
    if (word == "g") {
      is_inside = false;
      while (words >> word) {
        groups.insert(word);
        is_inside = is_inside || word == name;
      }
    } else if (is_inside && (word == "f" || word == "l" || word == "p")) {
      while (words >> word) {
        const auto number = static_cast<Index>(std::strtol(word.c_str(), nullptr, 10));
        vertices.push_back(number < 0 ? count + number : number - 1);
      }
    }
  }
  if (groups.count(name) == 0) {
    throw InputError("group \"" + name + "\" is not in " + model + "; it has " +
                     (groups.empty() ? "no groups" : joined(groups)));
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<Index> vertices_of_attribute(const std::string& model, const std::string& name) {
  const auto values = io::vertex_attribute(model, name);
  std::vector<Index> vertices;
  for (Index v = 0; v < values.size(); ++v) {
    if (values[v] > 0.5) vertices.push_back(v);
  }
  return vertices;
}

template <int Dim>
std::vector<Index> points_in_box(const LocalityJson& box, const PointList<Dim>& points) {
  const auto corner = [&](int k) {
    const auto numbers = box.at(k).get<std::vector<double>>();
    if (numbers.size() != Dim)
      throw InputError("a box needs corners of " + std::to_string(Dim) + " numbers, not " +
                       std::to_string(numbers.size()));
    return Vector<Dim>(Vector<Dim>::Map(numbers.data()));
  };
  const Vector<Dim> low = corner(0), high = corner(1);
  std::vector<Index> inside;
  for (Index p = 0; p < points.cols(); ++p) {
    const auto x = points.col(p).array();
    if ((x >= low.array()).all() && (x <= high.array()).all()) inside.push_back(p);
  }
  return inside;
}

// Numbers are not rounded and do not wrap around: that would be another mask.
std::vector<Index> indices_in(const LocalityJson& list) {
  std::vector<Index> indices;
  if (!list.is_array()) throw InputError(list.dump() + " is not a list of indices such as [0, 1]");
  for (const auto& number : list) {
    const auto index = number.is_number_integer() ? number.get<std::int64_t>() : -1;
    if (index < 0 || index > std::numeric_limits<Index>::max()) {
      throw InputError(number.dump() + " is not an index; indices are integers from 0");
    }
    indices.push_back(static_cast<Index>(index));
  }
  return indices;
}

template <int Dim>
std::vector<Index> indices_of(const LocalityJson& chosen, const PointList<Dim>& points,
                              const std::string& model) {
  if (chosen.is_array()) return indices_in(chosen);
  require_keys(chosen, {"vertices", "box", "group", "attribute"});
  if (chosen.size() > 1) throw InputError("give one choice for each mask, not several");
  if (chosen.contains("vertices")) return indices_in(chosen["vertices"]);
  if (chosen.contains("box")) return points_in_box<Dim>(chosen["box"], points);
  if (chosen.contains("group") && !model.empty()) {
    return vertices_of_group(model, chosen["group"].get<std::string>());
  }
  if (chosen.contains("attribute") && !model.empty()) {
    return vertices_of_attribute(model, chosen["attribute"].get<std::string>());
  }
  throw InputError(
      "give a list of numbers, {\"vertices\": [...]}, {\"box\": [lowest, highest]}, or, for "
      "regions of a model, {\"group\": name} or {\"attribute\": name}");
}

template <int Dim>
std::vector<double> reach_in(const LocalityJson& json, const PointList<Dim>& control_points) {
  if (!json.contains("reach")) return {};
  SolverOptions options;
  auto& reach = options.reach;
  reach.assign(control_points.cols(), 1);
  for (std::size_t k = 0; k < json["reach"].size(); ++k) {
    if (!json["reach"].is_array())
      throw InputError("reach is not a list such as [{\"control_points\": [3], \"factor\": 2}]");
    const auto& entry = json["reach"][k];
    require_keys(entry, {"control_points", "factor"});
    if (!entry.contains("control_points") || !entry.contains("factor") ||
        !entry["factor"].is_number()) {
      throw InputError("reach " + std::to_string(k) +
                       ": give control_points, and a number as factor");
    }
    const auto chosen = indices_of<Dim>(entry["control_points"], control_points, "");
    if (chosen.empty()) {
      throw InputError("reach " + std::to_string(k) + ": no control points are chosen");
    }
    for (const Index i : chosen) {
      if (i >= control_points.cols()) {
        throw InputError("reach: there is no control point " + std::to_string(i));
      }
      reach[i] = entry["factor"].get<double>();
    }
  }
  validate(options);
  return reach;
}

double falloff_in(const LocalityJson& json) {
  if (!json.contains("falloff")) return 0;
  if (!json["falloff"].is_number()) throw InputError("falloff is not a number");
  SolverOptions options;
  options.falloff = json["falloff"].get<double>();
  validate(options);
  return options.falloff;
}

template <int Dim>
std::vector<std::vector<Index>> solid_in(const LocalityJson& json, const PointList<Dim>& points,
                                         const std::string& model) {
  std::vector<std::vector<Index>> solid;
  if (!json.contains("solid")) return solid;
  if (!json["solid"].is_array()) throw InputError("solid is not a list");
  for (const auto& entry : json["solid"]) {
    const auto name = "solid region " + std::to_string(solid.size());
    require_keys(entry, {"region"});
    if (!entry.contains("region")) throw InputError(name + ": give a region");
    solid.push_back(indices_of<Dim>(entry["region"], points, model));
    if (solid.back().empty()) throw InputError(name + ": no vertices are chosen");
  }
  return solid;
}

// Whether control points in conflict are removed from masks.
bool relaxes(const LocalityJson& json) {
  const auto choice = json.is_array() ? "fail" : json.value("conflicts", "fail");
  if (choice == "relax") return true;
  if (choice == "fail") return false;
  throw InputError("conflicts: invalid value \"" + choice + "\"; choose from fail, relax");
}

}  // namespace

std::string Locality::note() const {
  if (freed.empty()) return "";
  return "removed control point" + (freed.size() == 1 ? " " : std::string("s ")) + joined(freed) +
         " from the masks, so that all vertices have weights";
}

template <int Dim>
Locality load_locality(const std::string& path, const Cage<Dim>& cage, const PointList<Dim>& points,
                       const std::string& model, int mirror_axis) {
  Locality locality;
  auto& masks = locality.masks;
  if (path.empty()) return locality;
  std::string entry;  // that is read
  try {
    const auto json = LocalityJson::parse(io::read_file(path));
    if (json.is_object()) require_keys(json, {"masks", "conflicts", "reach", "falloff", "solid"});
    locality.reach = reach_in<Dim>(json, cage.points);
    locality.falloff = falloff_in(json);
    locality.solid = solid_in<Dim>(json, points, model);
    const bool needs_masks = !json.contains("reach") && !json.contains("solid");
    const auto list = json.is_array() ? json
                      : needs_masks   ? json.at("masks")
                                      : json.value("masks", LocalityJson::array());
    if (!list.is_array()) {
      throw InputError(std::string("masks is not a list such as ") + kExample);
    }
    for (const auto& mask : list) {
      entry = "mask " + std::to_string(masks.size()) + ": ";
      require_keys(mask, {"control_points", "region"});
      masks.push_back({indices_of<Dim>(mask.at("control_points"), cage.points, ""),
                       indices_of<Dim>(mask.at("region"), points, model)});
      if (masks.back().control_points.empty() || masks.back().points.empty()) {
        throw InputError("no control points or no vertices are chosen");
      }
    }
    entry.clear();
    PointMasks(masks, cage.size(), static_cast<Index>(points.cols()));  // checks the numbers
    if (relaxes(json)) masks = relax_masks(cage, points, masks, locality.freed, mirror_axis);
  } catch (const LocalityJson::parse_error& error) {
    throw InputError(path + ": not JSON, at byte " + std::to_string(error.byte));
  } catch (const LocalityJson::exception&) {
    throw InputError(path + ": " + entry + "not a list of masks such as " + kExample);
  } catch (const InputError& error) {
    throw InputError(path + ": " + entry + error.what());
  } catch (const OptionError& error) {
    throw InputError(path + ": " + error.what());
  }
  return locality;
}

FLBC_INSTANTIATE_FUNCTION(load_locality)

}  // namespace flbc::app
