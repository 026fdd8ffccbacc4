// SPDX-License-Identifier: BSD-3-Clause
// SU2 meshes: sections "KEYWORD= VALUE" in any order, some with a line per element. Polygons are
// the elements in 2D, and those of markers in 3D; the rest of a file stays as it is.
#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/model_scan.h"

namespace flbc::io {
namespace {

// The number of corners by the type of an element, a number of VTK.
constexpr std::pair<std::int64_t, int> kCorners[] = {{3, 2},  {5, 3},  {9, 4}, {10, 4},
                                                     {12, 8}, {13, 6}, {14, 5}};

class Su2Reader {
 public:
  Su2Reader(const std::string& path, ModelScan& scan)
      : scan_(scan), reader_(path, scan.text, {'%', false}) {}

  void run() {
    while (reader_.next_line()) {
      const std::string key = keyword();
      if (key == "NDIME") {
        dimension_ = static_cast<int>(reader_.index("dimensions", 0, 4));
        if (dimension_ < 2) reader_.fail("a mesh must have 2 or 3 dimensions");
      } else if (key == "NPOIN") {
        read_points();
      } else if (key == "NELEM") {
        read_elements(dimension_ == 2);
      } else if (key == "MARKER_ELEMS") {
        read_elements(dimension_ == 3);
      } else if (key == "NZONE" && reader_.integer() != 1) {
        reader_.fail("a mesh of several zones is not supported; write a file for each zone");
      }
    }
    const auto& points = scan_.model.soup.points;
    if (points.empty()) reader_.fail("not an SU2 mesh: it has no points (NPOIN)");
    if (largest_ < static_cast<Index>(points.size())) return;
    reader_.fail_at(line_of_largest_, out_of_range_message(largest_, "points", 0, points.size()));
  }

 private:
  // The word before "=", which may be followed by a value without a blank.
  std::string keyword() {
    auto word = reader_.word();
    const std::string key(word.substr(0, word.find('=')));
    if (key.size() == word.size()) word = reader_.word();
    const auto sign = word.find('=');
    if (sign == std::string_view::npos) return {};  // such as the points of a lattice
    reader_.put_back(word.size() - sign - 1);
    return key;
  }

  void require_dimension() const {
    if (dimension_ == 0) reader_.fail("the number of dimensions (NDIME) must come first");
  }

  void read_points() {
    require_dimension();
    auto& points = scan_.model.soup.points;
    if (!points.empty()) reader_.fail("the points are declared twice");
    const Index count = reader_.count("points", 4);
    for (Index v = 0; v < count; ++v) {
      reader_.next_line_of("points", v, count);
      const auto point =
          next_numbers(reader_, scan_.text.size(), dimension_, TripleKind::kPoint, dimension_);
      points.push_back(point.values);
      add_sites(scan_, point.places, TripleKind::kPoint, v);
    }
  }

  void read_elements(bool are_polygons) {
    require_dimension();
    const Index count = reader_.count("elements", 6);
    for (Index e = 0; e < count; ++e) {
      reader_.next_line_of("elements", e, count);
      const auto type = reader_.integer();
      const auto* const found = std::find_if(std::begin(kCorners), std::end(kCorners),
                                             [&](const auto& one) { return one.first == type; });
      if (found == std::end(kCorners)) {
        reader_.fail("the type " + std::to_string(type) + " of an element is unknown");
      }
      std::vector<Index> corners(static_cast<std::size_t>(found->second));
      for (Index& corner : corners) {
        corner = reader_.index("points", 0, std::numeric_limits<Index>::max());
        if (corner > largest_) {
          largest_ = corner;
          line_of_largest_ = reader_.line();
        }
      }
      if (are_polygons && (type == 5 || type == 9)) {
        scan_.model.soup.polygons.push_back(std::move(corners));
      }
    }
  }

  ModelScan& scan_;
  TextReader reader_;
  int dimension_ = 0;
  Index largest_ = -1;  // of the numbers of corners
  std::int64_t line_of_largest_ = 0;
};

}  // namespace

void read_su2(const std::string& path, Extent extent, ModelScan& scan) {
  Su2Reader(path, scan).run();
  if (extent == Extent::kEverything) add_other(scan.model, "elements and markers of SU2");
}

}  // namespace flbc::io
