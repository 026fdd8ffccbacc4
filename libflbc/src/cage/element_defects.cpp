// SPDX-License-Identifier: BSD-3-Clause
// Checks of control points and facets taken by themselves.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include <Eigen/Geometry>

#include "base/messages.h"
#include "cage/cage_defects.h"
#include "cage/close_points.h"
#include "flbc/bounding_box.h"
#include "linear/dense.h"

namespace flbc {

namespace {

// Below this part of the cage's size a length counts as zero.
constexpr double kRelativeTolerance = 1e-10;

// Meshers multiply up to five lengths, which must stay within the range of numbers.
constexpr double kSmallestSize = 1e-30;
constexpr double kLargestSize = 1e30;
// Beyond this many times its size from the origin, a cage's coordinates have too few digits left.
constexpr double kFarthest = 1e9;

template <int Dim>
std::string facet_name() {
  return Dim == 2 ? "edge" : "triangle";
}

template <int Dim>
void check_counts(const Cage<Dim>& cage, DefectList& found) {
  const std::string least = std::to_string(Dim + 1);
  if (cage.size() < Dim + 1) {
    found.add({"the cage has " + std::to_string(cage.size()) +
               " control points; it takes at least " + least + " to enclose anything"});
  }
  if (cage.facets.cols() < Dim + 1) {
    found.add({"the cage has " + std::to_string(cage.facets.cols()) + " " + facet_name<Dim>() +
               "s; it takes at least " + least + " to enclose anything"});
  }
}

template <int Dim>
void check_finiteness(const Cage<Dim>& cage, DefectList& found) {
  for (Index vertex = 0; vertex < cage.size() && !found.is_full(); ++vertex) {
    if (cage.points.col(vertex).allFinite()) continue;
    found.add({describe_control_point<Dim>(cage.points, vertex) + " is not finite", {vertex}});
  }
}

template <int Dim>
void check_extent(const Cage<Dim>& cage, DefectList& found) {
  if (cage.size() == 0 || !cage.points.allFinite()) return;
  const double size = bounding_box_diagonal<Dim>(cage.points);
  if (size > 0 && !(size >= kSmallestSize && size <= kLargestSize)) {
    found.add({"the cage's size of " + format_number(size) + " is out of range; it must be from " +
               format_number(kSmallestSize) + " to " + format_number(kLargestSize) +
               "; use another unit of length"});
  } else if (cage.points.cwiseAbs().maxCoeff() > kFarthest * size && size > 0) {
    found.add({"the cage lies too far from the origin for its size of " + format_number(size) +
                   ", with " + describe_control_point<Dim>(cage.points, 0) +
                   ": its coordinates have too few digits; move it to the origin"});
  }
}

template <int Dim>
void check_indices(const Cage<Dim>& cage, DefectList& found) {
  for (Index facet = 0; facet < cage.facets.cols() && !found.is_full(); ++facet) {
    const std::string name = facet_name<Dim>() + " " + std::to_string(facet);
    for (int k = 0; k < Dim; ++k) {
      const Index vertex = cage.facets(k, facet);
      if (vertex < 0 || vertex >= cage.size()) {
        found.add({name + " names control point " + std::to_string(vertex) +
                       ", but the cage's are numbered from 0 to " + std::to_string(cage.size() - 1),
                   {},
                   {facet}});
        break;
      }
      if (vertex == cage.facets((k + 1) % Dim, facet)) {
        found.add({name + " names " + describe_control_point<Dim>(cage.points, vertex) + " twice",
                   {vertex},
                   {facet}});
        break;
      }
    }
  }
}

template <int Dim>
void check_coincidence(const Cage<Dim>& cage, DefectList& found) {
  const double tolerance = kRelativeTolerance * bounding_box_diagonal<Dim>(cage.points);
  for (const auto& pair : find_close_pairs<Dim>(cage.points, tolerance, cage.size())) {
    if (found.is_full()) return;
    found.add({"control points " + std::to_string(pair[0]) + " and " + std::to_string(pair[1]) +
                   " coincide at " + format_point(cage.points.col(pair[0])) +
                   ": the cage is not welded there; merge them into one",
               {pair[0], pair[1]}});
  }
}

template <int Dim>
void check_references(const Cage<Dim>& cage, DefectList& found) {
  std::vector<bool> is_used(static_cast<std::size_t>(cage.size()), false);
  for (Index facet = 0; facet < cage.facets.cols(); ++facet) {
    for (int k = 0; k < Dim; ++k) is_used[cage.facets(k, facet)] = true;
  }
  for (Index vertex = 0; vertex < cage.size() && !found.is_full(); ++vertex) {
    if (is_used[vertex]) continue;
    found.add({describe_control_point<Dim>(cage.points, vertex) + " belongs to no " +
                   facet_name<Dim>() + "; remove it or connect it",
               {vertex}});
  }
}

// A cage with an open slit may pass all checks of elements and still enclose nothing.
template <int Dim>
void check_flatness(const Cage<Dim>& cage, DefectList& found) {
  const PointList<Dim> centred = cage.points.colwise() - cage.points.rowwise().mean().eval();
  const double thickness = dense::least_pivot(centred.transpose()) / std::sqrt(double(cage.size()));
  if (thickness > kRelativeTolerance * bounding_box_diagonal<Dim>(cage.points)) return;
  found.add({std::string("all control points lie in one ") + (Dim == 2 ? "line" : "plane") +
             ", so the cage encloses nothing"});
}

// The smallest altitude, which is the length of an edge in 2D.
template <int Dim>
double smallest_altitude(const Cage<Dim>& cage, Index facet) {
  const Vector<Dim> a = cage.points.col(cage.facets(0, facet));
  const Vector<Dim> b = cage.points.col(cage.facets(1, facet));
  if constexpr (Dim == 2) {
    return (b - a).norm();
  } else {
    const Vector<3> c = cage.points.col(cage.facets(2, facet));
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0.0;
  }
}

template <int Dim>
void check_measures(const Cage<Dim>& cage, DefectList& found) {
  const double tolerance = kRelativeTolerance * bounding_box_diagonal<Dim>(cage.points);
  for (Index facet = 0; facet < cage.facets.cols() && !found.is_full(); ++facet) {
    if (smallest_altitude(cage, facet) > tolerance) continue;
    const auto corners = cage.facets.col(facet);
    std::string text = facet_name<Dim>() + " " + std::to_string(facet) +
                       (Dim == 2 ? " has no length: it joins " : " is degenerate: its corners, ");
    for (int k = 0; k < Dim; ++k) {
      if (k > 0) text += k + 1 < Dim ? ", " : " and ";
      text += describe_control_point<Dim>(cage.points, corners(k));
    }
    if (Dim == 3) text += ", lie on one line";
    found.add({text, std::vector<Index>(corners.data(), corners.data() + Dim), {facet}});
  }
}

template <int Dim>
void check_repetition(const Cage<Dim>& cage, DefectList& found) {
  std::map<std::array<Index, Dim>, Index> first_with;
  for (Index facet = 0; facet < cage.facets.cols() && !found.is_full(); ++facet) {
    std::array<Index, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners[k] = cage.facets(k, facet);
    std::sort(corners.begin(), corners.end());
    const auto [entry, is_new] = first_with.emplace(corners, facet);
    if (is_new) continue;
    const std::vector<Index> vertices(corners.begin(), corners.end());
    found.add({facet_name<Dim>() + "s " + std::to_string(entry->second) + " and " +
                   std::to_string(facet) + " are the same: both join control points " +
                   describe_list(vertices) + ", the first of them at " +
                   format_point(cage.points.col(vertices[0])),
               vertices,
               {entry->second, facet}});
  }
}

}  // namespace

template <int Dim>
void check_numbers(const Cage<Dim>& cage, DefectList& found) {
  check_counts(cage, found);
  check_finiteness(cage, found);
  check_extent(cage, found);
  check_indices(cage, found);
}

template <int Dim>
void check_points(const Cage<Dim>& cage, DefectList& found) {
  check_coincidence(cage, found);
  check_references(cage, found);
  check_flatness(cage, found);
}

template <int Dim>
void check_facets(const Cage<Dim>& cage, DefectList& found) {
  check_measures(cage, found);
  check_repetition(cage, found);
}

template void check_numbers<2>(const Cage<2>&, DefectList&);
template void check_numbers<3>(const Cage<3>&, DefectList&);
template void check_points<2>(const Cage<2>&, DefectList&);
template void check_points<3>(const Cage<3>&, DefectList&);
template void check_facets<2>(const Cage<2>&, DefectList&);
template void check_facets<3>(const Cage<3>&, DefectList&);

}  // namespace flbc
