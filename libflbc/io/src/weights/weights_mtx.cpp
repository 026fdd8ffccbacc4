// SPDX-License-Identifier: BSD-3-Clause
// Matrix Market: one entry of the #points x n matrix per line, numbered from 1.
#include <algorithm>
#include <initializer_list>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "text/text_reader.h"
#include "text/text_writer.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

// Reads "%%MatrixMarket matrix coordinate FIELD SYMMETRY".
void read_header(TextReader& reader) {
  if (!reader.next_line() || lower_case(reader.word()) != "%%matrixmarket") {
    reader.fail("not a Matrix Market file: the first line must start with %%MatrixMarket");
  }
  const auto choose = [&reader](const char* what, std::initializer_list<const char*> supported) {
    const std::string found = lower_case(reader.word());
    if (std::find(supported.begin(), supported.end(), found) != supported.end()) return;
    std::string list;
    for (const char* word : supported) list += (list.empty() ? "" : " or ") + std::string(word);
    reader.fail("the " + std::string(what) + " " + in_quotes(found) + " is not supported, only " +
                list);
  };
  choose("object", {"matrix"});
  choose("format", {"coordinate"});
  choose("field", {"real", "double", "integer"});
  choose("symmetry", {"general"});
  reader.expect_end_of_line();
}

// Maximum number of matrix elements (8 MiB) that a file may declare without storing. In a larger
// matrix, each row and column must have an element, because weights sum to 1.
constexpr std::int64_t kHarmlessElements = std::int64_t{1} << 20;

struct Size {
  Index points = 0;
  Index controls = 0;
};

// A valid sparse file may declare far more elements than it has bytes; this prevents a damaged
// header from exhausting memory.
void check_size(const TextReader& reader, const Size& size, Index num_entries) {
  const std::int64_t elements = std::int64_t{size.points} * size.controls;
  const bool is_large = elements > kHarmlessElements ||
                        (elements == 0 && std::max(size.points, size.controls) > kHarmlessElements);
  if (is_large && num_entries < std::max(size.points, size.controls)) {
    reader.fail(std::to_string(size.points) + " x " + std::to_string(size.controls) +
                " elements are declared with only " + std::to_string(num_entries) + " entries");
  }
}

struct Entry {
  Index point;
  Index control_point;
  double value;
  std::int64_t line;
};

// Sorts entries, which a file may have in any order.
SparseWeights weights_of(const TextReader& reader, const Size& size, std::vector<Entry> entries) {
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.point, a.control_point, a.line) < std::tie(b.point, b.control_point, b.line);
  });
  std::vector<std::int64_t> starts(static_cast<std::size_t>(size.points) + 1, 0);
  std::vector<std::uint32_t> control_points;
  std::vector<double> values;
  control_points.reserve(entries.size());
  values.reserve(entries.size());
  const Entry* before = nullptr;
  for (const auto& entry : entries) {
    if (before && before->point == entry.point && before->control_point == entry.control_point) {
      reader.fail_at(entry.line, "the entry in row " + std::to_string(entry.point + 1) +
                                     ", column " + std::to_string(entry.control_point + 1) +
                                     " occurs twice");
    }
    before = &entry;
    ++starts[entry.point + 1];
    control_points.push_back(static_cast<std::uint32_t>(entry.control_point));
    values.push_back(entry.value);
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  return {size.controls, std::move(starts), std::move(control_points), std::move(values)};
}

SparseWeights read_coordinate(TextReader& reader, const Size& size) {
  const Index num_entries = reader.count("entries", 6);
  reader.expect_end_of_line();
  check_size(reader, size, num_entries);
  std::vector<Entry> entries;
  entries.reserve(static_cast<std::size_t>(num_entries));
  for (Index k = 0; k < num_entries; ++k) {
    reader.next_line_of("entries", k, num_entries);
    Entry entry{};
    entry.point = reader.index("rows", 1, size.points);
    entry.control_point = reader.index("columns", 1, size.controls);
    entry.value = reader.number();
    entry.line = reader.line();
    reader.expect_end_of_line();
    entries.push_back(entry);
  }
  reader.expect_end_of_file("the last declared entry");
  return weights_of(reader, size, std::move(entries));
}

}  // namespace

SparseWeights read_mtx(const std::string& path, std::string content) {
  TextReader reader(path, std::move(content), {});
  read_header(reader);
  reader.set_comment('%');
  if (!reader.next_line()) reader.fail("the file ends before the size of the matrix");
  // The file length does not bound sizes here, because a sparse matrix may have empty rows.
  Size size;
  size.points = reader.count("rows", 0);
  size.controls = reader.count("columns", 0);
  return read_coordinate(reader, size);
}

void write_mtx(std::ostream& out, const SparseWeights& weights) {
  TextWriter writer(out);
  writer << "%%MatrixMarket matrix coordinate real general\n"
         << "% weights: a row per point, a column per control point\n"
         << weights.num_points() << " " << weights.num_control_points() << " "
         << weights.starts().back() << "\n";
  for (Index p = 0; p < weights.num_points(); ++p) {
    weights.visit(p, [&](Index i, double weight) {
      writer << p + 1 << " " << i + 1 << " " << weight << "\n";
    });
  }
  writer.flush();
}

}  // namespace flbc::io
