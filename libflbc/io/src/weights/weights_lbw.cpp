// SPDX-License-Identifier: BSD-3-Clause
// LBW, for graphics cards: the 8 largest weights of every vertex. Little-endian: "LBW1", the
// numbers of vertices, control points, and weights per vertex (8) as 32-bit integers; then the
// control points of all weights as 16-bit integers, vertex by vertex; then the weights in single
// precision.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <ostream>
#include <utility>
#include <vector>

#include "flbc/errors.h"
#include "text/bytes.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

constexpr std::size_t kPerVertex = 8;
constexpr char kLbwMagic[] = {'L', 'B', 'W', '1'};
constexpr std::size_t kLbwHeader = 16;

template <class Number>
void write_numbers(std::ostream& out, const std::vector<Number>& numbers) {
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(sizeof(Number) * numbers.size()));
}

}  // namespace

SparseWeights read_lbw(const std::string& path, std::string content) {
  const auto fail = [&](const std::string& message) { throw InputError(path + ": " + message); };
  if (content.size() < kLbwHeader ||
      std::memcmp(content.data(), kLbwMagic, sizeof kLbwMagic) != 0) {
    fail("not an LBW file");
  }
  const std::size_t num_points = number_at<std::uint32_t>(content.data() + 4);
  const std::size_t num_controls = number_at<std::uint32_t>(content.data() + 8);
  if (number_at<std::uint32_t>(content.data() + 12) != kPerVertex)
    fail("must have 8 weights per vertex");
  constexpr std::size_t kBytes = kPerVertex * (sizeof(std::uint16_t) + sizeof(float));
  if (content.size() != kLbwHeader + num_points * kBytes) {
    fail("has " + std::to_string(content.size()) + " bytes, but " + std::to_string(num_points) +
         " vertices take " + std::to_string(kLbwHeader + num_points * kBytes));
  }
  if (num_controls > std::size_t{1} << 16) fail("has more than 65536 control points");
  const std::size_t first_value = kLbwHeader + num_points * kPerVertex * sizeof(std::uint16_t);
  std::vector<std::int64_t> starts{0};
  std::vector<std::uint32_t> control_points;
  std::vector<double> values;
  for (std::size_t p = 0; p < num_points; ++p) {
    std::vector<std::pair<std::uint32_t, double>> influences;
    for (std::size_t k = kPerVertex * p; k < kPerVertex * (p + 1); ++k) {
      const auto value = number_at<float>(content.data() + first_value + k * sizeof(float));
      if (value == 0) continue;
      influences.emplace_back(number_at<std::uint16_t>(content.data() + kLbwHeader + 2 * k), value);
    }
    std::sort(influences.begin(), influences.end());
    for (const auto& [control_point, value] : influences) {
      control_points.push_back(control_point);
      values.push_back(value);
    }
    starts.push_back(static_cast<std::int64_t>(values.size()));
  }
  try {
    return {static_cast<Index>(num_controls), std::move(starts), std::move(control_points),
            std::move(values)};
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

void write_lbw(std::ostream& out, const SparseWeights& weights) {
  const Index num_points = weights.num_points(), num_controls = weights.num_control_points();
  if (num_controls > 1 << 16) {
    throw InputError("this format holds at most 65536 control points, not " +
                     std::to_string(num_controls));
  }
  std::vector<std::uint16_t> control_points(kPerVertex * static_cast<std::size_t>(num_points), 0);
  std::vector<float> values(control_points.size(), 0);
  for (Index p = 0; p < num_points; ++p) {
    std::vector<std::pair<double, Index>> influences;
    weights.visit(p, [&](Index i, double weight) {
      if (weight != 0) influences.emplace_back(weight, i);
    });
    if (influences.size() > kPerVertex) {
      throw InputError("vertex " + std::to_string(p) + " has " + std::to_string(influences.size()) +
                       " influences, but this format holds 8; reduce them first");
    }
    std::sort(influences.begin(), influences.end(),
              [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
    for (std::size_t k = 0; k < influences.size(); ++k) {
      const std::size_t place = kPerVertex * static_cast<std::size_t>(p) + k;
      values[place] = static_cast<float>(influences[k].first);
      control_points[place] = static_cast<std::uint16_t>(influences[k].second);
    }
  }
  out.write(kLbwMagic, sizeof kLbwMagic);
  write_numbers<std::uint32_t>(out, {static_cast<std::uint32_t>(num_points),
                                     static_cast<std::uint32_t>(num_controls), kPerVertex});
  write_numbers(out, control_points);
  write_numbers(out, values);
}

}  // namespace flbc::io
