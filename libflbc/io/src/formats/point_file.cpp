// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/point_file.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>
#include <system_error>

#include "base/instantiate.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "model/ply_reader.h"
#include "text/bytes.h"
#include "text/text_reader.h"
#include "weights/npy_header.h"

namespace flbc::io {
namespace {

constexpr std::size_t kMostHeader = 1 << 16;
constexpr std::int64_t kPointsAtOnce = 1 << 16;

class PointInput {
 public:
  explicit PointInput(const std::string& path) : path_(path), stream_(path, std::ios::binary) {
    if (!stream_) fail(errno);
  }
  // Fewer bytes only at the end of the file.
  std::size_t read(char* bytes, std::size_t count) {
    errno = 0;
    stream_.read(bytes, static_cast<std::streamsize>(count));
    if (stream_.bad()) fail(errno);
    return static_cast<std::size_t>(stream_.gcount());
  }

 private:
  [[noreturn]] void fail(int error) const {
    throw IoError("cannot read \"" + path_ + "\": " + std::generic_category().message(error));
  }
  const std::string& path_;
  std::ifstream stream_;
};

PointLayout npy_layout(const std::string& path, const std::string& start) {
  const auto header = read_npy_header(path, start);
  if (header.shape.size() != 2 || (header.shape[1] != 2 && header.shape[1] != 3)) {
    throw InputError(path + ": points need an array with 2 dimensions and 2 or 3 columns");
  }
  if (header.fortran_order || (header.type != "<f8" && header.type != "<f4")) {
    throw InputError(path + ": points need float32 or float64 in C order, not " +
                     in_quotes(header.type) + (header.fortran_order ? " in Fortran order" : "") +
                     "; save them with numpy.ascontiguousarray(points, '<f8')");
  }
  PointLayout layout{header.size, 0, header.shape[0], {}, header.type == "<f8"};
  for (std::int64_t d = 0; d < header.shape[1]; ++d) {
    layout.offsets.push_back(layout.stride);
    layout.stride += layout.is_double ? 8 : 4;
  }
  return layout;
}

std::optional<PointLayout> ply_layout(const std::string& path, const std::string& start) {
  const PlyReader reader(path, start);
  if (!reader.is_binary_little_endian() || reader.elements().empty()) return {};
  const auto& vertices = reader.elements().front();
  if (vertices.name != "vertex" || vertices.find("nx") >= 0 || vertices.find("x") < 0) return {};
  const bool is_mesh =
      std::any_of(reader.elements().begin() + 1, reader.elements().end(), [](const auto& element) {
        return element.count > 0 && (element.name == "face" || element.name == "tristrips");
      });
  if (is_mesh) return {};
  const auto& type = *vertices.properties[vertices.find("x")].type;
  PointLayout layout{reader.position(), 0, vertices.count, {}, type.bytes == 8};
  std::vector<std::size_t> offsets;
  for (const auto& property : vertices.properties) {
    if (property.count_type) return {};
    offsets.push_back(layout.stride);
    layout.stride += property.type->bytes;
  }
  for (const char* const name : {"x", "y", "z"}) {
    const int k = vertices.find(name);
    if (k < 0 || vertices.properties[k].type != &type || type.kind != 'f') return {};
    layout.offsets.push_back(offsets[k]);
  }
  return layout;
}

}  // namespace

std::optional<PointLayout> find_point_layout(const std::string& path) {
  const auto extension = extension_of(path);
  if (extension != "npy" && extension != "ply") return {};
  PointInput input(path);
  std::string start(kMostHeader, '\0');
  start.resize(input.read(start.data(), start.size()));
  const auto layout = extension == "npy" ? npy_layout(path, start) : ply_layout(path, start);
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (layout && (size < layout->header || (size - layout->header) / layout->stride <
                                              static_cast<std::uintmax_t>(layout->count))) {
    throw InputError(path + ": the file is too short for " + std::to_string(layout->count) +
                     " points");
  }
  return layout;
}

template <int Dim>
void rewrite_points(
    const std::string& path, const PointLayout& layout, std::ostream& out,
    const std::function<PointList<Dim>(const PointList<Dim>& batch, std::int64_t first)>& move) {
  PointInput input(path);
  std::vector<char> bytes(kPointsAtOnce * layout.stride);
  const auto copy = [&](std::size_t count) {
    const auto got = input.read(bytes.data(), count);
    out.write(bytes.data(), static_cast<std::streamsize>(got));
    return got;
  };
  for (auto left = layout.header; left > 0;) {
    const auto got = copy(std::min(left, bytes.size()));
    if (got == 0) throw InputError(path + ": the file became shorter");
    left -= got;
  }
  PointList<Dim> points;
  for (std::int64_t first = 0; first < layout.count; first += kPointsAtOnce) {
    const auto count = std::min(kPointsAtOnce, layout.count - first);
    const auto size = static_cast<std::size_t>(count) * layout.stride;
    if (input.read(bytes.data(), size) != size)
      throw InputError(path + ": the file became shorter");
    points.resize(Dim, count);
    for (std::int64_t p = 0; p < count; ++p) {
      for (int d = 0; d < Dim; ++d) {
        const char* const place = bytes.data() + p * layout.stride + layout.offsets[d];
        points(d, p) = layout.is_double ? number_at<double>(place) : number_at<float>(place);
      }
      if (!points.col(p).allFinite()) {
        throw InputError(path + ": point " + std::to_string(first + p) + " is not finite");
      }
    }
    const PointList<Dim> moved = move(points, first);
    for (std::int64_t p = 0; p < count; ++p) {
      for (int d = 0; d < Dim; ++d) {
        char* const place = bytes.data() + p * layout.stride + layout.offsets[d];
        layout.is_double ? put_number(moved(d, p), place)
                         : put_number(static_cast<float>(moved(d, p)), place);
      }
    }
    out.write(bytes.data(), static_cast<std::streamsize>(size));
    if (!out) return;  // write_file() reports the error
  }
  while (copy(bytes.size()) > 0) {
  }
}

FLBC_INSTANTIATE_FUNCTION(rewrite_points)

}  // namespace flbc::io
