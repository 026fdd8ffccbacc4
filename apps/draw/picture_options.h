// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options of a picture.
#pragma once

namespace flbc::draw {

struct WeightPictureOptions {
  int width = 1200;             //!< of the picture in pixels, 200 .. 6000; all sizes follow it
  int isolines = 10;            //!< lines at k / isolines between 0 and 1; 0 = none, up to 100
  double support_level = 1e-3;  //!< a thin grey line shows where the weight falls below; 0 = none
  bool mesh_edges = false;      //!< show the edges of the domain mesh (in 3D: of the slices)
  bool slice_panels = true;     //!< 3D: show each slice also from straight before it
  bool color_bar = true;        //!< explain the colours at the right side
  bool layers = false;          //!< lines stay lines and text stays text, for vector formats
};

//! \throws OptionError naming the first option outside its range
void validate(const WeightPictureOptions& options);

}  // namespace flbc::draw
