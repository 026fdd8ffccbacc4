// SPDX-License-Identifier: BSD-3-Clause
#include "draw/png_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <png.h>

#include "flbc/errors.h"

namespace flbc::draw {
namespace {

std::uint8_t to_byte(float component) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(component, 0.0F, 1.0F)));
}

std::vector<std::uint8_t> to_bytes(const Image& image) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * image.pixels.size());
  for (const Color& pixel : image.pixels) {
    bytes.insert(bytes.end(), {to_byte(pixel.r), to_byte(pixel.g), to_byte(pixel.b)});
  }
  return bytes;
}

std::string encode(int width, int height, png_uint_32 format,
                   const std::vector<std::uint8_t>& bytes) {
  // The simplified interface of libpng reports errors by value, so that no longjmp crosses C++.
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width);
  header.height = static_cast<png_uint_32>(height);
  header.format = format;

  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string encoded(size, '\0');
  const int done = png_image_write_to_memory(&header, encoded.data(), &size, /*convert_to_8bit=*/0,
                                             bytes.data(), /*row_stride=*/0, /*colormap=*/nullptr);
  if (done == 0) throw IoError(std::string("cannot encode the picture as PNG: ") + header.message);
  encoded.resize(size);
  return encoded;
}

}  // namespace

std::string encode_png(const Image& image) {
  if (image.pixels.empty()) throw IoError("cannot write an empty picture as PNG");
  return encode(image.width, image.height, PNG_FORMAT_RGB, to_bytes(image));
}

std::string encode_png(const FilledLayer& layer) {
  return encode(layer.width, layer.height, PNG_FORMAT_RGBA, layer.channels);
}

}  // namespace flbc::draw
