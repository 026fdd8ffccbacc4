// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/state_record.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include <nlohmann/json.hpp>

#include "flbc/content_hash.h"
#include "flbc/errors.h"
#include "flbc/names.h"

namespace flbc::openmesh {

template <int Dim>
StateRecord describe(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                     const SolverOptions& options, const Eigen::MatrixXd& phi) {
  StateRecord record;
  record.method = name_of(options.method);
  if (options.non_negative == NonNegative::kConstraint) record.method += ", non-negative";
  record.precision =
      name_of(options.precision == Precision::kDouble ? Precision::kDouble : Precision::kSingle);
  record.phi = phi.size() > 0 ? content_hash(phi).text() : name_of(options.phi);
  record.control_points = cage.size();
  record.cage = content_hash(cage.points, cage.facets).text();
  record.points = content_hash(mesh.points).text();
  record.cells = content_hash(mesh.cells).text();
  return record;
}

std::string to_json(const StateRecord& record) {
  const nlohmann::ordered_json json = {{"method", record.method},
                                       {"precision", record.precision},
                                       {"phi", record.phi},
                                       {"control_points", record.control_points},
                                       {"penalty", record.penalty},
                                       {"requested_penalty", record.requested_penalty},
                                       {"used_penalty", record.used_penalty},
                                       {"finished", record.finished},
                                       {"cage", record.cage},
                                       {"points", record.points},
                                       {"cells", record.cells}};
  return json.dump();
}

namespace {

// Beyond an Index, the conversion from JSON would give any number. \return -1 for those
Index index_of(const nlohmann::json& json) {
  const auto number = json.is_number_integer() ? json.get<std::int64_t>() : -1;
  return number >= 0 && number <= std::numeric_limits<Index>::max() ? static_cast<Index>(number)
                                                                    : -1;
}

}  // namespace

StateRecord parse_state_record(const std::string& text) {
  StateRecord record;
  try {
    const auto json = nlohmann::json::parse(text);
    record.method = json.at("method");
    record.precision = json.at("precision");
    record.phi = json.at("phi");
    record.control_points = index_of(json.at("control_points"));
    record.cage = json.at("cage");
    record.points = json.at("points");
    record.cells = json.at("cells");
    record.requested_penalty = json.at("requested_penalty");
    record.used_penalty = json.at("used_penalty");
    record.finished = json.at("finished");
    record.penalty = json.at("penalty");
  } catch (const nlohmann::json::exception&) {
    return {};
  }
  return record;
}

std::string why_restart(const StateRecord& kept, const StateRecord& now) {
  const auto differs = [](const char* what, const std::string& before, const std::string& after) {
    return std::string("the ") + what + " was " + before + ", is " + after;
  };
  if (kept.method.empty()) return "there is no state";
  if (!kept.finished) return "the run that left the state did not come to its end";
  if (!(kept.penalty > 0)) return "there is no state";
  if (kept.method != now.method) return differs("method", kept.method, now.method);
  if (kept.precision != now.precision) return differs("precision", kept.precision, now.precision);
  if (kept.phi != now.phi) return differs("phi", kept.phi, now.phi);
  return {};
}

bool rescales_duals(Method method) {
  return method == Method::kGradient || method == Method::kPaper;
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

namespace internal {

void require_phi(const Eigen::MatrixXd& phi, Index control_points, const std::string& name) {
  if (phi.rows() != control_points) {
    throw InputError("property '" + name + "' has phi of " + std::to_string(phi.rows()) +
                     " control points, the cage has " + std::to_string(control_points));
  }
  for (Eigen::Index s = 0; s < phi.cols(); ++s) {
    for (Eigen::Index i = 0; i < phi.rows(); ++i) {
      if (phi(i, s) >= 0 && std::isfinite(phi(i, s))) continue;
      throw InputError("property '" + name + "' has no phi >= 0 for cell " + std::to_string(s) +
                       ", control point " + std::to_string(i));
    }
  }
}

}  // namespace internal

template StateRecord describe(const Cage<2>&, const DomainMesh<2>&, const SolverOptions&,
                              const Eigen::MatrixXd&);
template StateRecord describe(const Cage<3>&, const DomainMesh<3>&, const SolverOptions&,
                              const Eigen::MatrixXd&);

}  // namespace flbc::openmesh
