// SPDX-License-Identifier: BSD-3-Clause
// The table that flbc check prints.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <numeric>
#include <ostream>

#include "flbc/check.h"
#include "report/check_report.h"
#include "report/facts.h"
#include "report/properties.h"

namespace flbc::app {
namespace {

std::string number(double value, int digits = 6) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

template <int Dim>
std::string position(const Vector<Dim>& point, int digits = 6) {
  std::string text = "(";
  for (int axis = 0; axis < Dim; ++axis) {
    text += (axis > 0 ? ", " : "") + number(point[axis], digits);
  }
  return text + ")";
}

// Empty where there is nothing worth a look.
template <int Dim>
std::string place(const Extreme<Dim>& extreme) {
  if (extreme.point < 0 || extreme.value == 0) return "";
  auto text = "point " + std::to_string(extreme.point) + " at " + position<Dim>(extreme.place);
  if (extreme.control_point >= 0) {
    text += ", control point " + std::to_string(extreme.control_point);
  }
  return text;
}

// "1 vertex", "2 vertices".
std::string count(std::int64_t number, const std::string& noun, const std::string& nouns) {
  return std::to_string(number) + " " + (number == 1 ? noun : nouns);
}
std::string count(std::int64_t number, const std::string& noun) {
  return count(number, noun, noun + "s");
}

void print_fact(std::ostream& out, const std::string& name, const std::string& value) {
  out << "  " << std::left << std::setw(16) << name << value << '\n';
}

// A line of the table of weights.
void print_line(std::ostream& out, const std::string& name, const std::string& value,
                const std::string& verdict, const std::string& where) {
  std::string line = "  " + name;
  const auto pad = [&](std::size_t column) { line.resize(std::max(line.size() + 2, column), ' '); };
  pad(34);
  line += value;
  pad(48);
  line += verdict;
  pad(53);
  line += where;
  line.erase(line.find_last_not_of(' ') + 1);
  out << line << '\n';
}

std::string yes_no(bool is_fine) {
  return is_fine ? "ok" : "no";
}

template <int Dim>
void print_error(std::ostream& out, const std::string& name, const Extreme<Dim>& error) {
  if (error.point < 0) return print_line(out, name, "-", "", "no such points");
  const bool is_fine = error.value <= kCheckTolerance;
  print_line(out, name, number(error.value, 3), yes_no(is_fine), place(error));
}

// \param part  of the cage's size
template <int Dim>
std::string describe_thinness(double part) {
  constexpr double kTooThin = 1e-8;  // for all meshers in 3D
  if (Dim == 3 && part <= kTooThin) return ": too thin to mesh";
  if (part < kThin) return ": so thin that meshing may be slow or exceed --mesh-timeout";
  return "";
}

template <int Dim>
void print_cage(std::ostream& out, const CheckReport<Dim>& report) {
  const auto& cage = report.cage;
  if (!report.defects.empty()) {
    out << report.cage_file << ": not a cage, "
        << (report.defects.size() == kMostDefects ? "at least " : "")
        << count(static_cast<std::int64_t>(report.defects.size()), "defect") << '\n';
    for (const auto& defect : report.defects) out << "  " << defect.message << '\n';
    if (!report.model_file.empty() || !report.weights_file.empty()) {
      out << "The other checks need a sound cage and were skipped.\n";
    }
    return;
  }
  const auto& facts = *report.facts;
  out << report.cage_file << ": a sound " << Dim << "D cage"
      << (report.intersections_checked ? "" : " (not checked for self-intersections)") << '\n';
  print_fact(out, "control points", std::to_string(cage.size()));
  print_fact(out, Dim == 2 ? "edges" : "triangles", std::to_string(cage.facets.cols()));
  print_fact(out, Dim == 2 ? "outer loops" : "outer shells",
             std::to_string(facts.parts) +
                 (facts.parts > 1 ? ", not connected; each part is solved on its own" : ""));
  print_fact(out, Dim == 2 ? "holes" : "cavities", std::to_string(facts.holes));
  const Vector<Dim> low = cage.points.rowwise().minCoeff();
  const Vector<Dim> high = cage.points.rowwise().maxCoeff();
  const int digits = digits_of_box(low, high);
  print_fact(out, "bounding box",
             "from " + position<Dim>(low, digits) + " to " + position<Dim>(high, digits));
  print_fact(out, "size", number(facts.size) + ", the diagonal of the bounding box");
  print_fact(out, Dim == 2 ? "area" : "volume", number(facts.measure));
  print_fact(out, "shortest edge",
             number(facts.shortest_edge) + ", between control points " +
                 std::to_string(facts.shortest_ends[0]) + " and " +
                 std::to_string(facts.shortest_ends[1]));
  const auto& thinnest = report.thinnest;
  if (thinnest.facet < 0) return;
  print_fact(out, "thinnest place",
             number(thinnest.distance) + ", between control point " +
                 std::to_string(thinnest.control_point) + " and " +
                 (Dim == 2 ? "edge " : "triangle ") + std::to_string(thinnest.facet) +
                 describe_thinness<Dim>(thinnest.distance / facts.size));
}

template <int Dim>
void print_model(std::ostream& out, const CheckReport<Dim>& report) {
  const auto& [points, outside, farthest] = *report.model;
  out << report.model_file << ": ";
  if (outside.empty()) {
    out << count(points.cols(), "vertex", "vertices") << ", none outside the cage\n";
    return;
  }
  out << outside.size() << " of " << count(points.cols(), "vertex", "vertices")
      << " are outside the cage; the farthest is vertex " << farthest.point << " at "
      << position<Dim>(points.col(farthest.point)) << ", " << number(farthest.distance())
      << " from it, " << number(100 * farthest.distance() / report.facts->size)
      << "% of the cage size; use flbc solve --outside, or make a cage around it with flbc cage\n";
}

template <int Dim>
void print_on_mesh(std::ostream& out, const MeshCheck<Dim>& mesh, const Quality& quality) {
  const auto print_extrema = [&](const std::string& name, const std::vector<Index>& numbers,
                                 const Extreme<Dim>& worst) {
    const auto total = std::accumulate(numbers.begin(), numbers.end(), std::int64_t{0});
    const bool is_fine = worst.value <= kSolverAccuracy;
    print_line(out, name, std::to_string(total), yes_no(is_fine),
               total == 0
                   ? ""
                   : "at most " + number(worst.value, 3) +
                         (is_fine ? " deep (within solver accuracy), " : " deep, ") + place(worst));
  };
  print_extrema("local minima inside", mesh.local_minima, mesh.deepest_minimum);
  print_extrema("local maxima inside", mesh.local_maxima, mesh.highest_maximum);
  const bool has_parts = mesh.weighted_variation == 0;
  print_line(out, "weighted total variation", has_parts ? "-" : number(mesh.weighted_variation, 4),
             "",
             has_parts ? "the mesh has several parts"
                       : "harmonic coordinates: " + number(mesh.harmonic_weighted_variation, 4));
  print_line(out, "jump of gradients", number(mesh.gradient_jump, 3), "",
             "harmonic coordinates: " + number(mesh.harmonic_gradient_jump, 3));
  print_line(out, "influences / harmonic", number(mesh.influence_ratio, 3), "",
             number(quality.mean_influences, 4) + " / " + number(mesh.harmonic_mean_influences, 4) +
                 " per vertex");
}

template <int Dim>
void print_weights(std::ostream& out, const CheckReport<Dim>& report) {
  const auto& check = *report.weights;
  out << report.weights_file << ": weights of " << count(check.points, "point") << " ("
      << (report.domain_file.empty() ? report.model_file : report.domain_file) << ") for "
      << count(check.control_points, "control point") << '\n';
  if (check.without_weights > 0) {
    out << "  without weights, so that they do not move: " << count(check.without_weights, "point")
        << '\n';
  }
  print_line(out, "property", "value", "", "worst place");
  print_line(out, "finite", check.non_finite == 0 ? "all" : count(check.non_finite, "not"),
             yes_no(check.non_finite == 0), place(check.first_non_finite));
  print_error(out, "sum to 1", check.partition);
  print_error(out, "reproduce points", check.reproduction);
  print_error(out, "Lagrange, " + count(check.control_points_found, "control point"),
              check.lagrange);
  print_error(out, "linear on facets, " + count(check.points_on_cage, "point"), check.linearity);
  print_line(out, "smallest weight", number(check.min_weight.value, 3), yes_no(check.negative == 0),
             place(check.min_weight));
  print_line(out, "negative weights", std::to_string(check.negative), yes_no(check.negative == 0),
             "");
  print_line(out, "largest weight", number(check.max_weight.value, 3), "", place(check.max_weight));
  print_line(out, "influences above 1e-4, mean", number(check.quality.mean_influences, 4), "", "");
  print_line(out, "influences above 1e-4, maximum", number(check.influences.value), "",
             place(check.influences));
  if (check.mesh) print_on_mesh(out, *check.mesh, check.quality);
  out << "As in the table of flbc compare:\n"
      << to_text(property_table({{std::filesystem::path(report.weights_file).filename().string(),
                                  properties_of(check)}}));
}

void print_creases(std::ostream& out, const CreaseCheck& creases) {
  out << "Creases in the pose: the angle between faces changes by " << number(creases.mean, 3)
      << " degrees on average, by at most " << number(creases.high, 3)
      << " degrees at 99 % of the edges";
  if (creases.ends[0] >= 0) {
    out << ", most (" << number(creases.largest, 3) << " degrees) at the edge between vertices "
        << creases.ends[0] << " and " << creases.ends[1];
  }
  out << '\n';
}

}  // namespace

template <int Dim>
void print_check(std::ostream& out, const CheckReport<Dim>& report) {
  print_cage(out, report);
  if (report.model) print_model(out, report);
  if (report.weights) print_weights(out, report);
  if (report.creases) print_creases(out, *report.creases);
}

template void print_check(std::ostream&, const CheckReport<2>&);
template void print_check(std::ostream&, const CheckReport<3>&);

}  // namespace flbc::app
