// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/keyframes.h"

#include "base/messages.h"
#include "flbc/io/files.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

// A displacement and its line, because keyframes may be declared after it.
struct Line {
  std::int64_t number;
  std::int64_t keyframe;
  Vector<3> displacement;
};

// Checks that the last keyframe is not earlier than the previous one.
void require_order(const TextReader& reader, const std::vector<Keyframe>& keyframes) {
  const std::size_t last = keyframes.size() - 1;
  if (last == 0 || keyframes[last].time >= keyframes[last - 1].time) return;
  reader.fail("keyframe " + std::to_string(last) + " at " + format_number(keyframes[last].time) +
              " comes before keyframe " + std::to_string(last - 1) + " at " +
              format_number(keyframes[last - 1].time));
}

}  // namespace

std::vector<Keyframe> read_keyframes(const std::string& path) {
  TextReader reader(path, read_file(path), {'#', false});
  std::vector<Keyframe> keyframes;
  std::vector<Line> lines;
  while (reader.next_line()) {
    const std::string_view keyword = reader.word();
    if (keyword == "k") {
      keyframes.push_back({reader.number(), {}});
      require_order(reader, keyframes);
    } else if (keyword == "c") {
      const std::int64_t keyframe = reader.integer();
      lines.push_back({reader.line(), keyframe, reader.point()});
    } else {
      reader.fail_expected("a keyframe (\"k\") or a displacement (\"c\")", keyword);
    }
    reader.expect_end_of_line();
  }
  if (keyframes.empty()) reader.fail("the file ends without a keyframe (\"k\" line)");

  std::vector<std::vector<Vector<3>>> displacements(keyframes.size());
  for (const Line& line : lines) {
    if (line.keyframe < 0 || line.keyframe >= static_cast<std::int64_t>(keyframes.size())) {
      reader.fail_at(line.number,
                     out_of_range_message(line.keyframe, "keyframes", 0, keyframes.size()));
    }
    displacements[line.keyframe].push_back(line.displacement);
  }
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    const auto count = displacements[k].size(), expected = displacements[0].size();
    if (count == 0) {
      reader.fail("keyframe " + std::to_string(k) + " has no displacements (\"c\" lines)");
    }
    if (count != expected) {
      reader.fail("keyframe " + std::to_string(k) + " has " + std::to_string(count) +
                  " control points, keyframe 0 has " + std::to_string(expected));
    }
    keyframes[k].displacements = Eigen::Map<const PointList<3>>(displacements[k].front().data(), 3,
                                                                static_cast<Eigen::Index>(count));
  }
  return keyframes;
}

}  // namespace flbc::io
