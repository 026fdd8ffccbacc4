// SPDX-License-Identifier: BSD-3-Clause
// LBW, for graphics cards, only written: the 8 largest weights of every vertex. Little-endian:
// "LBW1", the numbers of vertices, control points, and weights per vertex (8) as 32-bit integers;
// then the control points of all weights as 16-bit integers, vertex by vertex; then the weights in
// single precision.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <utility>
#include <vector>

#include "flbc/errors.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

constexpr std::size_t kPerVertex = 8;
constexpr char kLbwMagic[] = {'L', 'B', 'W', '1'};

template <class Number>
void write_numbers(std::ostream& out, const std::vector<Number>& numbers) {
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(sizeof(Number) * numbers.size()));
}

}  // namespace

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
