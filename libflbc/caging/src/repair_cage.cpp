// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/repair_cage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/messages.h"
#include "caging/cage_steps.h"
#include "caging/cells.h"
#include "caging/enclosure.h"
#include "caging/repair_steps.h"
#include "caging/ridges.h"
#include "caging/surface_tools.h"
#include "flbc/bounding_box.h"
#include "flbc/cage_facts.h"
#include "flbc/cage_from_model.h"
#include "flbc/errors.h"
#include "flbc/meshing.h"

namespace flbc {

namespace {

template <int Dim>
std::vector<Defect> first_defect(const Cage<Dim>& cage) {
  auto defects = find_defects(cage, 1);
  return defects.empty() ? find_self_intersections(cage, 1) : defects;
}

template <int Dim>
void check_numbers_of(const Cage<Dim>& cage) {
  for (Index v = 0; v < cage.size(); ++v) {
    if (cage.points.col(v).allFinite()) continue;
    throw InputError(describe_control_point<Dim>(cage.points, v) + " is not finite");
  }
  for (Index s = 0; s < cage.facets.cols(); ++s) {
    if (cage.facets.col(s).minCoeff() >= 0 && cage.facets.col(s).maxCoeff() < cage.size()) continue;
    throw InputError("facet " + std::to_string(s) +
                     " refers to a control point that does not exist; there are " +
                     std::to_string(cage.size()));
  }
}

// Indices of the control points used by facets; others are removed.
template <int Dim>
RepairedCage<Dim> finish(CageDraft<Dim>& draft) {
  std::vector<FacetCorners<Dim>> facets;
  std::vector<bool> is_used(static_cast<std::size_t>(draft.points.cols()), false);
  for (const auto& facet : draft.facets) {
    facets.push_back(facet.corners);
    for (int k = 0; k < Dim; ++k) is_used[facet.corners(k)] = true;
  }
  RepairedCage<Dim> repaired{compact<Dim>(draft.points, facets), {}, {}};
  std::vector<Index> number(is_used.size(), -1);
  Index size = 0;
  for (std::size_t v = 0; v < is_used.size(); ++v) {
    if (is_used[v]) number[v] = size++;
  }
  for (Index v = 0; v < static_cast<Index>(draft.merged_into.size()); ++v) {
    repaired.new_numbers.push_back(number[draft.merged_into[v]]);
    if (repaired.new_numbers[v] != v) repaired.keeps_numbers = false;
    if (draft.merged_into[v] != v || is_used[v]) continue;
    draft.changes.push_back(describe_control_point<Dim>(draft.points, v) +
                            " belongs to no facet and is removed");
  }
  auto& changes = draft.changes;  // one for several pieces of a facet
  changes.erase(std::unique(changes.begin(), changes.end()), changes.end());
  repaired.changes = std::move(changes);
  return repaired;
}

// A change of area or volume above this fraction is a warning.
constexpr double kLargeChange = 0.05;

// The new surface should not be farther from the old one than this fraction of its size.
constexpr double kClose = 0.02;

// Doubles the number of control points until the surface is within kClose of the original.
template <int Dim>
void wrap_closely(const Cage<Dim>& original, const std::string& reason,
                  RepairedCage<Dim>& repaired) {
  constexpr double kRelativeOffset = 0.004;
  constexpr int kMostDoublings = 3;
  const Cage<Dim> model = repaired.cage;
  const double size = bounding_box_diagonal<Dim>(model.points);
  const Enclosure<Dim> surface(model.points, model.facets);
  CagingOptions options;
  options.control_points = std::max<Index>(model.size(), 4 * Dim);
  options.offset = kRelativeOffset * size;
  options.symmetry = CageSymmetry::kNone;
  for (int doublings = 0; doublings <= kMostDoublings; ++doublings) {
    repaired.cage = cage_from_model<Dim>(model.points, model.facets, options).cage;
    if (distances(repaired.cage, surface).largest <= kClose * size) break;
    options.control_points *= 2;
  }
  repaired.is_wrapped = true;
  repaired.keeps_numbers = false;
  for (Index v = 0; v < original.size(); ++v) {
    Eigen::Index nearest = 0;
    (repaired.cage.points.colwise() - original.points.col(v))
        .colwise()
        .squaredNorm()
        .minCoeff(&nearest);
    repaired.new_numbers[v] = static_cast<Index>(nearest);
  }
  repaired.changes.push_back("the cage is wrapped in a new surface of " +
                             std::to_string(repaired.cage.size()) + " control points, because " +
                             reason);
}

// Of those that are longer.
template <int Dim>
double shortest_edge(const Cage<Dim>& cage, double than) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& facet : cage.facets.colwise()) {
    for (int k = 0; k < Dim; ++k) {
      const double length =
          (cage.points.col(facet(k)) - cage.points.col(facet((k + 1) % Dim))).norm();
      if (length > than) shortest = std::min(shortest, length);
    }
  }
  return shortest;
}

template <int Dim>
void clean(CageDraft<Dim>& draft) {
  merge_close_points(draft);
  split_at_points(draft);
  drop_degenerate_facets(draft);
}

// Without an open border.
template <int Dim>
bool is_closed(const CageDraft<Dim>& draft) {
  const auto ridges = collect_ridges(draft);
  return !ridges.empty() && std::none_of(ridges.begin(), ridges.end(), [](const auto& entry) {
    return entry.second.size() == 1;
  });
}

// Sheets that closing has doubled enclose nothing. What is outside of other parts hangs on them.
template <int Dim>
void drop_sheets(CageDraft<Dim>& draft) {
  auto changes = draft.changes;
  drop_repeated_facets(draft);
  draft.changes = std::move(changes);
  drop_flaps(draft, true);
}

// The parts that have an odd number of facets at a ridge: a border, or a wall.
template <int Dim>
std::set<Index> odd_parts(const CageDraft<Dim>& draft) {
  std::set<Index> odd;
  for (const auto& [ridge, facets] : collect_ridges(draft)) {
    std::multiset<Index> parts;
    for (const Index f : facets) parts.insert(draft.facets[f].part);
    for (const Index part : parts) {
      if (parts.count(part) % 2 == 1) odd.insert(part);
    }
  }
  return odd;
}

// The union of all parts, without walls inside. If rounding of crossings leaves a place that
// meshers cannot fill, others are tried. \return none if an open part or a defect remains
template <int Dim>
std::optional<RepairedCage<Dim>> unite(const CageDraft<Dim>& parts,
                                       const std::vector<Index>& shells, double& measure) {
  const bool are_closed = is_closed(parts);
  auto numbered = parts;
  const auto measures = number_parts(numbered, shells);
  const auto odd = odd_parts(numbered);
  std::optional<RepairedCage<Dim>> best;
  double thickest = 0;
  // Coordinates of six digits have errors as large as the usual tolerance. Facets may cross where
  // close points have been merged, so the last attempt merges none.
  for (const double tolerance :
       {kMergeTolerance, 10 * kMergeTolerance, 100 * kMergeTolerance, 0.0}) {
    auto draft = numbered;
    draft.tolerance = tolerance;
    // Overlaps first, because their facets need not be exactly in one plane. The pieces are no
    // facets of the original, so what happens to them is not reported.
    for (const bool only_overlaps : {true, false}) {
      only_overlaps ? cut_where_facets_overlap(draft) : cut_at_crossings(draft);
      auto changes = draft.changes;
      clean(draft);
      draft.changes = std::move(changes);
    }
    if (are_closed) drop_sheets(draft);
    if (!keep_boundary(draft, measures, odd) || draft.facets.empty()) continue;
    split_touching_corners(draft);
    auto united = finish(draft);
    const double own = signed_measure<Dim>(united.cage, united.cage.points.col(0));
    if (!best) measure = own;
    if (!first_defect(united.cage).empty()) continue;
    const double thickness = thinnest_place(united.cage).distance;
    if (thickness <= thickest) continue;
    thickest = thickness;
    measure = own;
    best = std::move(united);
    if (thickest > kMergeTolerance * bounding_box_diagonal<Dim>(parts.points)) break;
  }
  return best;
}

// Per facet: the closed shell that it belongs to; -1: an open one.
template <int Dim>
std::vector<Index> closed_shells(const Cage<Dim>& cage) {
  auto draft = draft_of(cage);
  merge_close_points(draft);
  number_parts(draft, {});
  std::vector<Index> shells;
  for (const auto& facet : draft.facets) shells.push_back(facet.part);
  std::set<Index> open;
  for (const auto& [ridge, facets] : collect_ridges(draft)) {
    if (facets.size() == 1) open.insert(shells[facets[0]]);
  }
  for (Index& shell : shells) shell = open.count(shell) > 0 ? -1 : shell;
  return shells;
}

// Cleaned up, without facets that do not bound anything. An open cage is closed by merging points
// that are farther apart, where that suffices and all edges are much longer.
template <int Dim>
CageDraft<Dim> cleaned(const Cage<Dim>& cage, const std::vector<Index>& shells) {
  const auto clean_up = [&](double tolerance) {
    auto draft = draft_of(cage);
    draft.tolerance = tolerance;
    clean(draft);
    // Where closed shells touch, each needs its facets for the union.
    for (auto& facet : draft.facets) facet.part = shells[facet.number];
    drop_repeated_facets(draft);
    drop_flaps(draft, false);
    return draft;
  };
  auto draft = clean_up(kMergeTolerance);
  if (draft.facets.empty() || is_closed(draft)) return draft;
  const double size = bounding_box_diagonal<Dim>(cage.points);
  const double most = 0.1 * shortest_edge(cage, kMergeTolerance * size) / size;
  for (double tolerance = 10 * kMergeTolerance; tolerance < most; tolerance *= 10) {
    auto merged = clean_up(tolerance);
    if (!is_closed(merged)) continue;
    double gap = 0;
    for (Index v = 0; v < cage.size(); ++v) {
      gap = std::max(gap, (cage.points.col(v) - cage.points.col(merged.merged_into[v])).norm());
    }
    merged.changes.push_back("control points up to " + format_number(gap) +
                             " apart are merged, because this closes the cage");
    return merged;
  }
  return draft;
}

// Leaves the changes to the caller. \return without the figures
template <int Dim>
RepairedCage<Dim> repaired_without_figures(const Cage<Dim>& cage, double& measure) {
  const auto shells = closed_shells(cage);
  auto draft = cleaned(cage, shells);
  const bool was_closed = is_closed(draft);
  orient_alike(draft);
  close_holes(draft);
  const auto before = draft;
  auto repaired = finish(draft);
  const auto left = first_defect(repaired.cage);
  if (left.empty()) {
    measure = was_closed ? measure_cage(repaired.cage).measure : 0;
    return repaired;
  }
  if (repaired.cage.facets.cols() == 0) throw InputError(left.front().message);
  if (left.front().kind == DefectKind::kFlat) {
    throw InputError(left.front().message + "; make a cage around it as a model (flbc cage)");
  }
  auto united = unite(before, shells, measure);
  if (!was_closed) measure = 0;
  if (united) return std::move(*united);
  if constexpr (Dim == 3) {
    if (measure == 0) measure = solid_volume(repaired.cage, was_closed);
  }
  wrap_closely(cage, left.front().message, repaired);
  return repaired;
}

}  // namespace

template <int Dim>
RepairedCage<Dim> repair_cage(const Cage<Dim>& cage) {
  check_numbers_of(cage);
  double measure = 0;
  auto repaired = repaired_without_figures(cage, measure);
  repaired.measure_before = measure;
  const double change = measure_cage(repaired.cage).measure / measure - 1;
  if (measure > 0 && std::abs(change) > kLargeChange) {
    repaired.changes.push_back(std::string("warning: the ") + (Dim == 2 ? "area" : "volume") +
                               " changes by " + format_number(100 * change) +
                               "%; compare the repaired cage with the original");
  }
  const double distance =
      distances(repaired.cage, Enclosure<Dim>(cage.points, cage.facets)).largest;
  if (distance > kMergeTolerance * bounding_box_diagonal<Dim>(repaired.cage.points)) {
    repaired.max_distance = distance;
  }
  const std::set<Index> kept(repaired.new_numbers.begin(), repaired.new_numbers.end());
  if (!repaired.is_wrapped) repaired.kept = static_cast<Index>(kept.size() - kept.count(-1));
  return repaired;
}

template RepairedCage<2> repair_cage(const Cage<2>&);
template RepairedCage<3> repair_cage(const Cage<3>&);

}  // namespace flbc
