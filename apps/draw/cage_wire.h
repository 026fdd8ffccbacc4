// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The cage round the slices: a pale shell and thin edges.
#pragma once

#include <vector>

#include "draw/scene.h"

namespace flbc::draw {

//! The cage's edges between two neighbouring slices or beyond the last one, on the canvas.
struct WireSlab {
  std::vector<Segment> front;  //!< edges at facets that face the eye
  std::vector<Segment> flat;   //!< those of them between facets in one plane
  std::vector<Segment> back;   //!< edges at the far side
};

//! Cuts the edges at the slices. Slab k lies before slice k, the last one behind all slices, in the
//! direction of the slices' normal.
std::vector<WireSlab> cut_wire(const Scene& scene);

//! Paints the edges of one slab.
void paint_wire(Canvas& canvas, const WireSlab& slab, double unit);

//! Paints the inside of the cage's far side, as a pale background that lets its shape be guessed.
void paint_shell(Canvas& canvas, const Scene& scene);

}  // namespace flbc::draw
