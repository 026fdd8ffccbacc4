// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Settings shared by all experiments.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "flbc/types.h"

namespace flbc::bench {

struct Context {
  std::string models;  //!< folder of the cages, with 2d/ and 3d/
  std::string out;     //!< folder of all results
  bool quick = false;  //!< small meshes and few iterations, to see that everything works
  int threads = 1;
  bool busy = false;     //!< other programs run on the machine, which the results have to say
  std::string commit{};  //!< of the sources, for the results to name; may be empty
  std::vector<std::string> only_models{};  //!< names of those to measure; empty for all

  //! Whether a model is to be measured.
  bool wants(const std::string& model) const {
    return only_models.empty() ||
           std::find(only_models.begin(), only_models.end(), model) != only_models.end();
  }

  //! Number of vertices for a mesh that has `full` in a full run.
  Index size(int dim, Index full) const {
    const Index quick_size = dim == 2 ? 1500 : 2000;
    return quick && full > quick_size ? quick_size : full;
  }
};

}  // namespace flbc::bench
