// SPDX-License-Identifier: BSD-3-Clause
// From measures of weights to what is wrong with them.
#include <string>

#include "base/messages.h"
#include "flbc/check.h"

namespace flbc {
namespace {

template <int Dim>
std::string point_of(const Extreme<Dim>& extreme) {
  return "point " + std::to_string(extreme.point) + " at " + format_point(extreme.place);
}

std::string weight_for(Index control_point) {
  return "the weight for control point " + std::to_string(control_point);
}

// Written so that an error that is no number is a violation, too.
template <int Dim>
bool is_violated(const Extreme<Dim>& error) {
  return error.point >= 0 && !(error.value <= kCheckTolerance);
}

}  // namespace

template <int Dim>
std::vector<std::string> find_violations(const WeightCheck<Dim>& check) {
  std::vector<std::string> violations;
  if (check.non_finite > 0) {
    const auto& first = check.first_non_finite;
    violations.push_back(std::to_string(check.non_finite) +
                         " weights are not finite, the first is " +
                         weight_for(first.control_point) + " at " + point_of(first));
  }
  if (is_violated(check.partition)) {
    violations.push_back("the weights of " + point_of(check.partition) +
                         " do not sum to 1, but differ from it by " +
                         format_number(check.partition.value));
  }
  if (is_violated(check.reproduction)) {
    violations.push_back("the weights of " + point_of(check.reproduction) +
                         " do not reproduce it: sum w c is off by " +
                         format_number(check.reproduction.value) + " of the cage's size");
  }
  if (is_violated(check.lagrange)) {
    violations.push_back("at " + point_of(check.lagrange) + ", where a control point is, " +
                         weight_for(check.lagrange.control_point) + " is off by " +
                         format_number(check.lagrange.value) +
                         " from the 1 or 0 that it must be there");
  }
  if (is_violated(check.linearity)) {
    violations.push_back("at " + point_of(check.linearity) + ", which is on the cage, " +
                         weight_for(check.linearity.control_point) + " is off by " +
                         format_number(check.linearity.value) +
                         " from linear interpolation in the facet");
  }
  return violations;
}

template std::vector<std::string> find_violations(const WeightCheck<2>&);
template std::vector<std::string> find_violations(const WeightCheck<3>&);

}  // namespace flbc
