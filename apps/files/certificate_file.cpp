// SPDX-License-Identifier: BSD-3-Clause
#include "files/certificate_file.h"

#include <zlib.h>

#include <cstdint>
#include <limits>
#include <ostream>
#include <vector>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "weights/npy_header.h"

namespace flbc::app {
namespace {

template <class Scalar>
constexpr const char* kType = nullptr;
template <>
constexpr const char* kType<double> = "<f8";
template <>
constexpr const char* kType<float> = "<f4";
template <>
constexpr const char* kType<Index> = "<i4";

// An archive of NumPy arrays: a zip file without compression.
class NpzWriter {
 public:
  NpzWriter(std::string path, std::ostream& out) : path_(std::move(path)), out_(out) {}

  // \param data  of an array of this shape in C order
  template <class Scalar>
  void add(const std::string& name, const Scalar* data, const std::vector<std::int64_t>& shape) {
    const auto head = io::npy_header(kType<Scalar>, shape);
    std::size_t bytes = sizeof(Scalar);
    for (const auto size : shape) bytes *= static_cast<std::size_t>(size);
    // Larger files would need another version of the format.
    if (bytes > std::numeric_limits<std::uint32_t>::max() - offset_ - 4096)
      throw IoError(path_ + ": the certificate is larger than 4 GB; use a coarser mesh");
    auto sum = crc32(0, bytes_of(head.data()), static_cast<uInt>(head.size()));
    if (bytes > 0) sum = crc32(sum, bytes_of(data), static_cast<uInt>(bytes));  // null: starts over
    const auto file = name + ".npy";
    // Version, flags, compression, time, date, check sum, both sizes, length of the name, no extra.
    std::string entry;
    put(entry, {{20, 2}, {0, 2}, {0, 2}, {0, 2}, {0x21, 2}, {sum, 4}});
    put(entry, {{head.size() + bytes, 4}, {head.size() + bytes, 4}, {file.size(), 2}, {0, 2}});
    directory_ += "PK\x01\x02";
    put(directory_, {{20, 2}});
    directory_ += entry;
    put(directory_, {{0, 2}, {0, 2}, {0, 2}, {0, 4}, {offset_, 4}});
    directory_ += file;
    ++count_;
    const auto start = "PK\x03\x04" + entry + file + head;
    write(start.data(), start.size());
    write(reinterpret_cast<const char*>(data), bytes);
  }

  void finish() {
    const auto begin = offset_, size = directory_.size();
    directory_ += "PK\x05\x06";
    put(directory_, {{0, 2}, {0, 2}, {count_, 2}, {count_, 2}, {size, 4}, {begin, 4}, {0, 2}});
    write(directory_.data(), directory_.size());
  }

 private:
  struct Number {
    std::size_t value;
    int bytes;
  };
  static void put(std::string& text, const std::vector<Number>& numbers) {
    for (const auto& [value, bytes] : numbers) {
      for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 0xff);
    }
  }
  static const Bytef* bytes_of(const void* data) { return static_cast<const Bytef*>(data); }

  void write(const char* data, std::size_t size) {
    out_.write(data, static_cast<std::streamsize>(size));
    offset_ += size;
  }

  std::string path_;
  std::ostream& out_;
  std::string directory_;
  std::size_t offset_ = 0, count_ = 0;
};

}  // namespace

template <int Dim>
void write_certificate(const std::string& path, const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                       const Solution& solution) {
  const auto weights = solution.weights.dense();
  const auto& bounds = solution.report.certificate;
  const auto& proof = *bounds.proof;
  const auto phi = proof.phi.dense();
  const double claimed[] = {bounds.objective, bounds.lower_bound};
  io::write_file(path, [&](std::ostream& out) {
    NpzWriter file(path, out);
    const auto n = weights.rows();
    const auto vertices = weights.cols(), cells = proof.phi.cols();
    // Columns of Eigen are rows of NumPy.
    file.add("control_points", cage.points.data(), {n, Dim});
    file.add("facets", cage.facets.data(), {cage.facets.cols(), Dim});
    file.add("points", mesh.points.data(), {vertices, Dim});
    file.add("cells", mesh.cells.data(), {cells, Dim + 1});
    file.add("weights", weights.data(), {vertices, n});
    file.add("phi", phi.data(), {cells, n});
    file.add("flux", proof.flux.data(), {cells, Dim, n});
    file.add("multipliers", proof.multipliers.data(), {vertices, Dim});
    file.add("smoothness", &proof.smoothness, {});
    file.add("masked", proof.masked.data(), {proof.masked.cols(), 2});
    file.add("claimed", claimed, {2});
    file.finish();
  });
}

template void write_certificate(const std::string&, const Cage<2>&, const DomainMesh<2>&,
                                const Solution&);
template void write_certificate(const std::string&, const Cage<3>&, const DomainMesh<3>&,
                                const Solution&);

}  // namespace flbc::app
