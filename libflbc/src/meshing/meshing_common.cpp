// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/meshing_common.h"

#include <cstdio>
#include <string>

#include "base/instantiate.h"
#include "base/messages.h"
#include "cage/close_points.h"
#include "cage/point_in_cage.h"
#include "flbc/bounding_box.h"
#include "flbc/cage_facts.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "mesh/hilbert_order.h"

namespace flbc {

namespace {

// Numbers of facets in 3D, about twelve per vertex and two slots each, must fit an Index.
constexpr Index kMostVertices = 50000000;

template <int Dim>
void check_options(const MeshingOptions<Dim>& options) {
  if (options.vertices < 0) {
    throw OptionError("vertices: " + std::to_string(options.vertices) +
                      " is not a number of vertices; give a positive number, or 0 for the minimum");
  }
  if (options.vertices > kMostVertices) {
    throw OptionError("vertices: " + std::to_string(options.vertices) + " are too many; at most " +
                      std::to_string(kMostVertices) + " are supported");
  }
  if (!(options.time_limit > 0)) {
    throw OptionError("time_limit: the limit must be a positive number of seconds");
  }
}

template <int Dim>
[[noreturn]] void refuse_point(const PointList<Dim>& embedded, Index i, const std::string& reason) {
  throw InputError("point " + std::to_string(i) + " at " + format_point(embedded.col(i)) +
                   " cannot be embedded: " + reason);
}

template <int Dim>
void check_location(const Cage<Dim>& cage, const PointList<Dim>& embedded, double tolerance) {
  const CageLocator<Dim> locator(cage, tolerance);
  for (Index i = 0; i < embedded.cols(); ++i) {
    const Containment location = locator.locate(embedded.col(i));
    if (location == Containment::kOutside) refuse_point<Dim>(embedded, i, "it is outside the cage");
    if (location == Containment::kOnCage) {
      refuse_point<Dim>(embedded, i, "it is on the cage, but must be strictly inside");
    }
  }
}

// 3D meshers cannot separate closer points and facets, and would run for minutes.
void check_thickness(const Cage<3>& cage) {
  const auto place = thinnest_place(cage);
  const double part = place.distance / bounding_box_diagonal<3>(cage.points);
  if (place.facet < 0 || part > kPointTolerance) return;
  throw InputError(describe_control_point<3>(cage.points, place.control_point) +
                   " is too close to triangle " + std::to_string(place.facet) + ": " +
                   format_number(part) + " of the cage size; a 3D mesh needs at least " +
                   format_number(kPointTolerance) + "; move them apart or merge them");
}

template <int Dim>
void check_distinctness(const Cage<Dim>& cage, const PointList<Dim>& input, double tolerance) {
  for (const auto& [first, second] : find_close_pairs<Dim>(input, tolerance, input.cols())) {
    if (second < cage.size()) continue;  // close, but distinct enough for validate()
    const std::string other = first < cage.size() ? "control point " + std::to_string(first)
                                                  : "point " + std::to_string(first - cage.size());
    const PointList<Dim> embedded = input.rightCols(input.cols() - cage.size());
    refuse_point<Dim>(embedded, second - cage.size(),
                      "it coincides with " + other + ", but embedding needs distinct points");
  }
}

}  // namespace

template <int Dim>
PointList<Dim> collect_input_points(const Cage<Dim>& cage, const MeshingOptions<Dim>& options) {
  check_options(options);
  if constexpr (Dim == 3) check_thickness(cage);
  const PointList<Dim>& embedded = options.embedded_points;
  PointList<Dim> input(Dim, cage.size() + embedded.cols());
  input << cage.points, embedded;

  for (Index i = 0; i < embedded.cols(); ++i) {
    if (!embedded.col(i).allFinite()) refuse_point<Dim>(embedded, i, "it is not finite");
  }
  const double tolerance = kPointTolerance * bounding_box_diagonal<Dim>(cage.points);
  check_distinctness<Dim>(cage, input, tolerance);
  check_location<Dim>(cage, embedded, tolerance);
  return input;
}

template <int Dim>
DecimalUnit<Dim>::DecimalUnit(const PointList<Dim>& cage)
    : exponent_(static_cast<int>(std::floor(std::log10(bounding_box_diagonal(cage) / 1.4)))) {
}

template <int Dim>
PointList<Dim> DecimalUnit<Dim>::scaled(const PointList<Dim>& points) const {
  constexpr int kDecimals = 12;
  return (points * std::pow(10.0, kDecimals - exponent_)).array().round() /
         std::pow(10.0, kDecimals);
}

template <int Dim>
PointList<Dim> DecimalUnit<Dim>::restored(const PointList<Dim>& points,
                                          const PointList<Dim>& input) const {
  PointList<Dim> result = points;
  if (exponent_ >= 0) result *= length();
  if (exponent_ < 0) result /= std::pow(10.0, -exponent_);
  result.leftCols(input.cols()) = input;
  return result;
}

void check_vertex_count(Index wanted, Index minimum, double tolerance) {
  if (wanted == 0 || wanted >= (1 - tolerance) * minimum) return;
  throw TooFewVertices(
      "vertices: " + std::to_string(wanted) +
      " vertices are too few: well-shaped cells in this cage need at least about " +
      std::to_string(minimum) + "; ask for more, or for 0 to get the minimum");
}

std::string describe_failure(const ProcessOutcome& outcome, double time_limit) {
  switch (outcome.end) {
    case ProcessEnd::kFinished:
      break;
    case ProcessEnd::kThrew:
      return "gave up";
    case ProcessEnd::kCrashed:
      return "crashed with " + describe_signal(outcome.signal);
    case ProcessEnd::kTimedOut:
      return "was stopped at the time limit of " + format_number(time_limit) + " s (time_limit)";
  }
  return {};
}

std::string describe_thinnest(const Cage<3>& cage) {
  const auto place = thinnest_place(cage);
  const double size = bounding_box_diagonal(cage.points);
  if (place.facet < 0 || place.distance > kThin * size) return "";
  char part[32];
  std::snprintf(part, sizeof(part), "%.2g", place.distance / size);
  return "; the cage is thinnest between control point " + std::to_string(place.control_point) +
         " at " + format_point(cage.points.col(place.control_point)) + " and facet " +
         std::to_string(place.facet) + ": " + part + " of its size";
}

template <int Dim>
double total_measure(const DomainMesh<Dim>& mesh) {
  double sum = 0;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) sum += signed_measure(mesh, cell);
  return sum;
}

template <int Dim>
void finish_mesh(DomainMesh<Dim>& mesh, Index num_input_points) {
  reorder_in_space(mesh, num_input_points);
  normalize_and_validate(mesh);
  require_connected(mesh);
}

template class DecimalUnit<2>;
template class DecimalUnit<3>;
FLBC_INSTANTIATE_FUNCTION(collect_input_points)
FLBC_INSTANTIATE_FUNCTION(total_measure)
FLBC_INSTANTIATE_FUNCTION(finish_mesh)

}  // namespace flbc
