// SPDX-License-Identifier: BSD-3-Clause
#include "draw/picture_options.h"

#include "flbc/errors.h"
#include "flbc/io/files.h"

namespace flbc::draw {

PictureFormat picture_format(const std::string& path) {
  const auto extension = io::extension_of(path);
  if (extension == "png") return PictureFormat::kPng;
  if (extension == "svg") return PictureFormat::kSvg;
  if (extension == "pdf") return PictureFormat::kPdf;
  throw OptionError(path + ": a picture is written as one of " + kPictureExtensions +
                    ", not as '." + extension + "'");
}

void validate(const WeightPictureOptions& options) {
  if (options.width < 200 || options.width > 6000) {
    throw OptionError("width must be 200 to 6000 pixels, not " + std::to_string(options.width));
  }
}

}  // namespace flbc::draw
