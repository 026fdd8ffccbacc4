// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Arguments of flbc run.
#pragma once

#include <string>
#include <vector>

#include "report/sparsify_report.h"
#include "solve/solve_settings.h"

namespace flbc::app {

struct RunArguments {
  SolveSettings settings;             //!< cage and model among them, but no domain
  bool makes_cage = false;            //!< a cage is made round the model
  std::string picture;                //!< or round this picture's silhouette; empty for none
  Index cage_control_points = 0;      //!< at most so many; 0 = by the model's shape
  std::vector<std::string> deformed;  //!< cage files or a pattern of them
  std::string keyframes;              //!< file of poses instead
  std::string output;                 //!< folder
  Index max_influences = 8;
  std::string reduction = kPoisson;
  double frames_per_second = 0;  //!< 0 = 24, or one second for a single pose
  Index control_point = -1;      //!< whose function is drawn, -1 = the program chooses
  std::string pictures = "png";       //!< format of pictures
  bool force = false;            //!< results replace files of others, too
  bool quiet = false;
};

}  // namespace flbc::app
