// SPDX-License-Identifier: BSD-3-Clause
// Narrow gaps of a model, such as those between fingers.
#pragma once

#include <vector>

#include "caging/enclosure.h"
#include "flbc/cage_from_model.h"

namespace flbc {

//! Slots between two parts of a model that are thicker than the slot is wide. They are open to
//! several sides, unlike the space between a leg and trousers. Creases do not count.
class Gaps {
 public:
  Gaps() = default;
  //! \param model  may have openings \param enclosure  of the model
  Gaps(const Cage<3>& model, const Enclosure<3>& enclosure);

  //! The gaps most of which is inside the cage, largest first.
  std::vector<BridgedGap<3>> bridged_by(const Cage<3>& cage) const;

 private:
  struct Sample {
    Vector<3> place;  // in the middle
    double width;
    int axis;  // of the line through it
    Eigen::Array3i cell;
    Index gap;
  };

  PointList<3> box_{};  // low and high
  std::vector<Sample> samples_{};
};

}  // namespace flbc
