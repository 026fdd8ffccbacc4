// SPDX-License-Identifier: BSD-3-Clause
#include "front/model_facets.h"

#include <png.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "flbc/errors.h"
#include "flbc/io/files.h"

namespace flbc::app {
namespace {

// libpng's reader, which holds memory until it is freed.
struct Reader {
  png_image image{};
  Reader() { image.version = PNG_IMAGE_VERSION; }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_image_free(&image); }
};

// A PNG without the chunks that say nothing about which pixels are to be seen: libpng takes the
// memory that a text or a profile of colours says it needs, were it gigabytes.
std::string without_remarks(const std::string& path, const std::string& png) {
  constexpr std::size_t kSignature = 8, kChunkHead = 8, kCheck = 4;
  const auto* bytes = reinterpret_cast<png_const_bytep>(png.data());
  if (png.size() < kSignature || png_sig_cmp(bytes, 0, kSignature) != 0) {
    throw InputError(path + ": not a PNG file");
  }
  std::string kept = png.substr(0, kSignature);
  std::size_t begin = kSignature;
  std::string type;
  while (begin < png.size() && type != "IEND") {
    const bool has_head = png.size() - begin >= kChunkHead;
    type = has_head ? png.substr(begin + 4, 4) : "";
    const std::size_t length = has_head ? png_get_uint_32(bytes + begin) : 0;
    if (!has_head || png.size() - begin - kChunkHead < length + kCheck) {
      throw InputError(path + ": the file ends within the chunk at byte " + std::to_string(begin));
    }
    const std::size_t size = kChunkHead + length + kCheck;
    const bool is_critical = (static_cast<unsigned char>(type[0]) & 32U) == 0;
    if (is_critical || type == "tRNS") kept.append(png, begin, size);
    begin += size;
  }
  return kept;
}

Mask read_mask(const std::string& path) {
  constexpr png_uint_32 kMostPixels = 16384;  // along an axis
  const std::string content = without_remarks(path, io::read_file(path));
  Reader reader;
  auto& image = reader.image;
  if (png_image_begin_read_from_memory(&image, content.data(), content.size()) == 0) {
    throw InputError(path + ": " + image.message);
  }
  if (image.width > kMostPixels || image.height > kMostPixels) {
    throw InputError(path + ": the picture has more than 16384 pixels along an axis");
  }
  // What deflate compresses, at least a bit a pixel, is at most this many times as long.
  constexpr std::size_t kMostRatio = 1032;
  const auto bytes = std::size_t(image.width) * image.height / 8;
  if (bytes / kMostRatio > content.size()) {
    throw InputError(path + ": the file is too short for a picture of " +
                     std::to_string(image.width) + " by " + std::to_string(image.height) +
                     " pixels");
  }
  image.format = PNG_FORMAT_RGBA;
  std::vector<png_byte> colours(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, colours.data(), 0, nullptr) == 0) {
    throw InputError(path + ": " + image.message);
  }
  constexpr std::size_t kChannels = 4, kAlpha = 3;
  constexpr int kHaze = 32;  // nobody sees a pixel with less than this part of the highest alpha
  png_byte lowest = 255, highest = 0;
  for (std::size_t k = kAlpha; k < colours.size(); k += kChannels) {
    lowest = std::min(lowest, colours[k]);
    highest = std::max(highest, colours[k]);
  }
  Mask mask{static_cast<Index>(image.width), static_cast<Index>(image.height), lowest};
  for (Index y = mask.height - 1; y >= 0; --y) {
    for (Index x = 0; x < mask.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y) * mask.width + x;
      const int alpha = colours[kChannels * pixel + kAlpha];
      mask.pixels.push_back(alpha > 0 && kHaze * alpha >= highest);
    }
  }
  return mask;
}

}  // namespace

ModelFacets<2> load_silhouette(const std::string& path) {
  return outline_of(read_mask(path), path);
}

}  // namespace flbc::app
