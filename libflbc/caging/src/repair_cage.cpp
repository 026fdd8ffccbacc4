// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/repair_cage.h"

#include <algorithm>
#include <utility>

#include "base/messages.h"
#include "caging/repair_steps.h"
#include "caging/surface_tools.h"
#include "flbc/bounding_box.h"
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
  if (cage.facets.size() > 0 &&
      (cage.facets.minCoeff() < 0 || cage.facets.maxCoeff() >= cage.size())) {
    throw InputError("a facet refers to a control point that does not exist");
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
  for (Index v = 0; v < draft.points.cols(); ++v) {
    repaired.new_numbers.push_back(number[draft.merged_into[v]]);
    if (repaired.new_numbers[v] != v) repaired.keeps_numbers = false;
    if (draft.merged_into[v] != v || is_used[v]) continue;
    draft.changes.push_back(describe_control_point<Dim>(draft.points, v) +
                            " belongs to no facet and is removed");
  }
  repaired.changes = std::move(draft.changes);
  return repaired;
}

// As close as this number of control points allows.
template <int Dim>
void wrap_closely(const Cage<Dim>& original, const std::string& reason,
                  RepairedCage<Dim>& repaired) {
  constexpr double kRelativeOffset = 0.004;
  CagingOptions options;
  options.control_points = std::max<Index>(repaired.cage.size(), 4 * Dim);
  options.offset = kRelativeOffset * bounding_box_diagonal<Dim>(repaired.cage.points);
  options.symmetry = CageSymmetry::kNone;
  repaired.cage = cage_from_model<Dim>(repaired.cage.points, repaired.cage.facets, options).cage;
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

}  // namespace

template <int Dim>
RepairedCage<Dim> repair_cage(const Cage<Dim>& cage) {
  check_numbers_of(cage);
  auto draft = draft_of(cage);
  merge_close_points(draft);
  drop_degenerate_facets(draft);
  drop_repeated_facets(draft);
  drop_flaps(draft);
  orient_alike(draft);
  close_holes(draft);
  auto repaired = finish(draft);
  const auto left = first_defect(repaired.cage);
  if (left.empty()) return repaired;
  if (repaired.cage.facets.cols() == 0) throw InputError(left.front().message);
  wrap_closely(cage, left.front().message, repaired);
  return repaired;
}

template RepairedCage<2> repair_cage(const Cage<2>&);
template RepairedCage<3> repair_cage(const Cage<3>&);

}  // namespace flbc
