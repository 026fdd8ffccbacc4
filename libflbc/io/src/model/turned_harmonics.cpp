// SPDX-License-Identifier: BSD-3-Clause
#include "model/turned_harmonics.h"

#include <cmath>

#include <Eigen/LU>

namespace flbc::io {

// Directions that are evenly spread over half a sphere: opposite ones would give the same values,
// up to the sign.
template <int Degree>
TurnedHarmonics<Degree>::TurnedHarmonics() {
  constexpr double kGoldenAngle = 2.399963229728653;
  Eigen::Matrix<double, kSize, kSize> values;
  for (int k = 0; k < kSize; ++k) {
    const double z = (k + 0.5) / kSize;
    const double radius = std::sqrt(1 - z * z);
    const double angle = k * kGoldenAngle;
    directions_.col(k) << radius * std::cos(angle), radius * std::sin(angle), z;
    values.row(k) = harmonics<Degree>(directions_.col(k)).transpose();
  }
  from_values_ = values.inverse();
}

template class TurnedHarmonics<1>;
template class TurnedHarmonics<2>;
template class TurnedHarmonics<3>;

}  // namespace flbc::io
