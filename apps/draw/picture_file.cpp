// SPDX-License-Identifier: BSD-3-Clause
#include "draw/picture_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "draw/pdf_writer.h"
#include "draw/png_writer.h"
#include "draw/svg_writer.h"
#include "flbc/errors.h"

namespace flbc::draw {

PictureFormat picture_format(const std::string& path) {
  auto extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".png") return PictureFormat::kPng;
  if (extension == ".svg") return PictureFormat::kSvg;
  if (extension == ".pdf") return PictureFormat::kPdf;
  throw OptionError(path + ": a picture is written as one of " + kPictureExtensions +
                    ", not as '" + extension + "'");
}

bool has_layers(PictureFormat format) {
  return format != PictureFormat::kPng;
}

std::string encode_picture(const Image& image, PictureFormat format) {
  if (!has_layers(format)) return encode_png(image);
  if (image.layers.empty()) throw IoError("cannot write an empty picture");
  return format == PictureFormat::kSvg ? encode_svg(image) : encode_pdf(image);
}

}  // namespace flbc::draw
