// SPDX-License-Identifier: BSD-3-Clause
// Comma-separated values: a line per point with a number per control point, without a header.
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "flbc/errors.h"
#include "text/text_reader.h"
#include "text/text_writer.h"
#include "weights/weights_formats.h"

namespace flbc::io {

namespace {

// Commas become blanks, which part numbers as well. A cell without a number would shift those after
// it. A comma at the end of a line is no cell.
void remove_commas(const std::string& path, std::string& content) {
  std::int64_t line = 1;
  Index column = 1;
  bool is_empty = true;
  for (std::size_t k = 0; k < content.size(); ++k) {
    char& c = content[k];
    if (c == '#') {
      k = std::min(content.find('\n', k), content.size()) - 1;
    } else if (c == '\n') {
      ++line;
      column = 1;
      is_empty = true;
    } else if (c == ',') {
      if (is_empty) {
        throw InputError(path + ":" + std::to_string(line) + ": column " + std::to_string(column) +
                         " is empty; write 0 for a missing number");
      }
      c = ' ';
      ++column;
      is_empty = true;
    } else if (c != ' ' && c != '\t' && c != '\r') {
      is_empty = false;
    }
  }
}

}  // namespace

SparseWeights read_csv(const std::string& path, std::string content) {
  remove_commas(path, content);
  TextReader reader(path, std::move(content), {'#', false});
  std::vector<double> numbers;
  std::size_t columns = 0, rows = 0;
  while (reader.next_line()) {
    const std::size_t begin = numbers.size();
    while (reader.has_word()) numbers.push_back(reader.number());
    const std::size_t count = numbers.size() - begin;
    if (rows++ == 0) columns = count;
    if (count != columns) {
      reader.fail("expected " + std::to_string(columns) + " numbers as on the first line, found " +
                  std::to_string(count));
    }
  }
  if (rows == 0) reader.fail("the file has no numbers");
  return WeightMatrix(Eigen::Map<const WeightMatrix>(
      numbers.data(), static_cast<Eigen::Index>(columns), static_cast<Eigen::Index>(rows)));
}

void write_csv(std::ostream& out, const SparseWeights& sparse) {
  const WeightMatrix weights = sparse.dense();
  TextWriter writer(out);
  for (Eigen::Index p = 0; p < weights.cols(); ++p) {
    for (Eigen::Index i = 0; i < weights.rows(); ++i) {
      if (i > 0) writer << ",";
      writer << weights(i, p);
    }
    writer << "\n";
  }
  writer.flush();
}

}  // namespace flbc::io
