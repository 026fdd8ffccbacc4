// SPDX-License-Identifier: BSD-3-Clause
// What flbc check finds, and its JSON.
#include <nlohmann/json.hpp>

#include "flbc/meshing.h"
#include "flbc/version.h"
#include "report/check_report.h"
#include "report/properties.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

template <class Derived>
Json list(const Eigen::MatrixBase<Derived>& numbers) {
  Json json = Json::array();
  for (const auto& number : numbers.reshaped()) json.push_back(number);
  return json;
}

// Null if there was nothing to measure.
template <int Dim>
Json to_json(const Extreme<Dim>& extreme) {
  if (extreme.point < 0) return nullptr;
  Json json{{"value", extreme.value}, {"point", extreme.point}, {"place", list(extreme.place)}};
  if (extreme.control_point >= 0) json["control_point"] = extreme.control_point;
  return json;
}

// \param part  of the cage size
const char* describe_thinness(bool is_plane, double part) {
  constexpr double kTooThin = 1e-8;  // for all meshers in 3D
  if (!is_plane && part <= kTooThin) return "too thin to mesh";
  return part < kThin ? "so thin that meshing may be slow or exceed --mesh-timeout" : "";
}

// 0 is what was not measured.
Json positive_or_null(double value) {
  return value > 0 ? Json(value) : Json();
}

template <int Dim>
Json cage_json(const CheckReport<Dim>& report) {
  Json json{{"file", report.cage_file},
            {"dim", Dim},
            {"control_points", report.cage.size()},
            {"facets", report.cage.facets.cols()},
            {"sound", report.defects.empty()},
            {"self_intersections_checked", report.intersections_checked},
            {"defects", Json::array()}};
  for (const auto& defect : report.defects) {
    json["defects"].push_back({{"message", defect.message},
                               {"control_points", defect.vertices},
                               {"facets", defect.facets}});
  }
  if (!report.facts) return json;
  const auto& facts = *report.facts;
  json["parts"] = facts.parts;
  json["holes"] = facts.holes;
  json["low"] = list(report.cage.points.rowwise().minCoeff());
  json["high"] = list(report.cage.points.rowwise().maxCoeff());
  json["size"] = facts.size;
  json["measure"] = facts.measure;
  json["shortest_edge"] = {{"length", facts.shortest_edge},
                           {"control_points", facts.shortest_ends}};
  if (report.thinnest.facet >= 0) {
    json["thinnest_place"] = {{"distance", report.thinnest.distance},
                              {"control_point", report.thinnest.control_point},
                              {"facet", report.thinnest.facet}};
    const std::string note = describe_thinness(Dim == 2, report.thinnest.distance / facts.size);
    if (!note.empty()) json["thinnest_place"]["note"] = note;
  }
  return json;
}

template <int Dim>
Json model_json(const CheckReport<Dim>& report) {
  const auto& [points, outside, farthest, reach, bridged] = *report.model;
  Json json{{"file", report.model_file},
            {"points", points.cols()},
            {"outside", outside.size()},
            {"least_reach", {{"maximum", to_json(reach.maximum)}, {"median", reach.median}}}};
  if (!bridged.empty()) json["note"] = bridged;
  if (outside.empty()) return json;
  json["first_outside"] = {{"point", outside.front()},
                           {"place", list(points.col(outside.front()))}};
  json["farthest_outside"] = {{"point", farthest.point},
                              {"place", list(points.col(farthest.point))},
                              {"distance", farthest.distance()}};
  return json;
}

template <int Dim>
Json mesh_json(const MeshCheck<Dim>& mesh) {
  return {{"interior_vertices", mesh.interior_vertices},
          {"local_minima", mesh.local_minima},
          {"local_maxima", mesh.local_maxima},
          {"deepest_minimum", to_json(mesh.deepest_minimum)},
          {"highest_maximum", to_json(mesh.highest_maximum)},
          {"total_variation", mesh.total_variation},
          {"harmonic_total_variation", mesh.harmonic_total_variation},
          {"weighted_variation", positive_or_null(mesh.weighted_variation)},
          {"harmonic_weighted_variation", positive_or_null(mesh.harmonic_weighted_variation)},
          {"gradient_jump", mesh.gradient_jump},
          {"harmonic_gradient_jump", mesh.harmonic_gradient_jump},
          {"harmonic_mean_influences", mesh.harmonic_mean_influences},
          {"influence_ratio", mesh.influence_ratio}};
}

template <int Dim>
Json weights_json(const CheckReport<Dim>& report) {
  const auto& check = *report.weights;
  Json json{{"file", report.weights_file},
            {"domain", report.domain_file},
            {"points", check.points},
            {"control_points", check.control_points},
            {"min_weight", check.quality.min_weight},
            {"max_partition_error", check.quality.max_partition_error},
            {"max_reproduction_error", check.quality.max_reproduction_error},
            {"mean_influences", check.quality.mean_influences},
            {"max_influences", check.influences.value},
            {"without_weights", check.without_weights},
            {"non_finite", check.non_finite},
            {"negative", check.negative},
            {"control_points_found", check.control_points_found},
            {"points_on_cage", check.points_on_cage}};
  json["worst"] = {
      {"non_finite", to_json(check.first_non_finite)}, {"min_weight", to_json(check.min_weight)},
      {"max_weight", to_json(check.max_weight)},       {"partition", to_json(check.partition)},
      {"reproduction", to_json(check.reproduction)},   {"lagrange", to_json(check.lagrange)},
      {"linearity", to_json(check.linearity)},         {"influences", to_json(check.influences)}};
  if (check.mesh) json["mesh"] = mesh_json(*check.mesh);
  json["properties"] = properties_of(check);
  json["violations"] = report.violations;
  return json;
}

}  // namespace

template <int Dim>
CheckReport<Dim> check_cage(const Cage<Dim>& cage, const std::string& file) {
  CheckReport<Dim> report{file, "", "", "", cage, find_defects(cage)};
#ifdef FLBC_LINKS_CGAL
  if (report.defects.empty()) {
    report.defects = find_self_intersections(cage, kMostDefects);
    report.intersections_checked = true;
  }
#endif
  if (report.defects.empty()) {
    report.facts = measure_cage(cage);
    report.thinnest = thinnest_place(cage);
  }
  return report;
}

template <int Dim>
Json check_json(const CheckReport<Dim>& report) {
  Json json{{"fine", report.is_fine()}, {"cage", cage_json(report)}};
  if (report.model) json["model"] = model_json(report);
  if (report.weights) json["weights"] = weights_json(report);
  json["version"] = FLBC_VERSION;
  return json;
}

#define FLBC_INSTANTIATE(Dim)                                                 \
  template CheckReport<Dim> check_cage(const Cage<Dim>&, const std::string&); \
  template Json check_json(const CheckReport<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
