// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/state_record.h"

#include <nlohmann/json.hpp>

#include "flbc/content_hash.h"
#include "flbc/names.h"

namespace flbc::openmesh {

template <int Dim>
StateRecord describe(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                     const SolverOptions& options) {
  StateRecord record;
  record.method = name_of(options.method);
  if (options.non_negative == NonNegative::kConstraint) record.method += ", non-negative";
  record.precision = name_of(options.precision);
  record.phi = name_of(options.phi);
  record.control_points = cage.size();
  record.cage = content_hash(cage.points, cage.facets).text();
  record.points = content_hash(mesh.points).text();
  record.cells = content_hash(mesh.cells).text();
  return record;
}

std::string to_json(const StateRecord& record) {
  const nlohmann::ordered_json json = {
      {"method", record.method},   {"precision", record.precision},
      {"phi", record.phi},         {"control_points", record.control_points},
      {"penalty", record.penalty}, {"cage", record.cage},
      {"points", record.points},   {"cells", record.cells}};
  return json.dump();
}

StateRecord parse_state_record(const std::string& text) {
  StateRecord record;
  try {
    const auto json = nlohmann::json::parse(text);
    record.method = json.at("method");
    record.precision = json.at("precision");
    record.phi = json.at("phi");
    record.control_points = json.at("control_points");
    record.cage = json.at("cage");
    record.points = json.at("points");
    record.cells = json.at("cells");
    record.penalty = json.at("penalty");
  } catch (const nlohmann::json::exception&) {
    return {};
  }
  return record;
}

bool same_method(const StateRecord& a, const StateRecord& b) {
  return a.method == b.method && a.precision == b.precision && a.phi == b.phi;
}

std::string find_mismatch(const StateRecord& kept, const StateRecord& now) {
  if (kept.control_points != now.control_points) {
    return "it was made for a cage with " + std::to_string(kept.control_points) +
           " control points, this one has " + std::to_string(now.control_points);
  }
  if (kept.cage != now.cage) return "the cage has changed since";
  if (kept.cells != now.cells) return "the mesh's connectivity has changed since";
  if (kept.points != now.points) return "the mesh's points have moved since";
  return {};
}

template StateRecord describe(const Cage<2>&, const DomainMesh<2>&, const SolverOptions&);
template StateRecord describe(const Cage<3>&, const DomainMesh<3>&, const SolverOptions&);

}  // namespace flbc::openmesh
