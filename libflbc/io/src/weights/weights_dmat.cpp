// SPDX-License-Identifier: BSD-3-Clause
// DMAT, the matrix format of libigl: "COLUMNS ROWS", then all numbers column by column, that is,
// control point by control point. The size "0 0" announces the binary form: another size line, then
// doubles.
#include <utility>

#include "text/text_reader.h"
#include "text/text_writer.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

// The byte after the `count`-th line break.
std::size_t end_of_lines(const std::string& content, int count) {
  std::size_t position = 0;
  for (int k = 0; k < count; ++k) {
    const std::size_t end = content.find('\n', position);
    if (end == std::string::npos) return content.size();
    position = end + 1;
  }
  return position;
}

}  // namespace

SparseWeights read_dmat(const std::string& path, std::string content) {
  // The two lines at the start are text in both forms; the rest may be large, so it is not copied.
  const std::size_t header_end = end_of_lines(content, 2);
  TextReader header(path, content.substr(0, header_end), {});
  if (!header.next_line()) header.fail("expected the number of columns, found the end of the file");
  const Index first = header.count("columns", 0);
  const Index second = header.count("rows", 0);
  if (first != 0 || second != 0) {
    TextReader reader(path, std::move(content), {});
    reader.next_line();
    const Index num_controls = reader.count("columns", 0);
    const Index num_points = reader.count("rows", 0);
    return read_columns(reader, num_points, num_controls);
  }
  header.expect_end_of_line();
  if (!header.next_line()) header.fail("the file ends before the size of the binary matrix");
  const Index num_controls = header.count("columns", 0);
  const Index num_points = header.count("rows", 0);
  header.expect_end_of_line();
  return BinaryBlock{path, content, header_end}.read<double>(num_points, num_controls, false);
}

void write_dmat(std::ostream& out, const SparseWeights& weights) {
  TextWriter header(out);
  header << "0 0\n" << weights.num_control_points() << " " << weights.num_points() << "\n";
  header.flush();
  const Eigen::MatrixXd by_control_point = weights.dense().transpose();
  out.write(reinterpret_cast<const char*>(by_control_point.data()),
            static_cast<std::streamsize>(sizeof(double)) * by_control_point.size());
}

}  // namespace flbc::io
