// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The cages of the paper (and two more) and what the paper reports about them.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc::bench {

//! Results of the paper's table 2 and, last, table 1; 0 = not there.
struct PaperNumbers {
  double lbc_error = 0;
  double lbc_seconds = 0;
  double flbc_error = 0;
  double flbc_seconds = 0;
  double squared_distance = 0;  //!< of the optima with and without non-negativity
};

struct Model {
  const char* name;
  int dim;
  const char* cage;     //!< file under the models folder
  Index small_size;     //!< vertices for conjecture 1 and figure 1
  Index paper_size;     //!< vertices for tables 1 and 2
  Index control_point;  //!< the one whose coordinate function is drawn
  PaperNumbers paper{};
};

//! In the order of the paper's table 2. Gecko is missing: its cage was not published.
const std::vector<Model>& models();

//! \throws std::out_of_range
const Model& model(const char* name);

}  // namespace flbc::bench
