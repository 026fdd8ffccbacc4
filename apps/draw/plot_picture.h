// SPDX-License-Identifier: BSD-3-Clause
// Curves in panels, as the bytes of a file.
#pragma once

#include <string>
#include <vector>

#include "draw/picture_options.h"
#include "flbc/types.h"

namespace flbc::draw {

//! One quantity against another, a curve per run.
struct PlotPanel {
  std::string x_label{};
  std::string y_label{};
  bool logarithmic = false;                      //!< upwards; values <= 0 are then left out
  std::vector<std::vector<Vector<2>>> curves{};  //!< of all runs, empty where one has none
};

//! Draws panels in rows of `columns`, below a legend with the names of the runs.
//! \param names  of the runs, which have the same color in all panels
//! \param panels  each with as many curves as there are names
//! \throws InputError if there is nothing to draw or numbers of curves differ; OptionError as
//! validate()
std::string draw_plot(const std::vector<std::string>& names, const std::vector<PlotPanel>& panels,
                      int columns, const WeightPictureOptions& options = {});

}  // namespace flbc::draw
