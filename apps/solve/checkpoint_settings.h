// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Where the state of a solve is kept.
#pragma once

#include <string>

namespace flbc::app {

struct CheckpointSettings {
  std::string file{};    //!< empty for none
  double interval = 60;  //!< seconds between two writes; 0 = at every opportunity
};

}  // namespace flbc::app
