// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The exception for masks that cannot be obeyed, with what to change.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "flbc/errors.h"
#include "flbc/types.h"

namespace flbc {

//! Masked points that no weights >= 0 of the control points that may move them reproduce.
class MaskConflict : public InputError {
 public:
  MaskConflict(const std::string& message, std::vector<Index> masked, std::vector<Index> cure)
      : InputError(message), points(std::move(masked)), control_points(std::move(cure)) {}

  std::vector<Index> points;          //!< ascending
  std::vector<Index> control_points;  //!< ascending; without their masks, all points can obey
};

}  // namespace flbc
