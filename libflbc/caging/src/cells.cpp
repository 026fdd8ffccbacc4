// SPDX-License-Identifier: BSD-3-Clause
#include "caging/cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/union_find.h"
#include "caging/enclosure.h"
#include "caging/ridges.h"
#include "caging/surface_tools.h"
#include "flbc/bounding_box.h"

namespace flbc {

namespace {

// A side of a facet: twice its index, plus one for the side opposite to its normal.
using Side = Index;

Side opposite(Side side) {
  return side ^ 1;
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim> corners_of(const CageDraft<Dim>& draft, Index f) {
  Eigen::Matrix<double, Dim, Dim> corners;
  for (int k = 0; k < Dim; ++k) corners.col(k) = draft.points.col(draft.facets[f].corners(k));
  return corners;
}

// The plane perpendicular to a ridge.
template <int Dim>
Eigen::Matrix<double, Dim, 2> plane_across(const CageDraft<Dim>& draft, const Ridge<Dim>& ridge) {
  if constexpr (Dim == 2) {
    return Eigen::Matrix2d::Identity();
  } else {
    const Vector<3> along = (draft.points.col(ridge[1]) - draft.points.col(ridge[0])).normalized();
    Eigen::Matrix<double, 3, 2> plane;
    plane.col(0) = along.unitOrthogonal();
    plane.col(1) = along.cross(plane.col(0));
    return plane;
  }
}

template <int Dim>
Index corner_off(const FacetCorners<Dim>& corners, const Ridge<Dim>& ridge) {
  int k = 0;
  while (std::find(ridge.begin(), ridge.end(), corners(k)) != ridge.end()) ++k;
  return corners(k);
}

// Calls `visit` with the sides that face each other at the ridge.
template <int Dim, class Visit>
void for_each_wedge(const CageDraft<Dim>& draft, const Ridge<Dim>& ridge,
                    const std::vector<Index>& facets, const Visit& visit) {
  const auto plane = plane_across(draft, ridge);
  struct Spoke {
    double angle;
    Side ahead;  // the side that faces larger angles
  };
  std::vector<Spoke> spokes;
  for (const Index f : facets) {
    const Index tip = corner_off<Dim>(draft.facets[f].corners, ridge);
    const Eigen::Vector2d d =
        plane.transpose() * (draft.points.col(tip) - draft.points.col(ridge[0]));
    const Vector<Dim> turned = plane * Eigen::Vector2d(-d.y(), d.x());
    const bool is_normal = turned.dot(facet_normal<Dim>(corners_of(draft, f))) > 0;
    spokes.push_back({std::atan2(d.y(), d.x()), 2 * f + (is_normal ? 0 : 1)});
  }
  std::sort(spokes.begin(), spokes.end(),
            [](const Spoke& a, const Spoke& b) { return a.angle < b.angle; });
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    visit(spokes[k].ahead, opposite(spokes[(k + 1) % spokes.size()].ahead));
  }
}

template <int Dim>
class Cells {
 public:
  explicit Cells(const CageDraft<Dim>& draft) : draft_(draft), infinity_(2 * count()) {
    UnionFind connected(count());
    for (const auto& [ridge, facets] : collect_ridges(draft)) {
      for_each_wedge(draft, ridge, facets, [&](Side a, Side b) { join(a, b); });
      for (const Index f : facets) connected.unite(facets[0], f);
    }
    for (Index f = 0; f < count(); ++f) simplices_.push_back({corners_of(draft, f), Dim});
    // Parts that do not meet are connected by rays.
    for (Index f = 0; f < count(); ++f) {
      if (connected.find(f) == f) shoot_at(f);
    }
  }

  //! Whether the position of every part relative to the others is known.
  bool is_complete() const { return is_complete_; }

  //! Per side: whether the facets of a part separate it from infinity. \param parts_of  per facet
  std::vector<bool> enclosed_by(Index part,
                                const std::vector<std::multiset<Index>>& parts_of) const {
    UnionFind cells(infinity_ + 1);
    for (const auto& [a, b] : adjacent_) cells.unite(a, b);
    for (Index f = 0; f < count(); ++f) {
      if (parts_of[f].count(part) == 0) cells.unite(2 * f, 2 * f + 1);
    }
    std::vector<bool> is_enclosed(2 * draft_.facets.size());
    for (Side side = 0; side < infinity_; ++side) {
      is_enclosed[side] = cells.find(side) != cells.find(infinity_);
    }
    return is_enclosed;
  }

  //! Whether every path from infinity and back crosses the part an even number of times.
  //! \param parts_of  per facet
  bool has_inside(Index part, const std::vector<std::multiset<Index>>& parts_of) const {
    const Side all = infinity_ + 1;
    UnionFind cells(2 * all);  // after an even number of crossings, and after an odd one
    const auto unite = [&](Side a, Side b, bool crosses) {
      cells.unite(a, crosses ? b + all : b);
      cells.unite(a + all, crosses ? b : b + all);
    };
    for (const auto& [a, b] : adjacent_) unite(a, b, false);
    for (Index f = 0; f < count(); ++f) unite(2 * f, 2 * f + 1, parts_of[f].count(part) % 2 == 1);
    return cells.find(infinity_) != cells.find(infinity_ + all);
  }

  //! Whether a path leads from one side of the facet to the other.
  bool is_open_at(Index f) {
    if (!cells_) {
      cells_.emplace(infinity_ + 1);
      for (const auto& [a, b] : adjacent_) cells_->unite(a, b);
    }
    return cells_->find(2 * f) == cells_->find(2 * f + 1);
  }

 private:
  Index count() const { return static_cast<Index>(draft_.facets.size()); }
  void join(Side a, Side b) { adjacent_.emplace_back(a, b); }

  // Sides that face each other along a ray from infinity to a facet.
  void shoot_at(Index target) {
    constexpr int kAttempts = 16;
    const double reach = 4 * bounding_box_diagonal<Dim>(draft_.points);
    const Vector<Dim> end = corners_of(draft_, target).rowwise().mean();
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const Vector<Dim> start = end + reach * ray_direction<Dim>(attempt);
      if (follow(start, 2 * end - start)) return;
    }
    is_complete_ = false;
  }

  // \return false if the line passes an edge or a corner
  bool follow(const Vector<Dim>& start, const Vector<Dim>& end) {
    std::vector<std::pair<double, Index>> hits;
    for (Index f = 0; f < count(); ++f) {
      const auto how = passage(start, end, simplices_[f]);
      if (how == Passage::kUnclear) return false;
      if (how == Passage::kBeside) continue;
      const Vector<Dim> normal = facet_normal<Dim>(simplices_[f].corners);
      const double ahead = normal.dot(simplices_[f].corners.col(0) - start);
      hits.emplace_back(ahead / normal.dot(end - start), f);
    }
    std::sort(hits.begin(), hits.end());
    Side behind = infinity_;
    for (const auto& [place, f] : hits) {
      const Vector<Dim> normal = facet_normal<Dim>(simplices_[f].corners);
      const Side front = 2 * f + (normal.dot(end - start) < 0 ? 0 : 1);
      join(behind, front);
      behind = opposite(front);
    }
    join(behind, infinity_);
    return true;
  }

  const CageDraft<Dim>& draft_;
  Side infinity_;
  std::vector<std::pair<Side, Side>> adjacent_;
  std::vector<Simplex<Dim>> simplices_;
  std::optional<UnionFind> cells_;
  bool is_complete_ = true;
};

// Of facets with the same corners one remains. \return per facet: the parts that it belongs to,
// each as often as it has such a facet
template <int Dim>
std::vector<std::multiset<Index>> merge_equal(CageDraft<Dim>& draft) {
  std::map<std::array<Index, Dim>, std::size_t> first_with;
  std::vector<std::multiset<Index>> parts_of;
  std::size_t kept = 0;
  for (const auto& facet : draft.facets) {
    std::array<Index, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners[k] = facet.corners(k);
    std::sort(corners.begin(), corners.end());
    const auto [entry, is_new] = first_with.emplace(corners, kept);
    if (is_new) {
      draft.facets[kept++] = facet;
      parts_of.emplace_back();
    }
    for (int k = 0; k < (facet.is_double ? 2 : 1); ++k) parts_of[entry->second].insert(facet.part);
  }
  draft.facets.resize(kept);
  return parts_of;
}

// Per side: whether it is inside the union of all parts.
template <int Dim>
std::vector<bool> sides_inside(const CageDraft<Dim>& draft, const Cells<Dim>& cells,
                               const std::vector<std::multiset<Index>>& parts_of,
                               const std::map<Index, double>& measures) {
  std::set<Index> parts;
  for (const auto& own : parts_of) parts.insert(own.begin(), own.end());
  std::map<Index, std::vector<bool>> enclosed_by;
  for (const Index part : parts) enclosed_by[part] = cells.enclosed_by(part, parts_of);
  std::map<Index, int> depths;
  for (const Index part : parts) {
    for (const auto& [other, is_enclosed] : enclosed_by) {
      const double own = measures.at(part), whole = measures.at(other);
      const bool may_touch = own * whole < 0 && std::abs(own) < 0.999 * std::abs(whole);
      const auto is_within = [&, &around = is_enclosed](Index side) {
        return around[side] || (may_touch && !enclosed_by.at(part)[side]);
      };
      bool is_nested = other != part;
      for (Index f = 0; f < static_cast<Index>(parts_of.size()) && is_nested; ++f) {
        if (parts_of[f].count(part) > 0) is_nested = is_within(2 * f) && is_within(2 * f + 1);
      }
      if (is_nested) ++depths[part];
    }
  }
  std::vector<int> sums(2 * draft.facets.size(), 0);
  for (const auto& [part, is_enclosed] : enclosed_by) {
    for (std::size_t side = 0; side < sums.size(); ++side) {
      if (is_enclosed[side]) sums[side] += depths[part] % 2 == 0 ? 1 : -1;
    }
  }
  std::vector<bool> is_inside(sums.size());
  for (std::size_t side = 0; side < sums.size(); ++side) is_inside[side] = sums[side] > 0;
  return is_inside;
}

// Toward the inside, from corners with outward normals.
template <int Dim>
Vector<Dim> inward(const CageDraft<Dim>& draft, const std::vector<Index>& facets) {
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (const Index f : facets) sum -= facet_normal<Dim>(corners_of(draft, f)).normalized();
  return sum.normalized();
}

}  // namespace

template <int Dim>
std::map<Index, double> number_parts(CageDraft<Dim>& draft, const std::vector<Index>& shells) {
  const auto shell_of = [&](Index f) {
    const Index number = draft.facets[f].number;
    return number < 0 || shells.empty() ? -1 : shells[number];
  };
  std::map<Index, double> measures;
  UnionFind parts(static_cast<Index>(draft.facets.size()));
  for (const auto& [ridge, facets] : collect_ridges(draft)) {
    const bool are_closed =
        std::all_of(facets.begin(), facets.end(), [&](Index f) { return shell_of(f) >= 0; });
    for (const Index f : facets) {
      const auto first = std::find_if(facets.begin(), facets.end(), [&](Index g) {
        return !are_closed || shell_of(f) == shell_of(g);
      });
      parts.unite(*first, f);
    }
  }
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    draft.facets[f].part = parts.find(static_cast<Index>(f));
    draft.facets[f].is_double = false;
    const auto corners = corners_of(draft, static_cast<Index>(f));
    const Vector<Dim> from = corners.col(0) - draft.points.col(0);
    measures[draft.facets[f].part] += from.dot(facet_normal<Dim>(corners));
  }
  return measures;
}

template <int Dim>
bool keep_boundary(CageDraft<Dim>& draft, const std::map<Index, double>& measures,
                   const std::set<Index>& open) {
  const auto parts_of = merge_equal(draft);
  Cells<Dim> cells(draft);
  if (!cells.is_complete()) return false;
  for (const auto& [part, measure] : measures) {
    if (open.count(part) == 0 && !cells.has_inside(part, parts_of)) return false;
  }
  const auto is_inside = sides_inside(draft, cells, parts_of, measures);
  std::vector<typename CageDraft<Dim>::Facet> kept;
  std::map<Index, std::string> dropped;
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    auto facet = draft.facets[f];
    const bool front = is_inside[2 * f], back = is_inside[2 * f + 1];
    if (!front && !back && cells.is_open_at(static_cast<Index>(f))) return false;
    if (front == back) {
      dropped[facet.number] = front ? "inside" : "outside";
      continue;
    }
    if (front) std::swap(facet.corners(0), facet.corners(1));
    kept.push_back(facet);
  }
  // Facets of which a piece remains are reported as cut.
  for (const auto& facet : kept) dropped.erase(facet.number);
  for (const auto& [number, where] : dropped) {
    if (number < 0) continue;
    draft.changes.push_back(name_of_facet<Dim>(number) + " has the " + where +
                            " on both sides and is removed");
  }
  draft.facets = kept;
  return true;
}

template <int Dim>
void split_touching_corners(CageDraft<Dim>& draft) {
  const auto corner = [&](Side side, Index vertex) {
    const auto& corners = draft.facets[side / 2].corners;
    int k = 0;
    while (corners(k) != vertex) ++k;
    return Dim * (side / 2) + k;
  };
  UnionFind fans(static_cast<Index>(Dim * draft.facets.size()));
  for (const auto& entry : collect_ridges(draft)) {
    const auto& ridge = entry.first;  // not a structured binding, which clang cannot capture
    for_each_wedge(draft, ridge, entry.second, [&](Side a, Side b) {
      if (a % 2 == 0 || b % 2 == 0) return;
      for (const Index vertex : ridge) fans.unite(corner(a, vertex), corner(b, vertex));
    });
  }
  std::map<Index, std::map<Index, std::vector<Index>>> facets_at;  // per vertex and fan
  for (Index f = 0; f < static_cast<Index>(draft.facets.size()); ++f) {
    for (int k = 0; k < Dim; ++k) {
      facets_at[draft.facets[f].corners(k)][fans.find(Dim * f + k)].push_back(f);
    }
  }
  const double gap = 10 * kMergeTolerance * bounding_box_diagonal<Dim>(draft.points);
  for (const auto& [vertex, fans_here] : facets_at) {
    if (fans_here.size() == 1) continue;
    draft.changes.push_back(describe_control_point<Dim>(draft.points, vertex) + " is split into " +
                            std::to_string(fans_here.size()) + ", " + format_number(gap) +
                            " apart, because the cage only touches itself there");
    for (auto fan = std::next(fans_here.begin()); fan != fans_here.end(); ++fan) {
      const auto copy = static_cast<Index>(draft.points.cols());
      draft.points.conservativeResize(Dim, copy + 1);
      draft.points.col(copy) = draft.points.col(vertex) + gap * inward(draft, fan->second);
      for (const Index f : fan->second) {
        for (Index& v : draft.facets[f].corners) v = v == vertex ? copy : v;
      }
    }
  }
}

FLBC_INSTANTIATE_FUNCTION(number_parts)
FLBC_INSTANTIATE_FUNCTION(keep_boundary)
FLBC_INSTANTIATE_FUNCTION(split_touching_corners)

}  // namespace flbc
