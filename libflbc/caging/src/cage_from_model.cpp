// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cage_from_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "base/first_equals.h"
#include "base/instantiate.h"
#include "base/messages.h"
#include "base/shape_checks.h"
#include "cage/box_tree.h"
#include "cage/extent.h"
#include "caging/cage_steps.h"
#include "caging/coarsening.h"
#include "caging/enclosure.h"
#include "caging/gaps.h"
#include "caging/mirror_plane.h"
#include "caging/surface_tools.h"
#include "caging/thickness.h"
#include "flbc/cage.h"
#include "flbc/cage_facts.h"
#include "flbc/errors.h"
#include "flbc/meshing.h"

namespace flbc {

namespace {

// The alpha of a wrap that enters a gap, relative to the gap's width, and the smallest alpha,
// relative to model size.
constexpr double kAlphaOfGap = 0.33, kFinestWrap = 5e-3;

// Maximum distance of a mirror image from the model, relative to model size.
constexpr double kSymmetryTolerance = 0.01;

// Densities of control points, at the nearest vertices of a model.
template <int Dim>
class Densities {
 public:
  Densities(const PointList<Dim>& points, const Eigen::VectorXd& densities)
      : points_(points), densities_(densities) {
    if ((densities.array() == 1).all()) return;
    const auto last = static_cast<Index>(points.cols()) - 1;
    tree_.emplace(boxes_of<Dim, 1>(points, FacetList<1>::LinSpaced(points.cols(), 0, last)));
  }

  bool are_usual() const { return !tree_; }

  double at(const Vector<Dim>& place) const {
    if (are_usual()) return 1;
    return densities_(
        tree_->nearest(place, [&](Index v) { return (points_.col(v) - place).norm(); }));
  }

 private:
  const PointList<Dim>& points_;
  Eigen::VectorXd densities_;
  std::optional<BoxTree<Dim>> tree_{};
};

// The maximum distance of mirrored vertices from the model, except for those of small details.
// Vertices of another density are as far as the limit.
template <int Dim>
double asymmetry(const Enclosure<Dim>& model, const PointList<Dim>& points,
                 const Densities<Dim>& densities, const MirrorPlane& plane, double limit) {
  constexpr Index kMostVertices = 4000;
  const Index step = std::max<Index>(1, static_cast<Index>(points.cols()) / kMostVertices);
  constexpr double kDetails = 0.03;
  const auto count = static_cast<std::size_t>((points.cols() + step - 1) / step);
  const auto most = static_cast<std::size_t>((1 - kDetails) * static_cast<double>(count));
  std::vector<double> distances;
  std::size_t far = 0;
  for (Index v = 0; v < points.cols(); v += step) {
    const Vector<Dim> place = points.col(v), image = plane.mirrored(place);
    const bool is_as_dense = densities.at(image) == densities.at(place);
    distances.push_back(is_as_dense ? model.distance(image, limit) : limit);
    if (distances.back() >= limit && ++far >= count - most) return limit;
  }
  const auto place = distances.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(distances.begin(), place, distances.end());
  return *place;
}

// The requested plane through the center of the model. For kAuto, the plane of best symmetry if the
// model is symmetric.
template <int Dim>
MirrorPlane find_symmetry(const Enclosure<Dim>& model, const PointList<Dim>& points,
                          const Densities<Dim>& densities, const Vector<Dim>& center, double size,
                          CageSymmetry wanted) {
  if (wanted == CageSymmetry::kNone) return {};
  if (wanted != CageSymmetry::kAuto) {
    const int axis = static_cast<int>(wanted) - static_cast<int>(CageSymmetry::kX);
    return {axis, center(axis)};
  }
  MirrorPlane best;
  double least = kSymmetryTolerance * size;
  for (int axis = 0; axis < Dim; ++axis) {
    const MirrorPlane plane{axis, center(axis)};
    const double own = asymmetry(model, points, densities, plane, least);
    if (own < least) {
      least = own;
      best = plane;
    }
  }
  return best;
}

template <int Dim>
Cage<Dim> box_cage(const Vector<Dim>& low, const Vector<Dim>& high) {
  Cage<Dim> cage;
  if constexpr (Dim == 2) {
    cage.points.resize(2, 4);
    cage.points << low.x(), high.x(), high.x(), low.x(),  //
        low.y(), low.y(), high.y(), high.y();
    cage.facets.resize(2, 4);
    cage.facets << 0, 1, 2, 3, 1, 2, 3, 0;
  } else {
    // Corner k has the upper coordinate of axis i where bit i of k is set.
    cage.points.resize(3, 8);
    for (int k = 0; k < 8; ++k) {
      for (int i = 0; i < 3; ++i) cage.points(i, k) = (k >> i) % 2 == 0 ? low(i) : high(i);
    }
    cage.facets.resize(3, 12);
    cage.facets << 0, 3, 4, 7, 0, 5, 2, 7, 0, 6, 1, 7,  //
        2, 1, 5, 6, 1, 4, 6, 3, 4, 2, 3, 5,             //
        1, 2, 6, 5, 4, 1, 3, 6, 2, 4, 5, 3;
  }
  return cage;
}

// A corner with edges along the axes, long enough for the box to fit.
template <int Dim>
Cage<Dim> simplex_cage(const Vector<Dim>& low, const Vector<Dim>& high) {
  Cage<Dim> cage{low.replicate(1, Dim + 1), FacetList<Dim>(Dim, Dim + 1)};
  for (int k = 0; k < Dim; ++k) cage.points(k, k + 1) += Dim * 1.01 * (high(k) - low(k));
  if constexpr (Dim == 2) {
    cage.facets << 0, 1, 2, 1, 2, 0;
  } else {
    cage.facets << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
  }
  return cage;
}

// A box and a simplex around the given box. The box is symmetric about the center along every axis;
// the simplex is not. \param offset  between it and them
template <int Dim>
std::vector<Cage<Dim>> simple_cages(const Eigen::AlignedBox<double, Dim>& around, double offset) {
  const Vector<Dim> low = around.min().array() - offset, high = around.max().array() + offset;
  return {box_cage<Dim>(low, high), simplex_cage<Dim>(low, high)};
}

// Sizes relative to model size, for a wrap with several times the requested number of control
// points.
template <int Dim>
WrapSize wrap_size(double control_points) {
  if (Dim == 2) {
    const double offset = std::clamp(0.8 / control_points, 0.005, 0.04);
    return {2 * offset, offset};
  }
  const double root = std::sqrt(control_points);
  return {std::clamp(0.4 / root, 0.012, 0.2), std::clamp(1 / (6 * root), 0.004, 0.05)};
}

template <int Dim>
constexpr Index kUsualNumber = Dim == 2 ? 30 : 100;

// Chosen by the shape.
template <int Dim>
constexpr Index kMostByShape = Dim == 2 ? 60 : 300;

// Longer boundaries get more control points.
Index number_by_shape(const Cage<2>& wrap, double model_size) {
  double length = 0;
  for (Index e = 0; e < wrap.facets.cols(); ++e) {
    length += (wrap.points.col(wrap.facets(0, e)) - wrap.points.col(wrap.facets(1, e))).norm();
  }
  return std::clamp(static_cast<Index>(8 * length / model_size), 12, kMostByShape<2>);
}

// The largest number of facets at a control point. In a closed surface there are as many edges.
template <int Dim>
Index max_valence(const Cage<Dim>& cage) {
  std::vector<Index> valences(static_cast<std::size_t>(cage.size()), 0);
  for (const Index v : cage.facets.reshaped()) ++valences[v];
  return *std::max_element(valences.begin(), valences.end());
}

// Finds the gaps that a cage bridges. \return the width of the narrowest
double note_bridged(ModelCage<3>& made, const Gaps& gaps, double size) {
  made.bridged_gaps = gaps.bridged_by(made.cage);
  double width = size;
  for (const auto& gap : made.bridged_gaps) width = std::min(width, gap.width);
  made.may_part = kAlphaOfGap * width > kFinestWrap * size;
  return width;
}

// Makes a cage around a model of size about 1.
template <int Dim>
class Caging {
 public:
  // \param cell  of the simplified model; 0: the model as it is
  Caging(const PointList<Dim>& points, const FacetList<Dim>& facets, const CagingOptions& options,
         const Densities<Dim>& densities, double cell)
      : options_(options), densities_(densities), size_(bounding_box_diagonal<Dim>(points)) {
    Cage<Dim> model{points, facets};
    if (cell > 0) {
      report(CagingStage::kSimplify);
      model = simplified<Dim>(points, facets, cell);
    }
    report(CagingStage::kWrap);
    const Eigen::AlignedBox<double, Dim> box(points.rowwise().minCoeff(),
                                             points.rowwise().maxCoeff());
    model_.emplace(model.points, model.facets);
    plane_ = find_symmetry<Dim>(*model_, model.points, densities_, box.center(), size_,
                                options.symmetry);
    if constexpr (Dim == 3) {
      is_closed_ = is_closed({points, facets});
      volume_ = solid_volume({points, facets}, is_closed_);
      thickness_ = is_closed_ && volume_ > 0 ? 2 * volume_ / area_of(points, facets) : 0;
    }
    whole_ = model;
    if (!plane_.is_there()) return;
    // Adding the mirror image makes the model symmetric.
    whole_ = with_mirror_image(model, plane_);
    model_.emplace(whole_.points, whole_.facets);
  }

  // \return empty if no cage encloses the model
  std::optional<ModelCage<Dim>> make() {
    const Index given = options_.control_points;
    auto made = make_by_wrap();
    if constexpr (Dim == 3) {
      if (!made) return {};
      if (auto convex = make_convex(*made, given > 0)) made = convex;
      part_limbs(*made, given);
    }
    return made;
  }

 private:
  std::optional<ModelCage<Dim>> make_by_wrap() {
    if (options_.control_points == 0) {
      if (auto made = make_by_shape()) return made;
    }
    // Limits give way to a number of control points that cannot keep them.
    for (const auto& limits : {limits_, CageLimits{}}) {
      if (auto made = make_in_limits(limits)) return made;
    }
    const double offset = size_at(options_.control_points).offset;
    for (const auto& cage : simple_cages<Dim>(model_->box(), offset)) {
      if (is_sound(cage)) return describe(cage, offset);
      plane_ = {};
    }
    return {};
  }

  void report(CagingStage stage, double done = 0) const {
    if (options_.stage) options_.stage(stage, done);
  }

  WrapSize size_at(Index control_points, double scale = 1) const {
    WrapSize size = wrap_size<Dim>(control_points);
    size.alpha *= scale * size_;
    size.offset *= std::sqrt(scale) * size_;
    // A thin model gets a closer wrap.
    if (has_volume()) size.offset = std::min(size.offset, 0.4 * thickness_);
    if (options_.offset > 0) size.offset = options_.offset;
    return size;
  }

  // Closed, or its half; no facets if wrapping failed.
  Cage<Dim> wrap_of(const WrapSize& size) const {
    report(CagingStage::kWrap);
    const bool is_open = Dim == 3 && !is_closed_;
    if (!plane_.is_there() && !is_open) return wrap(*model_, size);
    const Parting parting{plane_, 2 * size.alpha, 1e-2 * size.offset, 0.3 * size.offset};
    Cage<Dim> solid = plane_.is_there() ? parting.part(whole_) : whole_;
    if constexpr (Dim == 3) {
      if (is_open) solid = filled(solid, size.alpha);
    }
    const Cage<Dim> surface = wrap(Enclosure<Dim>(solid.points, solid.facets), size);
    if (surface.facets.cols() == 0 || !plane_.is_there()) return surface;
    return parting.joined_half(surface);
  }

  std::optional<ModelCage<Dim>> make_in_limits(const CageLimits& limits) const {
    constexpr double kCoarsening = 1.4, kCoarsest = 2;
    for (double scale = 1;; scale *= kCoarsening) {
      const auto size = size_at(options_.control_points, scale);
      if (size.alpha > kCoarsest * size_) return {};
      const auto surface = wrap_of(size);
      if (surface.facets.cols() == 0) continue;
      if (auto made = make_of_number(surface, size.offset, limits)) return made;
    }
  }

  std::optional<ModelCage<Dim>> make_of_number(const Cage<Dim>& surface, double offset,
                                               CageLimits limits) const {
    if constexpr (Dim == 3) {
      limits.lengths = edge_lengths(surface, kShort);
      limits.lengths_grow = true;
    }
    const auto cage = reduced(surface, offset, options_.control_points, limits);
    if (!cage) return {};
    return describe(*cage, offset);
  }

  // Chooses the number of control points. If it fails, the usual number is left to be tried.
  std::optional<ModelCage<Dim>> make_by_shape() {
    if constexpr (Dim == 2) {
      const auto surface = wrap(*model_, size_at(kUsualNumber<2>));
      options_.control_points =
          surface.facets.cols() > 0 ? number_by_shape(surface, size_) : kUsualNumber<2>;
    } else {
      // Longer edges take fewer control points. A model with thin limbs gets a finer wrap, unless
      // it would take too many control points: then it is boxed in.
      const double most = most_volume();
      options_.control_points = kMostByShape<3>;
      std::map<Index, Cage<3>> wraps;
      for (const auto& [fineness, limit, edge] :
           {std::tuple(kUsualNumber<3>, most, kShort), std::tuple(kUsualNumber<3>, most, kLong),
            std::tuple(kMostByShape<3>, most, kLong),
            std::tuple(kUsualNumber<3>, kNoLimit, kLong)}) {
        const auto size = size_at(fineness);
        const auto [surface, is_new] = wraps.try_emplace(fineness);
        if (is_new) surface->second = wrap_of(size);
        if (auto made = make_close(surface->second, size.offset, limit, edge)) return made;
      }
      options_.control_points = kUsualNumber<3>;
    }
    return {};
  }

  // As few control points as possible in a volume that is not much larger than that of the wrap. A
  // nearly convex model may have few; others need some to bend limbs.
  // \param edge  maximum length of edges, relative to thickness
  std::optional<ModelCage<3>> make_close(const Cage<3>& surface, double offset, double most_volume,
                                         double edge) const {
    constexpr double kGrowth = 1.3, kFreeVolume = 2, kConvex = 0.65;
    constexpr Index kLeast = 40;
    const double volume = (plane_.is_there() ? 2 : 1) * volume_of(surface);
    if (!(volume > 0 && volume <= most_volume)) return {};
    auto limits = limits_;
    limits.growth =
        std::min(std::max(kGrowth * volume, kFreeVolume * volume_), most_volume) / volume;
    limits.lengths = edge_lengths(surface, edge);
    const bool is_convex = volume > kConvex * hull_volume(surface);
    const auto cage = reduced(surface, offset, is_convex ? kLeastOfConvex : kLeast, limits);
    if (!cage) return {};
    return describe(*cage, offset);
  }

  // At every vertex; they leave control points along limbs, at which these bend.
  std::vector<double> edge_lengths(const Cage<3>& surface, double edge) const {
    const auto whole = plane_.is_there() ? join_halves(surface, plane_) : surface;
    auto lengths = thickness_of(whole);
    lengths.resize(static_cast<std::size_t>(surface.size()));
    for (double& length : lengths) length *= edge;
    return lengths;
  }

  double hull_volume(const Cage<3>& surface) const {
    const auto whole = plane_.is_there() ? with_mirror_image(surface, plane_) : surface;
    return signed_measure<3>(convex_hull(whole.points), model_->box().center());
  }

  // If a cage bridges narrow gaps, tries a wrap that is fine enough for them.
  void part_limbs(ModelCage<3>& made, Index given) {
    const Gaps gaps(whole_, *model_);
    double width = note_bridged(made, gaps, size_);
    if (made.bridged_gaps.empty() || options_.offset > 0) return;
    const double finest = given == 0 || !is_closed_ ? kFinestByShape : kFinestWrap;
    width = std::max(width, finest / kAlphaOfGap * size_);
    const WrapSize size{kAlphaOfGap * width, kOffsetOfGap * width};
    const auto surface = wrap_of(size);
    if (surface.facets.cols() == 0) return;
    const auto whole = plane_.is_there() ? join_halves(surface, plane_) : surface;
    const auto count = made.bridged_gaps.size();
    if (gaps.bridged_by(whole).size() >= count) return;
    options_.control_points = given > 0 ? given : kMostByShape<3>;
    for (const double edge : {kShort, kLong}) {
      auto other = given > 0 ? make_of_number(surface, size.offset, limits_)
                             : make_close(surface, size.offset, most_volume(), edge);
      if (!other) continue;
      other->bridged_gaps = gaps.bridged_by(other->cage);
      // With few control points, a cage of a finer wrap can be larger and cut the gap only in part.
      const bool is_smaller = measure_cage(other->cage).measure < measure_cage(made.cage).measure;
      if (other->bridged_gaps.size() >= count || !is_smaller) continue;
      other->may_part = made.may_part;
      made = *other;
      return;
    }
  }

  // From the convex hull instead of a wrap, if the model is convex and that is smaller without more
  // control points, or if the other cage is much larger than the hull.
  std::optional<ModelCage<3>> make_convex(const ModelCage<3>& other, bool is_given) {
    constexpr double kMostOfHull = 1.095, kConvex = 0.9;
    if (options_.offset > 0 || !densities_.are_usual()) return {};
    const double measure = measure_cage(other.cage).measure;
    const auto convex = convex_surface(whole_.points, size_at(kUsualNumber<3>).offset);
    const auto& surface = convex.surface;
    if (surface.facets.cols() == 0 || measure <= convex.hull_volume) return {};
    const bool is_large = measure > kMostOfHull * convex.hull_volume;
    if (!is_large && volume_ < kConvex * convex.hull_volume) return {};
    if (!is_given) options_.control_points = kMostByShape<3>;
    if (!is_large) options_.control_points = std::min(options_.control_points, other.cage.size());
    const auto made = [&](const std::optional<Cage<3>>& cage) -> std::optional<ModelCage<3>> {
      if (!cage || measure_cage(*cage).measure >= measure) return {};
      return describe(*cage, convex.offset);
    };
    // Symmetric without being halved.
    if (surface.size() <= kFewOfConvex && is_sound(surface)) return made(surface);
    auto close = limits_;
    close.growth = kMostOfHull * convex.hull_volume / volume_of(surface);
    for (const auto& limits : {close, CageLimits{}}) {
      const auto start =
          plane_.is_there() ? cut_half<3>(surface, plane_, 1e-3 * convex.offset) : surface;
      for (const double edge : {convex.edge_length, kNoLimit}) {
        auto own = limits;
        own.lengths.assign(static_cast<std::size_t>(start.size()), edge);
        const Index least = is_given ? options_.control_points : kLeastOfConvex;
        if (const auto cage = made(reduced(start, convex.offset, least, own))) return cage;
        if (edge == kNoLimit) break;
      }
    }
    return {};
  }

  // The larger ones of both sides of the plane.
  std::vector<double> densities_at(const PointList<Dim>& places) const {
    std::vector<double> densities;
    for (const Vector<Dim> place : places.colwise()) {
      densities.push_back(densities_.at(place));
      if (!plane_.is_there()) continue;
      densities.back() = std::max(densities.back(), densities_.at(plane_.mirrored(place)));
    }
    return densities;
  }

  double most_volume() const { return 0.97 * kMaxCageVolume * volume_; }

  // Half a surface needs no facets in the plane, because the origin is in it too.
  double volume_of(const Cage<3>& surface) const {
    return signed_measure<3>(surface, model_->box().center());
  }

  // \return empty if it has more control points than the options permit
  std::optional<Cage<Dim>> reduced(const Cage<Dim>& start, double offset, Index control_points,
                                   CageLimits limits) const {
    if (start.facets.cols() == 0) return {};
    limits.densities = densities_at(start.points);
    for (std::size_t v = 0; v < limits.lengths.size(); ++v) {
      limits.lengths[v] *= std::pow(limits.densities[v], -1.0 / (Dim - 1));
    }
    Coarsening<Dim> coarsening(start, plane_, *model_, offset, limits);
    coarsening.reduce_to(control_points, [&](double done) { report(CagingStage::kReduce, done); });
    if (coarsening.num_control_points() > options_.control_points) return {};
    coarsening.relax();
    Cage<Dim> surface = coarsening.surface();
    if (plane_.is_there()) surface = join_halves(surface, plane_);
    if (!is_sound(surface)) return {};
    return surface;
  }

  bool is_sound(const Cage<Dim>& cage) const {
    report(CagingStage::kCheck);
    return cage.size() <= options_.control_points && find_defects(cage, 1).empty() &&
           find_self_intersections(cage, 1).empty() && model_->is_strictly_inside(cage);
  }

  // Open and flat models have none to speak of.
  bool has_volume() const { return thickness_ > kFlat * size_; }

  ModelCage<Dim> describe(const Cage<Dim>& cage, double offset) const {
    ModelCage<Dim> made{cage, offset, plane_.axis, plane_.position, distances(cage, *model_).mean};
    for (Index v = 0; v < cage.size(); ++v) {
      made.max_distance =
          std::max(made.max_distance, model_->distance(Vector<Dim>(cage.points.col(v))));
    }
    made.max_valence = max_valence(cage);
    if constexpr (Dim == 3) {
      if (has_volume()) made.volume_ratio = measure_cage(cage).measure / volume_;
    }
    return made;
  }

  static constexpr Index kLeastOfConvex = 8, kFewOfConvex = 16;
  // Edges no longer than the wrap is thick leave three rings at a limb.
  static constexpr double kShort = 1, kLong = 1.4;
  // Of a wrap, relative to the width of a gap that it enters, and the smallest alpha, relative to
  // model size.
  static constexpr double kOffsetOfGap = 0.1, kFinestByShape = 8e-3;
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  CagingOptions options_;
  const Densities<Dim>& densities_;
  double size_;
  CageLimits limits_{kMaxCageValence, kMaxCageDistance* size_};
  MirrorPlane plane_{};
  Cage<Dim> whole_{};  // the model, with its mirror image if there is a plane
  double volume_ = 0;  // of the model, in 3D; an estimate if it is open
  bool is_closed_ = false;
  double thickness_ = 0;  // the mean of a closed model, in 3D
  std::optional<Enclosure<Dim>> model_{};
};

template <int Dim>
void check_indices_and_places(const PointList<Dim>& points, const FacetList<Dim>& facets) {
  for (Index v = 0; v < points.cols(); ++v) {
    if (points.col(v).allFinite()) continue;
    throw InputError("vertex " + std::to_string(v) + " at " + format_point(points.col(v)) +
                     " is not finite");
  }
  check_indices(facets, points.cols(), {"model", "facet", "vertex", "vertices"});
}

template <int Dim>
void check_input(const PointList<Dim>& points, const FacetList<Dim>& facets,
                 const CagingOptions& options) {
  check_indices_and_places<Dim>(points, facets);
  const auto defect = extent_defect<Dim>(points, "model", "vertex 0");
  if (!defect.empty()) throw InputError(defect);
  const double size = bounding_box_diagonal<Dim>(points);
  const std::string least = std::to_string(Dim + 1);
  if (options.control_points != 0 && options.control_points <= Dim) {
    throw OptionError("the number of control points must be at least " + least);
  }
  if (!(options.offset >= 0 && options.offset <= 10 * size)) {
    throw OptionError("the offset must be from 0 to 10 times the model size of " +
                      format_number(size));
  }
  if (Dim == 2 && options.symmetry == CageSymmetry::kZ) {
    throw OptionError("a 2D cage cannot be symmetric across z");
  }
  const auto& density = options.density;
  if (density.size() == 0) return;
  if (density.size() != points.cols()) {
    throw InputError(std::to_string(density.size()) + " densities do not match " +
                     std::to_string(points.cols()) + " model vertices; give one for each");
  }
  for (Index v = 0; v < density.size(); ++v) {
    if (density(v) >= 1 / kMaxCageDensity && density(v) <= kMaxCageDensity) continue;
    throw InputError("the density at vertex " + std::to_string(v) + " is " +
                     format_number(density(v)) + "; give numbers from 0.01 to 100, 1 is usual");
  }
}

// A large 3D model is simplified first. If the simplified model has no cage, or one that does not
// enclose the model itself, the model is used as it is.
template <int Dim>
ModelCage<Dim> make_checked(const PointList<Dim>& points, const FacetList<Dim>& facets,
                            const CagingOptions& options, const Densities<Dim>& densities) {
  constexpr Eigen::Index kManyFacets = 200000;
  constexpr double kCellPerOffset = 0.25;
  const Index number = options.control_points > 0 ? options.control_points : kUsualNumber<Dim>;
  if (Dim == 3 && facets.cols() > kManyFacets) {
    double offset = options.offset;
    if (offset == 0) {
      offset = wrap_size<Dim>(number).offset * bounding_box_diagonal<Dim>(points);
    }
    const auto made =
        Caging<Dim>(points, facets, options, densities, kCellPerOffset * offset).make();
    if (made && Enclosure<Dim>(points, facets).is_strictly_inside(made->cage)) return *made;
  }
  const auto made = Caging<Dim>(points, facets, options, densities, 0).make();
  if (made) return *made;
  throw InputError("no cage with at most " + std::to_string(number) +
                   " control points encloses the model; allow more control points");
}

// Vertices in one place are one, as in files that have seams or not. The largest density counts.
template <int Dim>
Cage<Dim> merged(const PointList<Dim>& points, const FacetList<Dim>& facets,
                 Eigen::VectorXd& density) {
  const auto first = first_equals<Dim>(points);
  std::vector<Index> kept, number(first.size());
  for (std::size_t v = 0; v < first.size(); ++v) {
    const bool is_first = first[v] == static_cast<Index>(v);
    number[v] = is_first ? static_cast<Index>(kept.size()) : number[first[v]];
    if (is_first) kept.push_back(first[v]);
    if (density.size() > 0) density(first[v]) = std::max(density(first[v]), density(v));
  }
  if (density.size() > 0) density = density(kept).eval();
  return {points(Eigen::all, kept), facets.unaryExpr([&](Index v) { return number[v]; })};
}

// Whether a part of the cage contains only the mirror image of a part of the model.
template <int Dim>
bool has_empty_part(const Cage<Dim>& cage, const PointList<Dim>& points) {
  const auto parts = cage_parts(cage);
  return parts.size() > 1 && std::any_of(parts.begin(), parts.end(), [&](const auto& part) {
           return static_cast<Eigen::Index>(points_outside<Dim>(part.cage, points).size()) ==
                  points.cols();
         });
}

}  // namespace

template <int Dim>
std::string describe_bridged_gaps(const ModelCage<Dim>& made) {
  constexpr std::size_t kMostShown = 4;
  const auto& gaps = made.bridged_gaps;
  if (gaps.empty()) return {};
  std::string places;
  for (std::size_t k = 0; k < std::min(gaps.size(), kMostShown); ++k) {
    places += (k > 0 ? ", " : "") + format_point(gaps[k].place) + " (" +
              format_number(gaps[k].width) + " wide)";
  }
  if (gaps.size() > kMostShown) places += ", ...";
  return "the cage bridges " + std::to_string(gaps.size()) +
         (gaps.size() == 1 ? " narrow gap of the model at " : " narrow gaps of the model, at ") +
         places + ", so parts on both sides move together; " +
         (made.may_part ? "allow more control points" : "open the gaps in the model");
}

template <int Dim>
ModelCage<Dim> with_bridged_gaps(const Cage<Dim>& cage, const PointList<Dim>& points,
                                 const FacetList<Dim>& facets) {
  check_indices_and_places<Dim>(points, facets);
  ModelCage<Dim> made;
  made.cage = cage;
  if constexpr (Dim == 3) {
    if (facets.cols() == 0) return made;
    const Gaps gaps({points, facets}, Enclosure<3>(points, facets));
    note_bridged(made, gaps, bounding_box_diagonal<Dim>(points));
  }
  return made;
}

template <int Dim>
ModelCage<Dim> cage_from_model(const PointList<Dim>& points, const FacetList<Dim>& facets,
                               const CagingOptions& options) {
  check_input<Dim>(points, facets, options);
  // A power of two, so scaling is exact, and exact checks also hold for the original model.
  const double unit = std::exp2(std::ilogb(bounding_box_diagonal<Dim>(points)));
  CagingOptions scaled = options;
  scaled.offset /= unit;
  const auto model = merged<Dim>(points / unit, facets, scaled.density);
  const auto& own = model.points;
  const Densities<Dim> densities(own, scaled.density), usual(own, {});
  if (options.control_points == 0 && !densities.are_usual()) {
    // A usual cage has as many as a density of 1 takes.
    const auto cage = make_checked<Dim>(own, model.facets, scaled, usual).cage;
    double number = 0;
    for (const auto& point : cage.points.colwise()) number += densities.at(point);
    scaled.control_points =
        static_cast<Index>(std::clamp<double>(number, 2 * Dim, kMostByShape<Dim>));
  }
  auto made = make_checked<Dim>(own, model.facets, scaled, densities);
  if (made.symmetry_axis >= 0 && scaled.symmetry == CageSymmetry::kAuto &&
      has_empty_part<Dim>(made.cage, own)) {
    scaled.symmetry = CageSymmetry::kNone;
    made = make_checked<Dim>(own, model.facets, scaled, densities);
  }
  made.cage.points *= unit;
  made.offset *= unit;
  made.symmetry_place *= unit;
  made.mean_distance *= unit;
  made.max_distance *= unit;
  for (auto& gap : made.bridged_gaps) gap = {unit * gap.place, unit * gap.width};
  return made;
}

FLBC_INSTANTIATE_FUNCTION(cage_from_model)
FLBC_INSTANTIATE_FUNCTION(with_bridged_gaps)
FLBC_INSTANTIATE_FUNCTION(describe_bridged_gaps)

}  // namespace flbc
