// SPDX-License-Identifier: BSD-3-Clause
// The findings of flbc check, as a table and as JSON.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "flbc/cage_facts.h"
#include "flbc/check.h"
#include "flbc/placement.h"

namespace flbc::app {

//! More defects are not looked for.
constexpr std::size_t kMostDefects = 16;

template <int Dim>
struct ModelCheck {
  PointList<Dim> points;
  std::vector<Index> outside;   //!< their indices
  NearestOnCage<Dim> farthest;  //!< of those outside
  LeastReach<Dim> least_reach;
  std::string bridged_gaps{};  //!< describe_bridged_gaps(); needs CGAL
};

//! Everything found out. What was not asked for, or could not be looked at because the cage is
//! defective, is absent.
template <int Dim>
struct CheckReport {
  std::string cage_file, model_file, domain_file, weights_file;
  Cage<Dim> cage;
  std::vector<Defect> defects;         //!< at most kMostDefects
  bool intersections_checked = false;  //!< whether this build can look for them, and did
  std::optional<CageFacts<Dim>> facts{};
  ThinPlace thinnest{};  //!< if there are facts
  std::optional<ModelCheck<Dim>> model{};
  std::optional<WeightCheck<Dim>> weights{};
  std::vector<std::string> violations{};  //!< by the weights

  bool is_fine() const { return defects.empty() && violations.empty(); }
};

template <int Dim>
nlohmann::ordered_json check_json(const CheckReport<Dim>& report);

//! A line per fact. \param report  of check_json()
void print_check(std::ostream& out, const nlohmann::ordered_json& report);

//! The beginning of a report: the cage's defects, or facts about a cage without any.
//! \param file  of the cage
template <int Dim>
CheckReport<Dim> check_cage(const Cage<Dim>& cage, const std::string& file);

//! Adds the facts about weights. \param place  the mesh that has them, or points anywhere, with
//! fewer facts \param more  further arguments of check_weights()
//! \throws InputError if the sizes do not belong together, or the mesh does not belong to the cage
template <int Dim, class Place>
void check_weights_of(CheckReport<Dim>& report, const Place& place, const SparseWeights& weights) {
  report.weights = check_weights(report.cage, place, weights);
  report.violations = find_violations(*report.weights);
}

}  // namespace flbc::app
