// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/binding.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/shape_checks.h"
#include "base/weighted_sums.h"
#include "binding/solid.h"
#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/non_negative.h"
#include "flbc/place_masks.h"
#include "flbc/report.h"
#include "flbc/rig.h"
#include "placement/nearest_weights.h"

namespace flbc {
namespace {

// The pairs (point, control point) for which a function is true, as masks.
template <class IsMasked>
std::vector<Mask> masks_where(Index num_control_points, Index num_points,
                              const IsMasked& is_masked) {
  std::vector<Mask> masks;
  for (Index i = 0; i < num_control_points; ++i) {
    Mask mask{{i}, {}};
    for (Index p = 0; p < num_points; ++p) {
      if (is_masked(p, i)) mask.points.push_back(p);
    }
    if (!mask.points.empty()) masks.push_back(std::move(mask));
  }
  return masks;
}

// Edges as elements; points without edges if there are none.
FacetList<3> elements_of(const EdgeList& edges, Index num_points) {
  if (edges.ends.empty()) {
    return Eigen::RowVectorX<Index>::LinSpaced(num_points, 0, num_points - 1).replicate(3, 1);
  }
  FacetList<3> elements(3, static_cast<Eigen::Index>(edges.ends.size()));
  for (Eigen::Index e = 0; e < elements.cols(); ++e) {
    const auto& [a, b] = edges.ends[static_cast<std::size_t>(e)];
    elements.col(e) << a, b, b;
  }
  return elements;
}

template <int Dim>
void require_domain(const DomainMesh<Dim>& domain) {
  if (domain.num_cells() > 0) return;
  throw InputError(
      "the binding has no domain mesh, by which other points and Jacobians could be evaluated; "
      "bind the model again, or give a mesh");
}

// The weights of a joint do not reproduce points, as those of other points would.
void require_no_joint(const std::vector<Index>& held, const char* change) {
  if (held.empty()) return;
  throw InputError(std::string("the binding has a joint, so it cannot be ") + change +
                   "; do that first, then make the joint");
}

// Makes the weights of other points symmetric, as those of a mirrored binding are.
// \param at  returns weights at given points
template <int Dim>
void mirror_again(Binding<Dim>& binding, int axis,
                  const std::function<SparseWeights(const PointList<Dim>&)>& at) {
  const MirroredModel<Dim> mirrored(binding.cage, axis, binding.rest());
  binding.weights = mirrored.symmetrized(binding.weights, at);
  binding.mirror = mirrored.mirror();
  const auto& partners = binding.mirror->partners;
  const auto& images = binding.mirror->images;
  const PointMasks masks(binding.masks, binding.cage.size(), binding.weights.num_points());
  binding.masks =
      masks_where(binding.cage.size(), binding.weights.num_points(), [&](Index p, Index i) {
        return masks.forbids(p, i) && partners[p] >= 0 && masks.forbids(partners[p], images[i]);
      });
}

// The masks of other points: where all vertices of the nearest element are masked.
// \param n  number of control points
template <int Dim>
std::vector<Mask> masks_near(const std::vector<Mask>& masks, Index n,
                             const ModelElements<Dim>& elements, const PointList<Dim>& to) {
  if (masks.empty()) return {};
  const auto count = static_cast<Index>(elements.points.cols());
  const PointMasks masked(masks, n, count);
  const auto indicators = SparseWeights::of(n, count, [&](Index p) -> Eigen::VectorXd {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    if (masked.at(p)) row(masked.forbidden(p)).setOnes();
    return row;
  });
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const auto near = nearest_weights(elements, indicators, to, kAnywhere);
  constexpr double kRounding = 1e-12;  // of interpolated ones
  std::vector<Mask> found(n);
  for (Index i = 0; i < n; ++i) found[i].control_points = {i};
  for (Index p = 0; p < near.num_points(); ++p) {
    near.visit(p, [&](Index i, double part) {
      if (part > 1 - kRounding) found[i].points.push_back(p);
    });
  }
  found.erase(std::remove_if(found.begin(), found.end(),
                             [](const Mask& mask) { return mask.points.empty(); }),
              found.end());
  return found;
}

// The same for solid regions, as masks of their numbers.
template <int Dim>
std::vector<std::vector<Index>> solid_near(const std::vector<std::vector<Index>>& solid,
                                           const ModelElements<Dim>& elements,
                                           const PointList<Dim>& to) {
  std::vector<Mask> numbered;
  const auto count = static_cast<Index>(solid.size());
  for (Index k = 0; k < count; ++k) numbered.push_back({{k}, solid[k]});
  std::vector<std::vector<Index>> found;
  for (auto& region : masks_near(numbered, count, elements, to)) found.push_back(region.points);
  return found;
}

}  // namespace

template <int Dim>
Vector<Dim> Binding<Dim>::rest_of(Index p) const {
  if (offsets.cols() == 0) return points.col(p);
  if (weights.has_weights(p)) return points.col(p) + offsets.col(p);
  return offsets.col(p).isZero(0) ? points.col(p) : offsets.col(p);
}

template <int Dim>
PointList<Dim> Binding<Dim>::rest() const {
  if (offsets.cols() == 0) return points;
  PointList<Dim> all(Dim, points.cols());
  for (Index p = 0; p < weights.num_points(); ++p) all.col(p) = rest_of(p);
  return all;
}

template <int Dim>
PointList<Dim> Binding<Dim>::deform(const PointList<Dim>& control_points) const {
  PointList<Dim> moved(Dim, weights.num_points());
  deform_into(control_points, moved);
  return moved;
}

template <int Dim>
PointList<Dim> Binding<Dim>::deform(const PointList<Dim>& control_points,
                                    const PointList<Dim>& points, OutsidePoints outside) const {
  constexpr Eigen::Index kPart = 1 << 16;
  if (outside == OutsidePoints::kFail) place_points(cage, points);
  const bool is_one = mirror || !solid.empty();
  PointList<Dim> moved(Dim, points.cols());
  for (Eigen::Index begin = 0; begin < points.cols();) {
    const Eigen::Index count = is_one ? points.cols() : std::min(kPart, points.cols() - begin);
    const PointList<Dim> part = points.middleCols(begin, count);
    moved.middleCols(begin, count) = transferred(part, {}, outside).deform(control_points);
    begin += count;
  }
  return moved;
}

template <int Dim>
void Binding<Dim>::deform_into(const PointList<Dim>& control_points,
                               Eigen::Ref<PointList<Dim>> moved) const {
  if (moved.cols() != weights.num_points()) {
    throw InputError("there is space for " + std::to_string(moved.cols()) + " points, but " +
                     std::to_string(weights.num_points()) + " move");
  }
  check_size(weights, control_points.cols(), moved.cols());
  check_finite<Dim>(control_points);
  if (cage.size() == 0) {  // not known
    return for_sums<Dim>(weights, control_points, 0, [&](Index p, const Vector<Dim>& sum) {
      moved.col(p) = sum;
      if (offsets.cols() > 0) moved.col(p) += offsets.col(p);
    });
  }
  const PointList<Dim> moves = control_points - cage.points;
  for (const Index i : held) {
    if (moves.col(i).isZero(0)) continue;
    throw InputError("control point " + std::to_string(i) + " is held by the joint, but moves by " +
                     format_number(moves.col(i).norm()) +
                     "; leave it at rest, because the mesh passes through the cage there");
  }
  if (offsets.cols() == 0) {  // 1.3 times as fast as rest_of()
    return for_sums<Dim>(weights, moves, 0, [&](Index p, const Vector<Dim>& sum) {
      moved.col(p) = points.col(p) + sum;
    });
  }
  for_sums<Dim>(weights, moves, 0,
                [&](Index p, const Vector<Dim>& sum) { moved.col(p) = rest_of(p) + sum; });
}

template <int Dim>
Eigen::MatrixXd Binding<Dim>::jacobians(const PointList<Dim>& control_points) const {
  return point_jacobians().at(control_points);
}

template <int Dim>
PointJacobians<Dim> Binding<Dim>::point_jacobians() const {
  require_domain(domain);
  return {cage, domain, domain_weights,
          place_points(cage, domain, rest(), without_failure(policy))};
}

template <int Dim>
Binding<Dim> Binding<Dim>::reduced(const SparsifyOptions& limits,
                                   const std::vector<PointList<Dim>>& poses,
                                   Reduction reduction) const {
  const Index most = limits.max_influences;
  if (!solid.empty()) {
    // The other points see the reduced regions.
    auto few = *this;
    few.weights = with_few_in_solid(*this, most);
    few.solid.clear();
    auto result = few.reduced(limits, poses, reduction);
    std::vector<bool> is_solid(points.cols(), false);
    for (const auto& region : solid) {
      for (const Index p : region) is_solid[p] = true;
    }
    result.solid = solid;
    result.weights = SparseWeights::of(cage.size(), weights.num_points(), [&](Index p) {
      return (is_solid[p] ? few : result).weights.at(p);
    });
    return result;
  }
  // \param part  a binding or a ModelPart
  const auto reduce = [&](const auto& part, Index at_most) {
    auto few = limits;
    few.max_influences = at_most;
    few.masks = part.masks;
    const auto& start = few.start;
    if (start.num_points() != part.weights.num_points() ||
        start.num_control_points() != cage.size()) {
      few.start = {};
    }
    return reduce_influences<Dim>(cage.points, part.points, part.edges, part.weights, poses, few,
                                  reduction);
  };
  const bool extends = policy == OutsidePoints::kExtend && !outside.empty();
  std::vector<Index> number;
  SparseWeights few;
  if (!mirror && !extends) {
    few = reduce(*this, most);
  } else {
    ModelPart<Dim> part{points, edges, weights, masks};
    auto of_part = mirror;
    if (extends) {
      std::vector<Index> inside;
      for (Index p = 0; p < weights.num_points(); ++p) {
        if (!std::binary_search(outside.begin(), outside.end(), p)) inside.push_back(p);
      }
      if (inside.empty()) return *this;
      part = part.taken(inside, number);
      if (mirror) of_part->partners.clear();
      for (std::size_t k = 0; mirror && k < inside.size(); ++k) {
        const Index partner = mirror->partners[inside[k]];  // inside as well
        of_part->partners.push_back(partner < 0 ? -1 : number[partner]);
      }
    }
    few = of_part ? MirroredModel<Dim>(cage, *of_part, part.points).reduced(part, most, reduce)
                  : reduce(part, most);
  }
  auto result = *this;
  result.weights = !extends ? std::move(few)
                            : SparseWeights::of(cage.size(), weights.num_points(), [&](Index p) {
                                return number[p] < 0 ? weights.at(p) : few.at(number[p]);
                              });
  return result;
}

template <int Dim>
Binding<Dim> Binding<Dim>::transferred(const PointList<Dim>& to, EdgeList to_edges,
                                       OutsidePoints outside_policy) const {
  require_domain(domain);
  validate(to_edges, to.cols());
  BindOptions options;
  options.outside = outside_policy;
  options.coordinates = value_named<Coordinates>(report.method);
  const ModelElements<Dim> from{rest(), elements_of(edges, weights.num_points())};
  options.masks = masks_near<Dim>(masks, cage.size(), from, to);
  options.solid = solid_near<Dim>(solid, from, to);
  if (mirror) options.mirror_axis = mirror->axis;
  Rig<Dim> rig(cage, MadeDomain<Dim>{domain}, to, std::move(to_edges), options);
  rig.set_solution({domain_weights, report.solve});
  auto result = rig.binding();
  result.report.options = report.options;
  return result;
}

template <int Dim>
Binding<Dim> Binding<Dim>::transferred(const FacetList<3>& corners, const PointList<Dim>& to,
                                       EdgeList to_edges, double limit,
                                       Eigen::VectorXd* distances) const {
  validate(to_edges, to.cols());
  require_no_joint(held, "transferred");
  const ModelElements<Dim> from{rest(), corners};
  const auto is_masked = masks_near<Dim>(masks, cage.size(), from, to);
  const auto placed = [&](const PointList<Dim>& places) {
    if (cage.facets.cols() > 0) return place_points(cage, places, without_failure(policy));
    Placement<Dim> all;
    all.points = places;
    all.places.resize(places.cols());
    return all;
  };
  // Points inside follow the model; those outside their policy.
  const auto transfer = [&](const PointList<Dim>& places, const Placement<Dim>& placement,
                            const PointMasks& masked, Eigen::VectorXd* found) {
    auto nearest = nearest_weights(from, weights, places, limit, found);
    std::vector<bool> is_inside(placement.places.size(), true);
    for (const auto* list : {&placement.on_cage, &placement.outside}) {
      for (const auto& point : *list) is_inside[point.point] = false;
    }
    std::vector<Index> inside;
    for (std::size_t p = 0; p < is_inside.size(); ++p) {
      if (is_inside[p]) inside.push_back(static_cast<Index>(p));
    }
    if (inside.empty()) return weights_at(cage, nearest, placement);
    nearest = project_non_negative(cage.points, placement.points, nearest, inside, masked);
    return cage.facets.cols() > 0 ? weights_at(cage, nearest, placement) : nearest;
  };
  const auto placement = placed(to);
  const PointMasks masked(is_masked, cage.size(), static_cast<Index>(to.cols()));
  auto result =
      bound_by<Dim>(cage, to, transfer(to, placement, masked, distances), std::move(to_edges));
  result.masks = is_masked;
  result.policy = placement.outside.empty() ? policy : placement.policy;
  result.outside.clear();
  for (const auto& point : placement.outside) result.outside.push_back(point.point);
  result.report = report;
  result.domain = domain;
  result.domain_weights = domain_weights;
  if (mirror) {
    mirror_again<Dim>(result, mirror->axis, [&](const PointList<Dim>& images) {
      return transfer(images, placed(images), {}, nullptr);
    });
  }
  result.solid = solid_near<Dim>(solid, from, to);
  if (!result.solid.empty()) require_solid(result);
  make_solid(result);
  return result;
}

template <int Dim>
Binding<Dim> Binding<Dim>::composed(const SparseWeights& map, Cage<Dim> outer) const {
  if (mirror) {
    throw InputError(
        "a mirrored binding cannot be composed, because the map may not be symmetric; "
        "bind the model without the mirror");
  }
  require_no_joint(held, "composed");
  check_size(map, outer.size(), cage.size());
  const auto lengths = displacements<Dim>(cage.points, flbc::deform<Dim>(map, outer.points));
  Eigen::Index worst = 0;
  if (lengths.maxCoeff(&worst) > kBoundaryTolerance * bounding_box_diagonal(cage.points)) {
    throw InputError("the map does not put control point " + std::to_string(worst) +
                     " where it rests; compose needs the outer control points at rest");
  }
  const PointMasks inner(masks, cage.size(), weights.num_points());
  auto result = *this;
  result.weights = compose(weights, map);
  const Index m = map.num_control_points();
  std::vector<std::vector<Index>> followers(m);
  for (Index i = 0; i < map.num_points(); ++i) {
    map.visit(i, [&](Index j, double share) {
      if (share > 0) followers[j].push_back(i);
    });
  }
  result.masks = masks_where(m, weights.num_points(), [&](Index p, Index j) {
    return inner.at(p) && !followers[j].empty() &&
           std::all_of(followers[j].begin(), followers[j].end(),
                       [&](Index i) { return inner.forbids(p, i); });
  });
  result.cage = std::move(outer);
  result.domain = {};
  result.domain_weights = {};
  return result;
}

template <int Dim>
void Binding<Dim>::require_points(const PointList<Dim>& given) const {
  if (given.cols() != points.cols()) {
    throw InputError("the model has " + std::to_string(given.cols()) +
                     " vertices, but the binding is of " + std::to_string(points.cols()) +
                     "; bind this model, or transfer the binding to it (flbc transfer)");
  }
  if (given.cols() == 0) return;
  Eigen::Index worst = 0;
  const double distance = displacements<Dim>(rest(), given).maxCoeff(&worst);
  if (distance <= kBoundaryTolerance * bounding_box_diagonal(cage.points)) return;
  throw InputError("vertex " + std::to_string(worst) + " is at " + format_point(given.col(worst)) +
                   ", but the binding has it at " + format_point(rest().col(worst)) +
                   "; give the model at rest, or transfer the binding to this one (flbc transfer)");
}

template <int Dim>
void validate(const Binding<Dim>& binding) {
  const auto& [cage, weights, points, offsets, edges, masks, solid, mirror, policy, outside, domain,
               domain_weights, report, held] = binding;
  const Index n = cage.size(), count = weights.num_points();
  check_size(weights, n, points.cols());
  check_finite<Dim>(cage.points);
  check_finite<Dim>(points);
  check_finite<Dim>(offsets);
  if (cage.facets.cols() > 0) check_indices(cage.facets, n, kCageNames);
  if (offsets.cols() != 0 && offsets.cols() != count) {
    throw InputError("there are offsets of " + std::to_string(offsets.cols()) + " points, but " +
                     std::to_string(count) + " points");
  }
  validate(edges, count);
  PointMasks(masks, n, count);
  auto named = outside;
  for (const auto& region : solid) {
    if (region.empty()) throw InputError("a solid region has no points");
    named.insert(named.end(), region.begin(), region.end());
  }
  for (const Index p : named) {
    if (p < 0 || p >= count) throw InputError("there is no point " + std::to_string(p));
  }
  for (const Index i : held) {
    if (i < 0 || i >= n) throw InputError("there is no control point " + std::to_string(i));
  }
  if (mirror) MirroredModel<Dim>(cage, *mirror, points);
  if (domain.num_cells() == 0) return;
  check_elements(domain.points, domain.cells, kMeshNames);
  check_size(domain_weights, n, domain.num_vertices());
}

template <int Dim>
Binding<Dim> bound_by(Cage<Dim> cage, const PointList<Dim>& points, SparseWeights weights,
                      EdgeList edges, const std::vector<Mask>& masks) {
  check_size(weights, cage.size(), points.cols());
  check_finite<Dim>(points);
  validate(edges, points.cols());
  Binding<Dim> binding;
  const auto reproduced = flbc::deform<Dim>(weights, cage.points);
  const double tolerance = kBoundaryTolerance * bounding_box_diagonal(cage.points);
  binding.points = points;
  PointList<Dim> offsets = PointList<Dim>::Zero(Dim, points.cols());
  for (Index p = 0; p < weights.num_points(); ++p) {
    if (!weights.has_weights(p)) {
      offsets.col(p) = points.col(p);
    } else if ((points.col(p) - reproduced.col(p)).norm() > tolerance) {
      offsets.col(p) = points.col(p) - reproduced.col(p);
      binding.points.col(p) = reproduced.col(p);
    } else {
      continue;
    }
    binding.outside.push_back(p);
  }
  if (!binding.outside.empty()) {
    binding.offsets = std::move(offsets);
    binding.policy = OutsidePoints::kNearest;
  }
  binding.masks = cage.facets.cols() > 0 ? end_at_facets(cage, binding.points, masks) : masks;
  const PointMasks masked(binding.masks, cage.size(), weights.num_points());
  for (const Index p : masked.points()) {
    weights.visit(p, [&](Index i, double weight) {
      if (weight == 0 || !masked.forbids(p, i)) return;
      throw InputError("the weight of control point " + std::to_string(i) + " at vertex " +
                       std::to_string(p) + " is " + format_number(weight) +
                       ", although it is masked; solve with this locality file");
    });
  }
  binding.cage = std::move(cage);
  binding.weights = std::move(weights);
  binding.edges = std::move(edges);
  return binding;
}

#define FLBC_INSTANTIATE(Dim)                                                               \
  template struct Binding<Dim>;                                                             \
  template void validate(const Binding<Dim>&);                                              \
  template Binding<Dim> bound_by(Cage<Dim>, const PointList<Dim>&, SparseWeights, EdgeList, \
                                 const std::vector<Mask>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
