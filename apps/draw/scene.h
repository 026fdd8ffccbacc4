// SPDX-License-Identifier: BSD-3-Clause
// A cage with slices, as the camera sees it.
#pragma once

#include <functional>
#include <vector>

#include "draw/canvas.h"
#include "draw/layout.h"
#include "draw/picture_options.h"
#include "draw/slice.h"
#include "draw/view.h"

namespace flbc::draw {

//! View, colors and labels shared by all steps of painting in space.
struct Scene {
  const Cage<3>& cage;
  const std::vector<Slice>& slices;  //!< at least one, parallel, ascending along their normal
  ObliqueView view;
  PixelMap map;
  double unit;  //!< the pixels of a line that is 1 pixel wide in a picture of the usual size
  WeightPictureOptions options;
  const Cage<3>* model = nullptr;  //!< a surface shown as a pale shape

  Vector<2> pixel(const Vector<3>& p) const { return map(view.project(p)); }
};

//! Paints the cage and the slices, from the farthest to the nearest.
//! \returns the model, which hides what is behind it; empty without one
Raster paint_scene(Canvas& canvas, const Scene& scene);

//! Paints one slice with its outline.
//! \param pixel  from plane coordinates to the canvas; must be affine
void paint_slice(Canvas& canvas, const Slice& slice,
                 const std::function<Vector<2>(const Vector<2>&)>& pixel, double unit,
                 const WeightPictureOptions& options);

}  // namespace flbc::draw
