// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Labels without font files.
#pragma once

#include <string_view>
#include <vector>

#include "draw/canvas.h"

namespace flbc::draw {

//! Knows letters, digits and the usual punctuation of ASCII; other characters leave a gap.
//! \param height  of a digit, in pixels
//! \return the width of the text in pixels
double text_width(std::string_view text, double height);

//! A character drawn with strokes, in units of the height of a digit, y upwards from the baseline.
struct StrokedGlyph {
  std::vector<std::vector<Vector<2>>> strokes{};  //!< polylines; a dot is a single point
  double advance = 0;                             //!< to the next character
};

//! One without strokes for characters that are not known.
StrokedGlyph stroked_glyph(char character);

//! The width of strokes, in units of the height of a digit.
double stroke_width();

//! Writes text with strokes; on a canvas of layers as text.
//! \param position  left end of the baseline
//! \param height  of a digit, in pixels
void draw_text(Canvas& canvas, const Vector<2>& position, std::string_view text, double height,
               Color color);

}  // namespace flbc::draw
