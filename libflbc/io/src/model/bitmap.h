// SPDX-License-Identifier: BSD-3-Clause
// Pictures of pixels that follow a deformation.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "flbc/binding.h"

namespace flbc::io {

//! Pixels row by row from the top. Colors are not premultiplied by alpha, the last channel.
struct Bitmap {
  Index width = 0, height = 0;
  int channels = 4;  //!< 2: gray and alpha; 4: red, green, blue, and alpha
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>> samples{};
  //! Upper left corner, in pixels of this picture from that of the picture that it was made of.
  Index left = 0, top = 0;
  //! Type and content of the chunks of a PNG file that say what the pixels mean.
  std::vector<std::pair<std::string, std::string>> chunks{};

  //! Sample of full intensity: 255 or 65535.
  int largest() const { return samples.index() == 0 ? 255 : 65535; }
  //! Alpha of a pixel, counted row by row.
  int alpha(std::size_t pixel) const {
    return std::visit([&](const auto& of) { return int{of[(pixel + 1) * channels - 1]}; }, samples);
  }
};

//! Moves pixels with the domain mesh of a binding. What moves farther is in front. Pixels outside
//! the cage stay, except for the nearest ones. All results have one canvas: that of the picture,
//! enlarged where poses move pixels beyond.
//! \param poses  2 x n each \param scale  pixels of the results per pixel, along an axis
//! \param size  of the picture in units of the model, whose origin is the lower left corner; zero: a
//! pixel is a unit
//! \param take  gets the number of each pose, and the picture in it
//! \return number of pixels that stay outside, without those of less than 1/32 of full alpha
//! \throws InputError if the binding has no domain mesh, or the canvas has more than 2^28 pixels;
//! OptionError if the scale is not positive
std::size_t warp(const Bitmap& picture, const Binding<2>& binding,
                 const std::vector<PointList<2>>& poses, double scale, const Vector<2>& size,
                 const std::function<void(std::size_t pose, Bitmap moved)>& take);

//! Puts pictures of one size into one.
//! \param names  of these cells \param file  of the sheet \param seconds  that a cell is shown
//! \param json  output: the cells by name, as Aseprite and TexturePacker write them
//! \throws InputError if the sheet has more than 2^28 pixels
Bitmap sprite_sheet(const std::vector<Bitmap>& cells, const std::vector<std::string>& names,
                    const std::string& file, double seconds, std::string& json);

}  // namespace flbc::io
