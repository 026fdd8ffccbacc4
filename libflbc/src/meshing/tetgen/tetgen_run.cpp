// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/tetgen/tetgen_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>

#include <tetgen.h>

#include "base/stopwatch.h"
#include "flbc/errors.h"
#include "meshing/isolated_process.h"
#include "meshing/meshing_common.h"

namespace flbc {

namespace {

// Header of the child output, before the arrays.
struct Header {
  std::int64_t num_points;
  std::int64_t num_cells;
};

// TetGen's input object deletes its arrays itself.
REAL* copy_of(const PointList<3>& points) {
  REAL* const copy = new REAL[points.size()];
  std::copy_n(points.data(), points.size(), copy);
  return copy;
}

// In an order that does not depend on that in a file, because the mesh depends on it.
std::vector<std::array<int, 3>> in_order(const FacetList<3>& triangles) {
  std::vector<std::array<int, 3>> ordered;
  for (const auto& triangle : triangles.colwise()) {
    auto& corners = ordered.emplace_back(std::array<int, 3>{triangle[0], triangle[1], triangle[2]});
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
  std::sort(ordered.begin(), ordered.end());
  return ordered;
}

void fill_facets(const FacetList<3>& triangles, tetgenio& io) {
  const auto ordered = in_order(triangles);
  io.numberoffacets = static_cast<int>(triangles.cols());
  io.facetlist = new tetgenio::facet[triangles.cols()];
  for (Index t = 0; t < triangles.cols(); ++t) {
    tetgenio::facet& facet = io.facetlist[t];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(&facet.polygonlist[0]);
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    for (int k = 0; k < 3; ++k)
      facet.polygonlist[0].vertexlist[k] = ordered[static_cast<std::size_t>(t)][k];
  }
}

// Sizes of the input, before its arrays.
struct InputHeader {
  std::int64_t num_points;
  std::int64_t num_triangles;
  std::int64_t num_holes;
  std::int64_t num_switches;
};

std::vector<char> packed(const TetgenInput& input, const std::string& switches) {
  std::vector<char> bytes;
  const auto append = sink_into(bytes);
  const InputHeader header{input.points.cols(), input.triangles.cols(), input.holes.cols(),
                           static_cast<std::int64_t>(switches.size())};
  append(&header, sizeof header);
  append(input.points.data(), sizeof(double) * static_cast<std::size_t>(input.points.size()));
  append(input.triangles.data(), sizeof(Index) * static_cast<std::size_t>(input.triangles.size()));
  append(input.holes.data(), sizeof(double) * static_cast<std::size_t>(input.holes.size()));
  append(switches.data(), switches.size());
  return bytes;
}

std::string unpack(const std::vector<char>& bytes, TetgenInput& input) {
  ByteSource source(bytes, [] { throw InputError("TetGen received an incomplete input"); });
  InputHeader header{};
  source.take(&header, 1);
  input.points.resize(3, header.num_points);
  input.triangles.resize(3, header.num_triangles);
  input.holes.resize(3, header.num_holes);
  std::string switches(static_cast<std::size_t>(header.num_switches), ' ');
  source.take(input.points.data(), 3 * static_cast<std::size_t>(header.num_points));
  source.take(input.triangles.data(), 3 * static_cast<std::size_t>(header.num_triangles));
  source.take(input.holes.data(), 3 * static_cast<std::size_t>(header.num_holes));
  source.take(switches.data(), switches.size());
  return switches;
}

// Runs in the child, because a failing TetGen frees memory twice and crashes the process.
void tetrahedralize_and_send(const std::vector<char>& bytes, const ByteSink& send) {
  TetgenInput input;
  std::string switches = unpack(bytes, input);
  tetgenio in, out;
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(input.points.cols());
  in.pointlist = copy_of(input.points);
  fill_facets(input.triangles, in);
  in.numberofholes = static_cast<int>(input.holes.cols());
  in.holelist = copy_of(input.holes);
  try {
    ::tetrahedralize(switches.data(), &in, &out);
  } catch (int reason) {
    constexpr int kOutOfMemory = 1;  // of terminatetetgen()
    if (reason == kOutOfMemory) throw std::bad_alloc();
    throw;
  }

  const Header header{out.numberofpoints, out.numberoftetrahedra};
  std::vector<std::int32_t> regions(std::size_t(out.numberoftetrahedra), 0);
  const auto attributes = static_cast<std::size_t>(out.numberoftetrahedronattributes);
  for (std::size_t cell = 0; cell < regions.size() && attributes > 0; ++cell) {
    regions[cell] =
        static_cast<std::int32_t>(std::lround(out.tetrahedronattributelist[cell * attributes]));
  }
  send(&header, sizeof(header));
  send(out.pointlist, sizeof(double) * 3 * std::size_t(out.numberofpoints));
  send(out.tetrahedronlist, sizeof(int) * 4 * std::size_t(out.numberoftetrahedra));
  send(regions.data(), sizeof(std::int32_t) * regions.size());
}

[[noreturn]] void fail(const std::string& what) {
  throw InputError(
      "TetGen " + what +
      " while filling the cage; the usual causes are facets that intersect or touch each "
      "other, and facets at extremely small angles");
}

void refuse_failure(const ProcessOutcome& outcome, double time_limit) {
  const auto failure = describe_failure(outcome, time_limit);
  if (outcome.end == ProcessEnd::kTimedOut) {
    throw InputError("TetGen " + failure +
                     "; raise the limit, ask for fewer vertices, or check the cage for facets that "
                     "intersect or are extremely close");
  }
  if (!failure.empty()) fail(failure);
}

// On valid cages with many coplanar points, TetGen sometimes fails an assertion in point location,
// depending on the insertion order of points. b0/0 uses the input order; l flips incrementally.
ProcessOutcome run_with_fallbacks(const TetgenInput& input, const std::string& switches,
                                  const Patience& patience) {
  Stopwatch watch;
  double left = patience.seconds;
  ProcessOutcome outcome;
  for (const char* order : {"", "b0/0", "lb0/0"}) {
    outcome = run_isolated(tetrahedralize_and_send, packed(input, switches + order),
                           {left, patience.poll});
    if (outcome.end != ProcessEnd::kCrashed && outcome.end != ProcessEnd::kThrew) break;
    left -= watch.lap();
    if (left <= 0) break;
  }
  return outcome;
}

}  // namespace

TetgenOutput run_tetgen(const TetgenInput& input, const std::string& switches,
                        const Patience& patience) {
  const DecimalUnit<3> unit(input.points);
  const ProcessOutcome outcome = run_with_fallbacks(
      {unit.scaled(input.points), input.triangles, unit.scaled(input.holes)}, switches, patience);
  refuse_failure(outcome, patience.seconds);

  ByteSource source(outcome.output, [] { fail("sent an incomplete result"); });
  Header header{};
  source.take(&header, 1);
  TetgenOutput result;
  result.mesh.points.resize(3, header.num_points);
  result.mesh.cells.resize(4, header.num_cells);
  result.regions.resize(std::size_t(header.num_cells));
  source.take(result.mesh.points.data(), 3 * std::size_t(header.num_points));
  source.take(result.mesh.cells.data(), 4 * std::size_t(header.num_cells));
  source.take(result.regions.data(), result.regions.size());
  result.mesh.points = unit.restored(result.mesh.points, input.points);
  return result;
}

}  // namespace flbc
