// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cage_from_model.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "base/instantiate.h"
#include "base/messages.h"
#include "caging/coarsening.h"
#include "caging/enclosure.h"
#include "caging/mirror_plane.h"
#include "caging/surface_tools.h"
#include "caging/wrap.h"
#include "flbc/cage.h"
#include "flbc/errors.h"
#include "flbc/meshing.h"

namespace flbc {

namespace {

// Maximum distance of a mirror image from the model, relative to model size.
constexpr double kSymmetryTolerance = 0.005;

template <int Dim>
MirrorPlane plane_across(const Enclosure<Dim>& model, int axis) {
  return {axis, model.box().center()(axis)};
}

// The maximum distance of mirrored vertices from the model.
template <int Dim>
double asymmetry(const Enclosure<Dim>& model, const PointList<Dim>& points,
                 const MirrorPlane& plane, double limit) {
  constexpr Index kMostVertices = 4000;
  const Index step = std::max<Index>(1, static_cast<Index>(points.cols()) / kMostVertices);
  double largest = 0;
  for (Index v = 0; v < points.cols() && largest < limit; v += step) {
    const Vector<Dim> image = plane.mirrored(Vector<Dim>(points.col(v)));
    largest = std::max(largest, model.distance(image, limit));
  }
  return largest;
}

// The requested plane through the center of the model. For kAuto, the plane of best symmetry if the
// model is symmetric.
template <int Dim>
MirrorPlane find_symmetry(const PointList<Dim>& points, const FacetList<Dim>& facets,
                          CageSymmetry wanted) {
  if (wanted == CageSymmetry::kNone) return {};
  const Enclosure<Dim> model(points, facets);
  if (wanted == CageSymmetry::kX) return plane_across(model, 0);
  if (wanted == CageSymmetry::kY) return plane_across(model, 1);
  if (Dim == 3 && wanted == CageSymmetry::kZ) return plane_across(model, Dim - 1);
  MirrorPlane best;
  double least = kSymmetryTolerance * model.box().diagonal().norm();
  for (int axis = 0; axis < Dim; ++axis) {
    const auto plane = plane_across(model, axis);
    const double own = asymmetry(model, points, plane, least);
    if (own < least) {
      least = own;
      best = plane;
    }
  }
  return best;
}

// Barycentric coordinates of the centers of equal pieces of a facet.
template <int Dim>
std::vector<Vector<Dim>> spread_coordinates() {
  constexpr int kPieces = 8;
  std::vector<Vector<Dim>> all;
  for (int i = 0; i < kPieces; ++i) {
    if constexpr (Dim == 2) {
      const double t = (i + 0.5) / kPieces;
      all.push_back({t, 1 - t});
    } else {
      for (int j = 0; i + j < kPieces; ++j) {
        const double s = (i + 1.0 / 3) / kPieces, t = (j + 1.0 / 3) / kPieces;
        all.push_back({s, t, 1 - s - t});
      }
    }
  }
  return all;
}

// Mean distance of the cage surface (2D: lines) from the model, at points evenly distributed on
// every facet.
template <int Dim>
double mean_distance(const Cage<Dim>& cage, const Enclosure<Dim>& model) {
  const auto coordinates = spread_coordinates<Dim>();
  const double farthest = 8 * model.box().diagonal().norm();
  double sum = 0, total = 0;
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners.col(k) = cage.points.col(cage.facets(k, f));
    const double part = facet_normal<Dim>(corners).norm() / static_cast<double>(coordinates.size());
    for (const auto& weights : coordinates) {
      sum += part * model.distance(corners * weights, farthest);
      total += part;
    }
  }
  return sum / total;
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

template <int Dim>
double total_measure(const Cage<Dim>& cage) {
  double sum = 0;
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners.col(k) = cage.points.col(cage.facets(k, f));
    sum += facet_normal<Dim>(corners).norm();
  }
  return sum;
}

// Longer and more complex boundaries get more control points.
template <int Dim>
Index number_by_shape(const Cage<Dim>& wrap, double model_size) {
  if (Dim == 2) {
    return std::clamp(static_cast<Index>(8 * total_measure(wrap) / model_size), 12, 60);
  }
  return std::clamp(wrap.size() / 5, 50, 150);
}

// Makes a cage around a model of size about 1.
template <int Dim>
class Caging {
 public:
  Caging(const PointList<Dim>& points, const FacetList<Dim>& facets, const CagingOptions& options)
      : options_(options),
        size_(bounding_box_diagonal<Dim>(points)),
        plane_(find_symmetry<Dim>(points, facets, options.symmetry)),
        model_(enclosed(points, facets)) {}

  ModelCage<Dim> make() {
    constexpr double kCoarsening = 1.4, kCoarsest = 2;
    for (double scale = 1;; scale *= kCoarsening) {
      const auto size = size_at(scale);
      if (size.alpha > kCoarsest * size_) break;
      if (const auto cage = try_wrap(size)) return describe(*cage, size.offset);
    }
    if (options_.control_points == 0) options_.control_points = kUsualNumber<Dim>;
    const double offset = size_at(1).offset;
    for (const auto& cage : simple_cages<Dim>(model_.box(), offset)) {
      if (is_sound(cage)) return describe(cage, offset);
      plane_ = {};
    }
    throw InputError("no cage with at most " + std::to_string(options_.control_points) +
                     " control points encloses the model");
  }

 private:
  // Adding the mirror image makes the model symmetric.
  Enclosure<Dim> enclosed(const PointList<Dim>& points, const FacetList<Dim>& facets) const {
    const Cage<Dim> shape{points, facets};
    if (!plane_.is_there()) return {points, facets};
    const auto both = with_mirror_image(shape, plane_);
    return {both.points, both.facets};
  }

  WrapSize size_at(double scale) const {
    const Index wanted = options_.control_points > 0 ? options_.control_points : kUsualNumber<Dim>;
    WrapSize size = wrap_size<Dim>(wanted);
    size.alpha *= scale * size_;
    size.offset *= std::sqrt(scale) * size_;
    if (options_.offset > 0) size.offset = options_.offset;
    return size;
  }

  std::optional<Cage<Dim>> try_wrap(const WrapSize& size) {
    Cage<Dim> surface = wrap(model_, size);
    if (surface.facets.cols() == 0) return {};
    if (options_.control_points == 0) options_.control_points = number_by_shape(surface, size_);
    if (plane_.is_there()) surface = cut_half(surface, plane_, 1e-2 * size.offset);
    Coarsening<Dim> coarsening(surface, plane_, model_, size.offset);
    coarsening.reduce_to(options_.control_points);
    if (coarsening.num_control_points() > options_.control_points) return {};
    coarsening.relax();
    surface = coarsening.surface();
    if (plane_.is_there()) surface = join_halves(surface, plane_);
    if (!is_sound(surface)) return {};
    return surface;
  }

  bool is_sound(const Cage<Dim>& cage) const {
    return cage.size() <= options_.control_points && find_defects(cage, 1).empty() &&
           find_self_intersections(cage, 1).empty() && model_.is_strictly_inside(cage);
  }

  ModelCage<Dim> describe(const Cage<Dim>& cage, double offset) const {
    return {cage, offset, plane_.axis, plane_.position, mean_distance(cage, model_)};
  }

  CagingOptions options_;
  double size_;
  MirrorPlane plane_;
  Enclosure<Dim> model_;
};

template <int Dim>
void check_input(const PointList<Dim>& points, const FacetList<Dim>& facets,
                 const CagingOptions& options) {
  for (Index v = 0; v < points.cols(); ++v) {
    if (points.col(v).allFinite()) continue;
    throw InputError("vertex " + std::to_string(v) + " at " + format_point(points.col(v)) +
                     " is not finite");
  }
  if (facets.size() > 0 && (facets.minCoeff() < 0 || facets.maxCoeff() >= points.cols())) {
    throw InputError("a facet of the model refers to a vertex that does not exist");
  }
  const double size = points.cols() > 0 ? bounding_box_diagonal<Dim>(points) : 0;
  if (!(size >= 1e-30 && size <= 1e30)) {
    throw InputError("the model size of " + format_number(size) +
                     " is out of range; it must be from 1e-30 to 1e30");
  }
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
}

}  // namespace

template <int Dim>
ModelCage<Dim> cage_from_model(const PointList<Dim>& points, const FacetList<Dim>& facets,
                               const CagingOptions& options) {
  check_input<Dim>(points, facets, options);
  // A power of two, so scaling is exact, and exact checks also hold for the original model.
  const double unit = std::exp2(std::ilogb(bounding_box_diagonal<Dim>(points)));
  CagingOptions scaled = options;
  scaled.offset /= unit;
  auto made = Caging<Dim>(points / unit, facets, scaled).make();
  made.cage.points *= unit;
  made.offset *= unit;
  made.symmetry_place *= unit;
  made.mean_distance *= unit;
  return made;
}

FLBC_INSTANTIATE_FUNCTION(cage_from_model)

}  // namespace flbc
