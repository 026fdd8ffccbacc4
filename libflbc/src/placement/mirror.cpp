// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/mirror.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string>

#include "base/first_equals.h"
#include "base/messages.h"
#include "base/take_points.h"
#include "cage/close_points.h"
#include "cage/facet_locator.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// Numbers of the nearest points to given images, up to a tolerance; -1 for none. Two points are
// partners of each other, except for surplus duplicates, which share partners.
template <int Dim>
std::vector<Index> find_partners(const PointList<Dim>& points, const PointList<Dim>& images,
                                 double tolerance) {
  const auto first = first_equals<Dim>(points);
  std::vector<std::vector<Index>> same(first.size());
  std::vector<Index> order, partners(first.size(), -1), copy(first.size());
  for (Index p = 0; p < points.cols(); ++p) {
    auto& list = same[first[p]];
    copy[p] = static_cast<Index>(list.size());
    list.push_back(p);
    if (first[p] == p) order.push_back(p);
  }
  const auto heights = sweep_heights<Dim>(points), wanted = sweep_heights<Dim>(images);
  const double reach = sweep_reach(heights, tolerance);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return heights[a] < heights[b]; });
  for (Index p = 0; p < points.cols(); ++p) {
    if (first[p] != p || partners[p] >= 0) continue;
    auto k = std::lower_bound(order.begin(), order.end(), wanted[p] - reach,
                              [&](Index a, double height) { return heights[a] < height; });
    Index nearest = -1;
    double least = tolerance;
    for (; k != order.end() && heights[*k] <= wanted[p] + reach; ++k) {
      const double distance = (points.col(*k) - images.col(p)).norm();
      if (partners[*k] >= 0 || distance > least) continue;
      nearest = *k;
      least = distance;
    }
    if (nearest < 0) continue;
    partners[p] = nearest;
    partners[nearest] = p;
  }
  for (Index p = 0; p < points.cols(); ++p) {
    const Index partner = partners[first[p]];
    if (partner < 0) continue;
    const auto& list = same[first[partner]];
    partners[p] = list[static_cast<std::size_t>(copy[p]) % list.size()];
  }
  return partners;
}

// Refuses a cage whose surface is not that of its image. Flat quads may be cut differently.
// \param images  of the control points \param plane  in words
template <int Dim>
void require_mirrored_facets(const Cage<Dim>& cage, const PointList<Dim>& images,
                             const std::string& plane) {
  const FacetLocator<Dim> locator(cage, kBoundaryTolerance * bounding_box_diagonal(cage.points));
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    std::string corners;
    for (int k = 0; k < Dim; ++k)
      corners += (k > 0 ? ", " : "") + std::to_string(cage.facets(k, f));
    for (int k = 0; k < Dim; ++k) {
      const Vector<Dim> middle =
          (images.col(cage.facets(k, f)) + images.col(cage.facets((k + 1) % Dim, f))) / 2;
      if (locator.locate(middle).facet >= 0) continue;
      throw InputError(
          "facet " + std::to_string(f) + " of the cage, of control points " + corners +
          ", has no mirror image across " + plane +
          "; cut quads that are not flat alike on both sides, or leave out the mirror");
    }
  }
}

}  // namespace

template <int Dim>
MirroredModel<Dim>::MirroredModel(const Cage<Dim>& cage, int axis, const PointList<Dim>& points)
    : axis_(axis), points_(points) {
  if (axis < 0 || axis >= Dim) {
    throw OptionError("a cage in " + std::to_string(Dim) + "D has no mirror axis " +
                      std::to_string(axis));
  }
  const double tolerance = kBoundaryTolerance * bounding_box_diagonal(cage.points);
  place_ = (cage.points.row(axis).minCoeff() + cage.points.row(axis).maxCoeff()) / 2;
  plane_ = std::string(1, "xyz"[axis]) + " = " + format_number(place_);
  image_ = find_partners<Dim>(cage.points, mirrored(cage.points), tolerance);
  const auto alone = std::find(image_.begin(), image_.end(), -1);
  if (alone != image_.end()) {
    const auto i = static_cast<Index>(alone - image_.begin());
    const Vector<Dim> image = mirrored(cage.points).col(i);
    const double distance = (cage.points.colwise() - image).colwise().norm().minCoeff();
    throw InputError(describe_control_point(cage.points, i) + " has no mirror image across " +
                     plane_ + ": the nearest control point is " + format_number(distance) +
                     " away from it; make a symmetric cage, or leave out the mirror");
  }
  require_mirrored_facets<Dim>(cage, mirrored(cage.points), plane_);
  partner_ = find_partners<Dim>(points, mirrored(points), tolerance);
  number_single_points();
}

template <int Dim>
std::string MirroredModel<Dim>::note() const {
  if (single_.empty()) return "";
  return std::to_string(single_.size()) + " of " + std::to_string(partner_.size()) +
         " vertices have no mirror image across " + plane_ + " within " +
         format_number(kBoundaryTolerance) +
         " of the cage size; their weights are symmetric to those at their mirrored positions";
}

template <int Dim>
MirroredModel<Dim>::MirroredModel(const Cage<Dim>& cage, const Mirror& mirror,
                                  const PointList<Dim>& points)
    : axis_(mirror.axis), image_(mirror.images), points_(points), partner_(mirror.partners) {
  const auto is_within = [](const std::vector<Index>& indices, Eigen::Index low,
                            Eigen::Index size) {
    return static_cast<Eigen::Index>(indices.size()) == size &&
           std::all_of(indices.begin(), indices.end(),
                       [&](Index index) { return index >= low && index < size; });
  };
  if (axis_ < 0 || axis_ >= Dim || !is_within(image_, 0, cage.points.cols()) ||
      !is_within(partner_, -1, points.cols())) {
    throw InputError("the mirror is not one of this cage and these points");
  }
  place_ = (cage.points.row(axis_).minCoeff() + cage.points.row(axis_).maxCoeff()) / 2;
  number_single_points();
}

template <int Dim>
Mirror MirroredModel<Dim>::mirror() const {
  Mirror found{axis_, image_, partner_};
  for (Index& partner : found.partners) partner = std::max(partner, -1);
  return found;
}

template <int Dim>
void MirroredModel<Dim>::number_single_points() {
  for (std::size_t p = 0; p < partner_.size(); ++p) {
    if (partner_[p] >= 0) continue;
    partner_[p] = ~static_cast<Index>(single_.size());
    single_.push_back(static_cast<Index>(p));
  }
}

template <int Dim>
PointList<Dim> MirroredModel<Dim>::mirrored(const PointList<Dim>& points) const {
  PointList<Dim> images = points;
  images.row(axis_) = 2 * place_ - points.row(axis_).array();
  return images;
}

template <int Dim>
std::vector<Mask> MirroredModel<Dim>::symmetrized(const std::vector<Mask>& masks) const {
  const auto count = static_cast<Index>(partner_.size());
  PointMasks(masks, static_cast<Index>(image_.size()), count);  // checks
  using Flags = std::vector<bool>;
  // Both ways, because duplicates share a partner.
  const auto add_partners = [&](const Flags& of, Flags& to) {
    for (Index p = 0; p < count; ++p) {
      if (partner_[p] < 0) continue;
      if (of[p]) to[partner_[p]] = true;
      if (of[partner_[p]]) to[p] = true;
    }
  };
  const auto add = [&](std::vector<Mask>& list, const std::vector<Index>& control_points,
                       const Flags& flags) {
    list.push_back({control_points, {}});
    for (Index p = 0; p < count; ++p) {
      if (flags[p]) list.back().points.push_back(p);
    }
  };
  std::vector<Mask> both;
  for (const auto& [control_points, points] : masks) {
    Flags here(count, false), there(count, false);
    for (const Index p : points) here[p] = true;
    add_partners(here, there);
    add_partners(there, here);
    add(both, control_points, here);
    std::vector<Index> images;
    for (const Index i : control_points) images.push_back(image_[i]);
    add(both, images, there);
  }
  return both;
}

template <int Dim>
void MirroredModel<Dim>::symmetrize(
    Placement<Dim>& placement,
    const std::function<PointList<Dim>(const PointList<Dim>&)>& at) const {
  // Two points are outside together, although rounding may put only one of them onto the cage.
  std::vector<bool> is_outside(partner_.size(), false);
  for (const auto& nearest : placement.outside) {
    if (partner_[nearest.point] >= 0) is_outside[partner_[nearest.point]] = true;
  }
  auto &on_cage = placement.on_cage, &outside = placement.outside;
  const auto first = std::stable_partition(
      on_cage.begin(), on_cage.end(), [&](const auto& near) { return !is_outside[near.point]; });
  for (auto near = first; near != on_cage.end(); ++near) {
    if (placement.policy != OutsidePoints::kNearest) {
      placement.points.col(near->point) = points_.col(near->point);
    }
  }
  outside.insert(outside.end(), first, on_cage.end());
  on_cage.erase(first, on_cage.end());
  std::sort(outside.begin(), outside.end(),
            [](const auto& a, const auto& b) { return a.point < b.point; });
  const PointList<Dim> images = mirrored(placement.points);
  const PointList<Dim> others = mirrored(at_images(at));
  for (Index p = 0; p < placement.points.cols(); ++p) {
    const Index partner = partner_[p];
    placement.points.col(p) += partner < 0 ? others.col(~partner) : images.col(partner);
    placement.points.col(p) /= 2;
  }
  if (placement.policy != OutsidePoints::kNearest) return;
  for (auto& nearest : outside) {
    nearest.offset = points_.col(nearest.point) - placement.points.col(nearest.point);
  }
}

template <int Dim>
void MirroredModel<Dim>::keep_common(const std::vector<Mask>& given, PlacedMasks& masks) const {
  const auto n = static_cast<Index>(image_.size()), count = static_cast<Index>(partner_.size());
  const PointMasks before(masks.of_all(), n, count), wanted(given, n, count);
  for (auto* list : {&masks.of_points, &masks.of_outside}) {
    const PointMasks own(*list, n, count);
    std::vector<Mask> kept(n);
    for (Index i = 0; i < n; ++i) kept[i].control_points = {i};
    for (const Index p : own.points()) {
      std::size_t left = 0;
      for (const Index i : own.forbidden(p)) {
        if (partner_[p] >= 0 && !before.forbids(partner_[p], image_[i])) continue;
        kept[i].points.push_back(p);
        ++left;
      }
      const auto all_of_them = wanted.forbidden(p).size();
      if (left < all_of_them && own.forbidden(p).size() == all_of_them) ++masks.on_facets;
    }
    *list = std::move(kept);
  }
}

template <int Dim>
PlacedMasks MirroredModel<Dim>::of_single_points(PlacedMasks masks) const {
  const auto n = static_cast<Index>(image_.size()), count = static_cast<Index>(partner_.size());
  for (auto* list : {&masks.of_points, &masks.of_outside}) {
    *list = PointMasks(*list, n, count).list([&](Index p) { return partner_[p] < 0; });
  }
  return masks;
}

template <int Dim>
SparseWeights MirroredModel<Dim>::symmetrized(
    const SparseWeights& weights,
    const std::function<SparseWeights(const PointList<Dim>&)>& at) const {
  const auto others = at_images(at);
  return SparseWeights::of(
      weights.num_control_points(), weights.num_points(), [&](Index p) -> Eigen::VectorXd {
        const Index partner = partner_[p];
        const Eigen::VectorXd here = weights.at(p),
                              there = partner < 0 ? others.at(~partner) : weights.at(partner);
        // The image of a point on the cage may be outside by rounding, and kept in place.
        if (here.isZero(0) || there.isZero(0)) return here;
        return (here + mirrored(there)) / 2;
      });
}

template <int Dim>
SparseWeights MirroredModel<Dim>::reduced(
    const ModelPart<Dim>& model, Index most,
    const std::function<SparseWeights(const ModelPart<Dim>&, Index)>& reduce) const {
  const auto count = static_cast<Index>(partner_.size());
  const auto n = model.weights.num_control_points();
  std::vector<Index> half, plane;
  for (Index p = 0; p < count; ++p) {
    const Index other = partner_[p];
    if (other == p) plane.push_back(p);
    // One side, so that neighbors are reduced together.
    const bool is_image = other >= 0 && points_(axis_, p) < points_(axis_, other);
    if (!is_image || other == p) half.push_back(p);
  }
  std::vector<Index> in_half, in_plane;
  const auto of_half = reduce(model.taken(half, in_half), most);
  // Half the influences, and their images.
  SparseWeights of_plane;
  if (most / 2 > Dim && !plane.empty()) of_plane = reduce(model.taken(plane, in_plane), most / 2);
  return SparseWeights::of(n, count, [&](Index p) -> Eigen::VectorXd {
    if (in_half[p] < 0) return mirrored(of_half.at(in_half[partner_[p]]));
    if (partner_[p] != p) return of_half.at(in_half[p]);
    for (const auto* found : std::initializer_list<const SparseWeights*>{&of_half, &of_plane}) {
      if (found->num_points() == 0) continue;
      const Eigen::VectorXd weights = found->at(found == &of_half ? in_half[p] : in_plane[p]);
      const Eigen::VectorXd both = (weights + mirrored(weights)) / 2;
      if ((both.array() != 0).count() <= most) return both;
    }
    return of_half.at(in_half[p]);
  });
}

template <int Dim>
ModelPart<Dim> ModelPart<Dim>::taken(const std::vector<Index>& chosen,
                                     std::vector<Index>& numbers) const {
  numbers.assign(points.cols(), -1);
  for (std::size_t k = 0; k < chosen.size(); ++k) numbers[chosen[k]] = static_cast<Index>(k);
  ModelPart part{points(Eigen::all, chosen), {}, take_points(weights, chosen), {}};
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    const Index a = numbers[edges.ends[e][0]], b = numbers[edges.ends[e][1]];
    if (a < 0 || b < 0) continue;
    part.edges.ends.push_back({a, b});
    if (!edges.weights.empty()) part.edges.weights.push_back(edges.weights[e]);
  }
  for (const auto& [control_points, region] : masks) {
    Mask mask{control_points, {}};
    for (const Index p : region) {
      if (numbers[p] >= 0) mask.points.push_back(numbers[p]);
    }
    if (!mask.points.empty()) part.masks.push_back(std::move(mask));
  }
  return part;
}

template struct ModelPart<2>;
template struct ModelPart<3>;
template class MirroredModel<2>;
template class MirroredModel<3>;

}  // namespace flbc
