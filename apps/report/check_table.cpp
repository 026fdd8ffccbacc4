// SPDX-License-Identifier: BSD-3-Clause
// The table that flbc check prints, from its JSON.
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>

#include "flbc/check.h"
#include "front/facts.h"
#include "report/check_report.h"
#include "report/properties.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value, int digits = 6) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string position(const Json& coordinates, int digits = 6) {
  std::string text;
  for (const auto& x : coordinates) text += (text.empty() ? "(" : ", ") + number(x, digits);
  return text + ")";
}

// Empty where there is nothing worth a look.
std::string place(const Json& extreme) {
  if (extreme.is_null() || extreme["value"] == 0) return "";
  auto text = "point " + extreme["point"].dump() + " at " + position(extreme["place"]);
  if (extreme.contains("control_point")) {
    text += ", control point " + extreme["control_point"].dump();
  }
  return text;
}

// "1 vertex", "2 vertices".
std::string count(const Json& number, const std::string& noun, const std::string& nouns = "") {
  return number.dump() + " " + (number == 1 ? noun : nouns.empty() ? noun + "s" : nouns);
}

std::string yes_no(bool is_fine) {
  return is_fine ? "ok" : "no";
}

// \param part  of the cage's size
std::string describe_thinness(bool is_plane, double part) {
  constexpr double kTooThin = 1e-8;  // for all meshers in 3D
  if (!is_plane && part <= kTooThin) return ": too thin to mesh";
  if (part < kThin) return ": so thin that meshing may be slow or exceed --mesh-timeout";
  return "";
}

void print_cage(std::ostream& out, const Json& cage) {
  const auto file = cage["file"].get<std::string>();
  const auto& defects = cage["defects"];
  if (!defects.empty()) {
    out << file << ": not a cage, " << (defects.size() == kMostDefects ? "at least " : "")
        << count(defects.size(), "defect") << '\n';
    for (const auto& defect : defects) out << "  " << defect["message"].get<std::string>() << '\n';
    return;
  }
  const bool is_plane = cage["dim"] == 2;
  out << file << ": a sound " << cage["dim"] << "D cage"
      << (cage["self_intersections_checked"] ? "" : " (not checked for self-intersections)")
      << '\n';
  const std::vector<double> low = cage["low"], high = cage["high"];
  const int digits = digits_of_box(Eigen::Map<const Eigen::VectorXd>(low.data(), cage["dim"]),
                                   Eigen::Map<const Eigen::VectorXd>(high.data(), cage["dim"]));
  const auto& shortest = cage["shortest_edge"];
  TextTable table{
      {"  control points", cage["control_points"].dump()},
      {is_plane ? "  edges" : "  triangles", cage["facets"].dump()},
      {is_plane ? "  outer loops" : "  outer shells",
       cage["parts"].dump() +
           (cage["parts"] > 1 ? ", not connected; each part is solved on its own" : "")},
      {is_plane ? "  holes" : "  cavities", cage["holes"].dump()},
      {"  bounding box", "from " + position(low, digits) + " to " + position(high, digits)},
      {"  size", number(cage["size"]) + ", the diagonal of the bounding box"},
      {is_plane ? "  area" : "  volume", number(cage["measure"])},
      {"  shortest edge", number(shortest["length"]) + ", between control points " +
                              shortest["control_points"][0].dump() + " and " +
                              shortest["control_points"][1].dump()}};
  if (cage.contains("thinnest_place")) {
    const auto& thinnest = cage["thinnest_place"];
    const double distance = thinnest["distance"], size = cage["size"];
    table.push_back({"  thinnest place", number(distance) + ", between control point " +
                                             thinnest["control_point"].dump() + " and " +
                                             (is_plane ? "edge " : "triangle ") +
                                             thinnest["facet"].dump() +
                                             describe_thinness(is_plane, distance / size)});
  }
  out << to_text(table);
}

void print_model(std::ostream& out, const Json& model, double size) {
  out << model["file"].get<std::string>() << ": ";
  const auto vertices = count(model["points"], "vertex", "vertices");
  if (model["outside"] == 0) {
    out << vertices << ", none outside the cage\n";
    return;
  }
  const auto& farthest = model["farthest_outside"];
  const double distance = farthest["distance"];
  out << model["outside"] << " of " << vertices << " are outside the cage; the farthest is vertex "
      << farthest["point"] << " at " << position(farthest["place"]) << ", " << number(distance)
      << " from it, " << number(100 * distance / size)
      << "% of the cage size; use flbc solve --outside, or make a cage around it with flbc cage\n";
}

void print_least_reach(std::ostream& out, const Json& reach) {
  const auto& maximum = reach["maximum"];
  if (maximum.is_null()) return;
  out << "  least reach: half of the vertices need control points within "
      << number(100 * reach["median"].get<double>(), 3) << "% of the cage size, and vertex "
      << maximum["point"] << " at " << position(maximum["place"]) << " within "
      << number(100 * maximum["value"].get<double>(), 3) << "%\n";
}

void add_extrema(TextTable& table, const char* name, const Json& numbers, const Json& worst) {
  std::int64_t total = 0;
  for (const std::int64_t vertices : numbers) total += vertices;
  const double depth = worst.is_null() ? 0.0 : worst["value"].get<double>();
  const bool is_fine = depth <= kSolverAccuracy;
  const auto where = "at most " + number(depth, 3) +
                     (is_fine ? " deep (within solver accuracy), " : " deep, ") + place(worst);
  table.push_back({name, std::to_string(total), yes_no(is_fine), total == 0 ? "" : where});
}

void add_mesh(TextTable& table, const Json& mesh, double influences) {
  add_extrema(table, "  local minima inside", mesh["local_minima"], mesh["deepest_minimum"]);
  add_extrema(table, "  local maxima inside", mesh["local_maxima"], mesh["highest_maximum"]);
  const auto add = [&](const char* label, const std::string& name) {
    const auto& harmonic = mesh["harmonic_" + name];
    if (harmonic.is_null()) return table.push_back({label, "-", "", "the mesh has several parts"});
    table.push_back(
        {label, number(mesh[name], 4), "", "harmonic coordinates: " + number(harmonic, 4)});
  };
  add("  weighted total variation", "weighted_variation");
  add("  jump of gradients", "gradient_jump");
  table.push_back({"  influences / harmonic", number(mesh["influence_ratio"], 3), "",
                   number(influences, 4) + " / " + number(mesh["harmonic_mean_influences"], 4) +
                       " per vertex"});
}

void print_weights(std::ostream& out, const Json& weights, const Json& points_file) {
  const auto file = weights["file"].get<std::string>();
  out << file << ": weights of " << count(weights["points"], "point") << " ("
      << points_file.get<std::string>() << ") for "
      << count(weights["control_points"], "control point") << '\n';
  if (weights["without_weights"] > 0) {
    out << "  without weights, so that they do not move: "
        << count(weights["without_weights"], "point") << '\n';
  }
  const auto& worst = weights["worst"];
  const bool is_finite = weights["non_finite"] == 0;
  const auto positive = yes_no(weights["negative"] == 0);
  const double influences = weights["mean_influences"];
  // Spaces set the width of columns.
  TextTable table{{"  property", "value       ", "   ", "worst place"}};
  table.push_back({"  finite", is_finite ? "all" : count(weights["non_finite"], "not"),
                   yes_no(is_finite), place(worst["non_finite"])});
  const auto add_worst = [&](const std::string& label, const char* name, const char* verdict,
                             int digits = 3) {
    const auto& extreme = worst[name];
    if (extreme.is_null()) return table.push_back({label, "-", "", "no such points"});
    const double value = extreme["value"];
    table.push_back({label, number(value, digits),
                     verdict != nullptr ? verdict : yes_no(value <= kCheckTolerance),
                     place(extreme)});
  };
  add_worst("  sum to 1", "partition", nullptr);
  add_worst("  reproduce points", "reproduction", nullptr);
  add_worst("  Lagrange, " + count(weights["control_points_found"], "control point"), "lagrange",
            nullptr);
  add_worst("  linear on facets, " + count(weights["points_on_cage"], "point"), "linearity",
            nullptr);
  add_worst("  smallest weight", "min_weight", positive.c_str());
  table.push_back({"  negative weights", weights["negative"].dump(), positive, ""});
  add_worst("  largest weight", "max_weight", "");
  table.push_back({"  influences above 1e-4, mean", number(influences, 4), "", ""});
  add_worst("  influences above 1e-4, maximum", "influences", "", 6);
  if (weights.contains("mesh")) add_mesh(table, weights["mesh"], influences);
  out << to_text(table) << "As in the table of flbc compare:\n"
      << to_text(property_table(
             {{std::filesystem::path(file).filename().string(), weights["properties"]}}));
}

}  // namespace

void print_check(std::ostream& out, const Json& report) {
  print_cage(out, report["cage"]);
  if (report.contains("model")) {
    print_model(out, report["model"], report["cage"]["size"]);
    print_least_reach(out, report["model"]["least_reach"]);
  }
  if (report.contains("weights")) {
    const auto& weights = report["weights"];
    print_weights(out, weights,
                  weights["domain"] == "" ? report["model"]["file"] : weights["domain"]);
  }
}

}  // namespace flbc::app
