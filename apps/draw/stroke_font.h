// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Labels without font files.
#pragma once

#include <string_view>

#include "draw/canvas.h"

namespace flbc::draw {

//! Knows the digits, "d", "e", "w" and "." "-" "<" ">"; other characters leave a gap.
//! \param height  of a digit, in pixels
//! \return the width of the text in pixels
double text_width(std::string_view text, double height);

//! Writes text with strokes.
//! \param position  left end of the baseline
//! \param height  of a digit, in pixels
void draw_text(Canvas& canvas, const Vector<2>& position, std::string_view text, double height,
               Color color);

}  // namespace flbc::draw
