// SPDX-License-Identifier: BSD-3-Clause
#include "front/picture_file.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#ifdef FLBC_LINKS_JPEG
#include <jpeglib.h>
#include <zlib.h>
#endif

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "front/facts.h"
#include "front/model_facets.h"

namespace flbc::app {
namespace {

using io::Bitmap;
using Bytes = std::vector<unsigned char>;

void require_size(const std::string& path, std::size_t width, std::size_t height) {
  constexpr std::size_t kMostPixels = 16384;  // along an axis
  if (width > kMostPixels || height > kMostPixels) {
    throw InputError(path + ": the picture has more than 16384 pixels along an axis");
  }
}

// A PNG without the chunks that say nothing about which pixels are to be seen: libpng takes the
// memory that a text or a profile of colors says it needs, were it gigabytes.
// \param colors  output: chunks about colors and the size of pixels
std::string without_remarks(const std::string& path, const std::string& png,
                            decltype(Bitmap::chunks)& colors) {
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
    for (const char* color : {"cHRM", "gAMA", "iCCP", "sRGB", "cICP", "pHYs"}) {
      if (type == color) colors.emplace_back(type, png.substr(begin + kChunkHead, length));
    }
    begin += size;
  }
  return kept;
}

// PNG files are big-endian.
constexpr bool kIsLittleEndian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

// Why libpng or libjpeg cannot go on.
struct Failure {
  std::jmp_buf jump;
  std::string message{};

  [[noreturn]] void end(const char* reason) {
    message = reason;
    std::longjmp(jump, 1);
  }
};

// Calls an action that a failure leaves by a jump; so it holds no objects.
template <class Action>
void trying(const std::string& path, Failure& failure, const Action& action) {
  if (setjmp(failure.jump) != 0) throw InputError(path + ": " + failure.message);
  action();
}

// libpng's reader or writer, which holds memory until it is freed.
struct Png {
  png_structp it;
  png_infop info;
  bool reads;

  Png(Failure& failure, bool reading)
      : it((reading ? png_create_read_struct : png_create_write_struct)(
            PNG_LIBPNG_VER_STRING, &failure,
            [](png_structp png, png_const_charp reason) {
              static_cast<Failure*>(png_get_error_ptr(png))->end(reason);
            },
            [](png_structp, png_const_charp) {})),
        info(png_create_info_struct(it)),
        reads(reading) {}
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
  ~Png() {
    if (reads) {
      png_destroy_read_struct(&it, &info, nullptr);
    } else {
      png_destroy_write_struct(&it, &info);
    }
  }
};

Bitmap decode_png(const std::string& path, const std::string& content) {
  Bitmap picture;
  const auto kept = without_remarks(path, content, picture.chunks);
  std::string_view unread = kept;
  Failure failure;
  const Png png(failure, true);
  png_set_read_fn(png.it, &unread, [](png_structp it, png_bytep bytes, png_size_t count) {
    auto& rest = *static_cast<std::string_view*>(png_get_io_ptr(it));
    if (rest.size() < count) png_error(it, "the file ends too early");
    rest.copy(reinterpret_cast<char*>(bytes), count);
    rest.remove_prefix(count);
  });
  trying(path, failure, [&] { png_read_info(png.it, png.info); });
  picture.width = static_cast<Index>(png_get_image_width(png.it, png.info));
  picture.height = static_cast<Index>(png_get_image_height(png.it, png.info));
  require_size(path, picture.width, picture.height);
  // What deflate compresses, at least a bit a pixel, is at most this many times as long.
  constexpr std::size_t kMostRatio = 1032;
  if (std::size_t(picture.width) * picture.height / 8 / kMostRatio > content.size()) {
    throw InputError(path + ": the file is too short for a picture of " +
                     std::to_string(picture.width) + " by " + std::to_string(picture.height) +
                     " pixels");
  }
  trying(path, failure, [&] {
    png_set_expand(png.it);
    png_set_add_alpha(png.it, 0xffff, PNG_FILLER_AFTER);
    if (kIsLittleEndian) png_set_swap(png.it);
    png_set_interlace_handling(png.it);
    png_read_update_info(png.it, png.info);
  });
  picture.channels = png_get_channels(png.it, png.info);
  if (png_get_bit_depth(png.it, png.info) == 16) picture.samples = std::vector<std::uint16_t>();
  const auto read = [&](auto& samples) {
    const auto length = std::size_t(picture.width) * picture.channels;
    samples.resize(length * picture.height);
    std::vector<png_bytep> rows;
    for (Index y = 0; y < picture.height; ++y) {
      rows.push_back(reinterpret_cast<png_bytep>(&samples[length * y]));
    }
    trying(path, failure, [&] { png_read_image(png.it, rows.data()); });
  };
  std::visit(read, picture.samples);
  return picture;
}

#ifdef FLBC_LINKS_JPEG
// As in EXIF, 1 to 8: how a picture is to be turned. It is a short number of either byte order.
int orientation_of(const std::string& exif) {
  const std::string little("\x12\x01\x03\0\x01\0\0\0", 8), big("\x01\x12\0\x03\0\0\0\x01", 8);
  auto at = exif.find(little);
  if (at == std::string::npos) at = exif.find(big) + 1;
  return at == 0 || at + 8 >= exif.size() ? 1 : exif[at + 8];
}

Bitmap turned(const Bitmap& picture, int orientation) {
  const int k = orientation - 1;
  if (k < 1 || k > 7) return picture;
  const bool is_transposed = k > 3, flips_columns = k == 1 || k == 2 || k > 5;
  const bool flips_rows = k == 2 || k == 3 || k == 5 || k == 6;
  Bitmap result = picture;
  if (is_transposed) std::swap(result.width, result.height);
  const auto& samples = std::get<Bytes>(picture.samples);
  auto sample = std::get<Bytes>(result.samples).begin();
  for (Index y = 0; y < result.height; ++y) {
    for (Index x = 0; x < result.width; ++x) {
      auto [column, row] = is_transposed ? std::pair(y, x) : std::pair(x, y);
      if (flips_columns) column = picture.width - 1 - column;
      if (flips_rows) row = picture.height - 1 - row;
      const auto from = (std::ptrdiff_t(row) * picture.width + column) * picture.channels;
      sample = std::copy_n(samples.begin() + from, picture.channels, sample);
    }
  }
  return result;
}

Bitmap decode_jpeg(const std::string& path, const std::string& content) {
  Failure failure;
  jpeg_error_mgr errors{};
  struct Jpeg : jpeg_decompress_struct {
    Jpeg() : jpeg_decompress_struct{} {}
    ~Jpeg() { jpeg_destroy_decompress(this); }
  } jpeg;
  jpeg.client_data = &failure;
  jpeg.err = jpeg_std_error(&errors);
  errors.output_message = [](j_common_ptr) {};
  errors.error_exit = [](j_common_ptr it) {
    char message[JMSG_LENGTH_MAX];
    it->err->format_message(it, message);
    static_cast<Failure*>(it->client_data)->end(message);
  };
  trying(path, failure, [&] {
    jpeg_create_decompress(&jpeg);
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(content.data()), content.size());
    for (const int exif_or_profile : {1, 2}) {
      jpeg_save_markers(&jpeg, JPEG_APP0 + exif_or_profile, 0xffff);
    }
    jpeg_read_header(&jpeg, TRUE);
  });
  require_size(path, jpeg.image_width, jpeg.image_height);
  jpeg.out_color_space = jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  trying(path, failure, [&] { jpeg_start_decompress(&jpeg); });
  const int colors = jpeg.output_components;
  Bitmap picture{Index(jpeg.output_width), Index(jpeg.output_height), colors + 1};
  auto& samples = std::get<Bytes>(picture.samples);
  samples.resize(std::size_t(picture.width) * picture.height * picture.channels, 255);
  Bytes row(std::size_t(picture.width) * colors);
  auto* to = row.data();
  for (auto sample = samples.begin(); jpeg.output_scanline < jpeg.output_height;) {
    trying(path, failure, [&] { jpeg_read_scanlines(&jpeg, &to, 1); });
    for (auto from = row.begin(); from != row.end(); from += colors, ++sample) {
      sample = std::copy_n(from, colors, sample);
    }
  }
  int orientation = 1;
  std::map<char, std::string> profile;  // in parts
  const std::string in_exif("Exif\0\0", 6), in_profile("ICC_PROFILE\0", 12);
  for (const auto* marker = jpeg.marker_list; marker != nullptr; marker = marker->next) {
    const std::string data(reinterpret_cast<const char*>(marker->data), marker->data_length);
    if (data.rfind(in_exif, 0) == 0) orientation = orientation_of(data.substr(in_exif.size()));
    if (data.rfind(in_profile, 0) == 0 && data.size() > 14) profile[data[12]] = data.substr(14);
  }
  std::string whole;
  for (const auto& [number, part] : profile) whole += part;
  auto size = compressBound(whole.size());
  std::string chunk("ICC profile\0\0", 13);
  chunk.resize(chunk.size() + size);
  compress(reinterpret_cast<Bytef*>(&chunk[13]), &size,
           reinterpret_cast<const Bytef*>(whole.data()), whole.size());
  chunk.resize(13 + size);
  if (!whole.empty()) picture.chunks.emplace_back("iCCP", chunk);
  return turned(picture, orientation);
}
#else
Bitmap decode_jpeg(const std::string& path, const std::string&) {
  throw OptionError(path + ": flbc was built without libjpeg; save this picture as .png");
}
#endif

}  // namespace

Bitmap read_picture(const std::string& path) {
  return (io::extension_of(path) == "png" ? decode_png : decode_jpeg)(path, io::read_file(path));
}

void write_picture(const std::string& path, const Bitmap& picture) {
  const auto encode = [&](std::ostream& file) {
    constexpr int kFast = 3;
    Failure failure;
    const Png png(failure, false);
    png_set_write_fn(
        png.it, &file,
        [](png_structp it, png_bytep bytes, png_size_t count) {
          static_cast<std::ostream*>(png_get_io_ptr(it))
              ->write(reinterpret_cast<const char*>(bytes), std::streamsize(count));
        },
        [](png_structp) {});
    trying(path, failure, [&] {
      png_set_IHDR(png.it, png.info, picture.width, picture.height,
                   picture.largest() > 255 ? 16 : 8,
                   picture.channels == 2 ? PNG_COLOR_TYPE_GRAY_ALPHA : PNG_COLOR_TYPE_RGB_ALPHA,
                   PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
      png_set_compression_level(png.it, kFast);
      if (picture.left != 0 || picture.top != 0) {
        png_set_oFFs(png.it, png.info, picture.left, picture.top, PNG_OFFSET_PIXEL);
      }
      png_write_info(png.it, png.info);
      for (const auto& [type, data] : picture.chunks) {
        png_write_chunk(png.it, reinterpret_cast<png_const_bytep>(type.data()),
                        reinterpret_cast<png_const_bytep>(data.data()), data.size());
      }
      if (kIsLittleEndian && picture.largest() > 255) png_set_swap(png.it);
      const auto write = [&](const auto& samples) {
        const auto length = std::size_t(picture.width) * picture.channels;
        for (Index y = 0; y < picture.height; ++y) {
          png_write_row(png.it, reinterpret_cast<png_const_bytep>(&samples[length * y]));
        }
      };
      std::visit(write, picture.samples);
      png_write_end(png.it, png.info);
    });
  };
  io::write_file(path, encode);
}

std::string describe(const Bitmap& picture) {
  Facts facts;
  facts << picture.width << " x " << picture.height << " pixels";
  if (picture.left != 0 || picture.top != 0) {
    facts << ", offset (" << picture.left << ", " << picture.top << ")";
  }
  return facts.text();
}

void warn_staying(std::size_t staying, const std::string& file) {
  if (staying == 0) return;
  std::cerr << "flbc: " << file << ": " << staying
            << " pixels are outside the cage; they stay where they are\n";
}

ModelFacets<2> load_silhouette(const std::string& path) {
  const auto picture = read_picture(path);
  constexpr int kHaze = 32;  // nobody sees a pixel with less than this part of the highest alpha
  int lowest = picture.largest(), highest = 0;
  const auto count = std::size_t(picture.width) * picture.height;
  for (std::size_t k = 0; k < count; ++k) {
    lowest = std::min(lowest, picture.alpha(k));
    highest = std::max(highest, picture.alpha(k));
  }
  Mask mask{picture.width, picture.height, lowest * 255 / picture.largest()};
  for (Index y = mask.height - 1; y >= 0; --y) {
    for (Index x = 0; x < mask.width; ++x) {
      const int alpha = picture.alpha(std::size_t(y) * mask.width + x);
      mask.pixels.push_back(alpha > 0 && kHaze * alpha >= highest);
    }
  }
  return outline_of(mask, path);
}

}  // namespace flbc::app
