// SPDX-License-Identifier: BSD-3-Clause
// The NumPy array format: magic, version, length of the header, header (a Python dictionary in
// text, padded so that the numbers start at a multiple of 64 bytes), numbers.

#include <ostream>

#include "text/text_reader.h"
#include "weights/npy_header.h"
#include "weights/weights_formats.h"

namespace flbc::io {

// Signature required by the format table. NOLINTNEXTLINE(performance-unnecessary-value-param)
SparseWeights read_npy(const std::string& path, std::string content) {
  const NpyHeader header = read_npy_header(path, content);
  const BinaryBlock block{path, content, header.size};
  const bool by_point = !header.fortran_order;
  if (header.shape.size() != 2) {
    block.fail(0, "the array has " + std::to_string(header.shape.size()) +
                      " dimensions; weights need 2, points x control points");
  }
  if (header.type == "<f8") return block.read<double>(header.shape[0], header.shape[1], by_point);
  if (header.type == "<f4") return block.read<float>(header.shape[0], header.shape[1], by_point);
  if (header.type == ">f8" || header.type == ">f4") {
    block.fail(0, "big-endian numbers (" + in_quotes(header.type) +
                      ") are not supported; save the array with astype('<f8')");
  }
  block.fail(0, "the type " + in_quotes(header.type) +
                    " is not supported, only \"<f8\" (float64) and \"<f4\" (float32)");
}

void write_npy(std::ostream& out, const SparseWeights& sparse) {
  const WeightMatrix weights = sparse.dense();
  // In memory the numbers of a point are contiguous, which is C order for #points x n.
  const std::string header = npy_header("<f8", {weights.cols(), weights.rows()});
  out.write(header.data(), static_cast<std::streamsize>(header.size()));
  out.write(reinterpret_cast<const char*>(weights.data()),
            static_cast<std::streamsize>(sizeof(double)) * weights.size());
}

}  // namespace flbc::io
