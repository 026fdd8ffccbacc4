// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/state_record.h"

#include <cstdint>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "flbc/names.h"

namespace flbc::openmesh {
namespace {

// FNV-1a, 64 bits: not against malice, only against forgetting.
template <class Matrix>
std::uint64_t hash(const Matrix& matrix, std::uint64_t seed = 0xcbf29ce484222325u) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(matrix.data());
  const auto count = static_cast<std::size_t>(matrix.size()) * sizeof(*matrix.data());
  for (std::size_t k = 0; k < count; ++k) seed = (seed ^ bytes[k]) * 0x100000001b3u;
  return seed;
}

std::string to_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace

template <int Dim>
StateRecord describe(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                     const SolverOptions& options) {
  StateRecord record;
  record.method = name_of(options.method);
  if (options.non_negative == NonNegative::kConstraint) record.method += ", non-negative";
  record.precision = options.precision == Precision::kSingle ? "single" : "double";
  record.phi = name_of(options.phi);
  record.control_points = cage.size();
  record.cage = to_text(hash(cage.facets, hash(cage.points)));
  record.points = to_text(hash(mesh.points));
  record.cells = to_text(hash(mesh.cells));
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
