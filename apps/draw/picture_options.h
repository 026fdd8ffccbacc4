// SPDX-License-Identifier: BSD-3-Clause
// Options and formats of pictures.
#pragma once

#include <string>

namespace flbc::draw {

enum class PictureFormat { kPng, kSvg, kPdf };

//! For help and messages.
constexpr const char* kPictureExtensions = ".png, .svg, .pdf";

//! By the extension, in upper or lower case.
//! \throws OptionError naming the file and all extensions if it has another one
PictureFormat picture_format(const std::string& path);

struct WeightPictureOptions {
  int width = 1200;             //!< of the picture in pixels, 200 .. 6000; all sizes follow it
  int isolines = 10;            //!< lines at k / isolines between 0 and 1; 0 = none
  double support_level = 1e-4;  //!< a gray line shows where the weight falls below; 0 = none
  bool color_bar = true;        //!< explain the colors at the right side
  PictureFormat format = PictureFormat::kPng;
};

//! \throws OptionError naming the first option outside its range
void validate(const WeightPictureOptions& options);

//! The size of what is 1 pixel wide in a picture of the usual width.
inline double pixel_unit(const WeightPictureOptions& options) {
  return options.width / 1200.0;
}

}  // namespace flbc::draw
