// SPDX-License-Identifier: BSD-3-Clause
// Matrix Market: one entry of the #points x n matrix per line, numbered from 1.
#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <new>
#include <utility>
#include <vector>

#include "text/text_reader.h"
#include "text/text_writer.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

std::string lower_case_word(TextReader& reader) {
  std::string word(reader.word());
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

// Reads "%%MatrixMarket matrix FORMAT FIELD SYMMETRY". \return whether the format is coordinate
bool read_header(TextReader& reader) {
  if (!reader.next_line() || lower_case_word(reader) != "%%matrixmarket") {
    reader.fail("not a Matrix Market file: the first line must start with %%MatrixMarket");
  }
  const auto choose = [&reader](const char* what, std::initializer_list<const char*> supported) {
    std::string found = lower_case_word(reader);
    if (std::find(supported.begin(), supported.end(), found) != supported.end()) return found;
    std::string list;
    for (const char* word : supported) list += (list.empty() ? "" : " or ") + std::string(word);
    reader.fail("the " + std::string(what) + " " + in_quotes(found) + " is not supported, only " +
                list);
  };
  choose("object", {"matrix"});
  const std::string format = choose("format", {"coordinate", "array"});
  choose("field", {"real", "double", "integer"});
  choose("symmetry", {"general"});
  reader.expect_end_of_line();
  return format == "coordinate";
}

struct Size {
  Index points = 0;
  Index controls = 0;
};

// A sparse file may rightly declare far more elements than it has bytes, but then each row and each
// column has an entry; this keeps a damaged header from claiming all memory.
WeightMatrix allocate(const TextReader& reader, const Size& size, Index num_entries) {
  constexpr std::int64_t kHarmless = std::int64_t{1} << 24;
  const std::int64_t elements = std::int64_t{size.points} * size.controls;
  const std::string declared =
      std::to_string(size.points) + " x " + std::to_string(size.controls) + " elements";
  const bool is_large = elements > kHarmless || is_absurd(size.points, size.controls);
  if (is_large && num_entries < std::max(size.points, size.controls)) {
    reader.fail(declared + " are declared with only " + std::to_string(num_entries) + " entries");
  }
  try {
    return WeightMatrix::Zero(size.controls, size.points);
  } catch (const std::bad_alloc&) {
    reader.fail(declared + " are declared, more than the memory can hold");
  }
}

WeightMatrix read_coordinate(TextReader& reader, const Size& size) {
  const Index num_entries = reader.count("entries", 6);
  reader.expect_end_of_line();
  WeightMatrix weights = allocate(reader, size, num_entries);
  std::vector<bool> seen(static_cast<std::size_t>(weights.size()), false);
  for (Index k = 0; k < num_entries; ++k) {
    reader.next_line_of("entries", k, num_entries);
    const Index point = reader.index("rows", 1, size.points);
    const Index control = reader.index("columns", 1, size.controls);
    weights(control, point) = reader.number();
    reader.expect_end_of_line();
    auto entry = seen[static_cast<std::size_t>(point) * static_cast<std::size_t>(size.controls) +
                      static_cast<std::size_t>(control)];
    if (entry) {
      reader.fail("the entry in row " + std::to_string(point + 1) + ", column " +
                  std::to_string(control + 1) + " occurs twice");
    }
    entry = true;
  }
  reader.expect_end_of_file("the last declared entry");
  return weights;
}

}  // namespace

WeightMatrix read_mtx(const std::string& path, std::string content) {
  TextReader reader(path, std::move(content), {});
  const bool is_coordinate = read_header(reader);
  reader.set_comment('%');
  if (!reader.next_line()) reader.fail("the file ends before the size of the matrix");
  // Sizes are not bounded by the file's length here: a sparse matrix may have empty rows.
  Size size;
  size.points = reader.count("rows", 0);
  size.controls = reader.count("columns", 0);
  if (is_coordinate) return read_coordinate(reader, size);
  reader.expect_end_of_line();
  return read_columns(reader, size.points, size.controls);
}

void write_mtx(std::ostream& out, const SparseWeights& weights) {
  TextWriter writer(out);
  writer << "%%MatrixMarket matrix coordinate real general\n"
         << "% weights: a row per point, a column per control point\n"
         << weights.num_points() << " " << weights.num_control_points() << " "
         << weights.starts().back() << "\n";
  for (Index p = 0; p < weights.num_points(); ++p) {
    for (std::int64_t k = weights.starts()[p]; k < weights.starts()[p + 1]; ++k) {
      const auto control_point = std::int64_t{weights.control_points()[k]};
      writer << p + 1 << " " << control_point + 1 << " " << weights.values()[k] << "\n";
    }
  }
  writer.flush();
}

}  // namespace flbc::io
