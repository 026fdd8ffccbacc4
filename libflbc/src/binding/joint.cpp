// SPDX-License-Identifier: BSD-3-Clause
// A smooth end of the deformation where a mesh passes through its cage.
#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "base/instantiate.h"
#include "flbc/binding.h"
#include "flbc/border.h"
#include "flbc/deform.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// In an order of its own, so that mirrored points have equal sums.
double sum_of(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

// t s(t) and its slope are 0 at 0.
double Joint::factor(double m) const {
  const double t = std::min(1.0, m / mass);
  return is_curvature ? t * t * (6 - t * (8 - 3 * t)) : t * (2 - t);
}

Joint parse_joint(const std::string& text) {
  const auto colon = text.find(':');
  const auto name = text.substr(0, colon);
  Joint joint;
  joint.is_curvature = name == "curvature";
  char* end = nullptr;
  if (colon != std::string::npos) joint.mass = std::strtod(text.c_str() + colon + 1, &end);
  const bool is_read = colon == std::string::npos || (*end == 0 && end[-1] != ':');
  if ((name == "smooth" || name == "curvature") && is_read) return joint;
  throw OptionError("joint: \"" + text +
                    "\" is none; use smooth or curvature, or one with a mass, as in smooth:0.3");
}

template <int Dim>
Binding<Dim> Binding<Dim>::joined(const Joint& joint) const {
  if (!(joint.mass > 0 && joint.mass <= 1)) {
    throw OptionError("joint: the mass must be above 0 and at most 1");
  }
  if (!solid.empty()) {
    throw InputError(
        "joint: the binding has solid regions, which a joint would bend; bind without");
  }
  if (cage.facets.cols() == 0) {
    throw InputError("joint: the binding does not know the facets of its cage; set Binding::cage");
  }
  const auto crossings = find_crossings(cage, rest(), are_still(weights), edges);
  if (crossings.empty()) {
    throw InputError(
        "joint: no edge of the model passes through the cage to a vertex that stays; bind the "
        "model with its faces, and with the vertices outside kept (outside = keep)");
  }
  auto result = *this;
  result.held = control_points_at(cage, crossings);
  if (static_cast<Index>(result.held.size()) == cage.size()) {
    throw InputError(
        "joint: edges of the model pass through facets of all control points, so none may move; "
        "the cage needs control points farther inside");
  }
  std::vector<bool> is_held(static_cast<std::size_t>(cage.size()), false);
  for (const Index i : result.held) is_held[i] = true;
  auto values = weights.values();
  std::vector<Index> changed;
  for (Index p = 0; p < weights.num_points(); ++p) {
    std::vector<double> moving, staying;
    weights.visit(p, [&](Index i, double w) { (is_held[i] ? staying : moving).push_back(w); });
    const double mass = sum_of(moving), rest_mass = sum_of(staying);
    if (mass >= joint.mass || mass <= 0) continue;
    const double s = joint.factor(mass);
    // The held ones, which do not move, take the rest, so that the sum stays.
    const double of_held = 1 + mass * (1 - s) / rest_mass;
    for (auto k = weights.starts()[p]; k < weights.starts()[p + 1]; ++k) {
      values[k] *= is_held[weights.control_points()[k]] ? of_held : s;
    }
    changed.push_back(p);
  }
  result.weights = {weights.num_control_points(), weights.starts(), weights.control_points(),
                    std::move(values)};
  // What the changed weights do not reproduce.
  const auto reproduced = flbc::deform<Dim>(result.weights, cage.points);
  const auto all = rest();
  if (offsets.cols() == 0) result.offsets = PointList<Dim>::Zero(Dim, points.cols());
  for (const Index p : changed) {
    result.points.col(p) = reproduced.col(p);
    result.offsets.col(p) = all.col(p) - reproduced.col(p);
  }
  result.domain = {};
  result.domain_weights = {};
  return result;
}

#define FLBC_INSTANTIATE(Dim) template Binding<Dim> Binding<Dim>::joined(const Joint&) const;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
