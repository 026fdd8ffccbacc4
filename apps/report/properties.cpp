// SPDX-License-Identifier: BSD-3-Clause
#include "report/properties.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numeric>

#include "front/facts.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

struct Heading {
  const char* key;
  const char* text;
  const char* meaning;
};

constexpr Heading kHeadings[] = {
    {"influences", "influences", "weights above 1e-4, mean per vertex of the mesh"},
    {"max_influences", "maximum", "the same, maximum per vertex"},
    {"reach", "reach",
     "share of the model vertices that a control point moves by more than 1% of its own "
     "displacement, mean over control points"},
    {"min_weight", "smallest weight", "at the vertices of the mesh"},
    {"total_variation", "total variation",
     "integral of |grad w|, relative to harmonic coordinates"},
    {"distortion", "distortion",
     "mean over the cells of the mesh of sum (s - 1)^2, s: stretches of the cell in the pose"},
    {"volume_change", "volume change", "mean |volume ratio - 1| of the cells (area in 2D)"},
    {"flipped", "flipped", "share of the volume in cells that the pose turns inside out"},
    {"sum_error", "sum - 1", "largest |sum of weights - 1|"},
    {"reproduction_error", "reproduction error",
     "largest distance of the rest pose from the model, relative to the cage size"},
    {"local_extrema", "local extrema", "number of vertices inside the cage that are one"},
    {"deepest_extremum", "depth of extrema", "largest difference from the neighbors"},
    {"gradient_jump", "gradient jump",
     "root mean square between neighboring cells, relative to the cage size"},
    {"setup_seconds", "setup, s", "seconds"},
    {"solve_seconds", "solve, s", "seconds"},
    {"seconds_per_frame", "frame, s", "seconds to deform the model once"}};

std::string cell_of(const Json& properties, const char* key) {
  if (!properties.contains(key)) return "-";
  const auto& value = properties[key];
  Facts text;
  value.is_number_integer() ? text << value.get<std::int64_t>() : text << value.get<double>();
  return text.text();
}

}  // namespace

template <int Dim>
Json properties_of(const WeightCheck<Dim>& check) {
  Json properties{{"influences", check.quality.mean_influences},
                  {"min_weight", check.min_weight.value},
                  {"sum_error", check.partition.value},
                  {"reproduction_error", check.reproduction.value}};
  if (!check.mesh) return properties;
  const auto& mesh = *check.mesh;
  std::int64_t extrema = 0;
  for (const auto* numbers : {&mesh.local_minima, &mesh.local_maxima}) {
    extrema = std::accumulate(numbers->begin(), numbers->end(), extrema);
  }
  properties["local_extrema"] = extrema;
  properties["deepest_extremum"] = std::max(mesh.deepest_minimum.value, mesh.highest_maximum.value);
  properties["gradient_jump"] = mesh.gradient_jump;
  return properties;
}

TextTable property_table(const std::vector<std::pair<std::string, Json>>& properties) {
  TextTable table{{"coordinates"}};
  for (const auto& [name, values] : properties) table.push_back({name});
  for (const auto& [key, heading, meaning] : kHeadings) {
    const bool is_known = std::any_of(properties.begin(), properties.end(),
                                      [k = key](const auto& p) { return p.second.contains(k); });
    if (!is_known) continue;
    table[0].emplace_back(heading);
    for (std::size_t k = 0; k < properties.size(); ++k) {
      table[k + 1].push_back(cell_of(properties[k].second, key));
    }
  }
  return table;
}

TextTable property_legend(const TextTable& table) {
  TextTable legend;
  for (const auto& [key, heading, meaning] : kHeadings) {
    if (std::count(table[0].begin(), table[0].end(), heading) > 0)
      legend.push_back({heading, meaning});
  }
  return legend;
}

std::string to_text(const TextTable& table) {
  std::string text;
  for (const auto& row : table) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      std::size_t width = 0;
      for (const auto& other : table) width = std::max(width, other[k].size());
      line += row[k] + std::string(width + 2 - row[k].size(), ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

template Json properties_of(const WeightCheck<2>&);
template Json properties_of(const WeightCheck<3>&);

}  // namespace flbc::app
