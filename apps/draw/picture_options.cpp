// SPDX-License-Identifier: BSD-3-Clause
#include "draw/picture_options.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "flbc/errors.h"

namespace flbc::draw {

PictureFormat picture_format(const std::string& path) {
  auto extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".png") return PictureFormat::kPng;
  if (extension == ".svg") return PictureFormat::kSvg;
  if (extension == ".pdf") return PictureFormat::kPdf;
  throw OptionError(path + ": a picture is written as one of " + kPictureExtensions + ", not as '" +
                    extension + "'");
}

void validate(const WeightPictureOptions& options) {
  if (options.width < 200 || options.width > 6000) {
    throw OptionError("width must be 200 to 6000 pixels, not " + std::to_string(options.width));
  }
  if (options.isolines < 0 || options.isolines > 100) {
    throw OptionError("isolines must be 0 to 100, not " + std::to_string(options.isolines));
  }
  if (!(options.support_level >= 0 && options.support_level < 1)) {
    throw OptionError("support_level must be at least 0 and below 1, not " +
                      std::to_string(options.support_level));
  }
}

}  // namespace flbc::draw
