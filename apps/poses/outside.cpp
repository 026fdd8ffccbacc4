// SPDX-License-Identifier: BSD-3-Clause
#include "poses/outside.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/placement.h"
#include "front/bound_model.h"
#include "front/facts.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

// Twice the area.
double area_of(const PointList<2>& points, const std::vector<Index>& polygon) {
  double area = 0;
  const Vector<2> origin = points.col(polygon.front());
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector<2> a = points.col(polygon[k]) - origin;
    const Vector<2> b = points.col(polygon[(k + 1) % polygon.size()]) - origin;
    area += a.x() * b.y() - a.y() * b.x();
  }
  return area;
}

struct CellCount {
  Index inverted = 0, all = 0;

  // By the signed volumes of a cell. Cells without a volume at rest have no orientation.
  void add(double before, double after) {
    if (before == 0) return;
    ++all;
    if (!(before > 0 ? after > 0 : after < 0)) ++inverted;
  }
};

// The number of cells between the border and the nearest vertex that a joint does not change; -1 if
// it changes all.
template <int Dim>
Index cells_of_joint(const Binding<Dim>& before, const Binding<Dim>& joined, const Joint& joint,
                     const std::vector<BorderCrossing<Dim>>& crossings) {
  const Index count = before.weights.num_points();
  std::vector<std::vector<Index>> neighbors(static_cast<std::size_t>(count));
  for (const auto& [a, b] : before.edges.ends) {
    neighbors[a].push_back(b);
    neighbors[b].push_back(a);
  }
  const auto mass = [&](Index p) {
    double sum = 0;
    before.weights.visit(p, [&](Index i, double w) {
      if (!std::binary_search(joined.held.begin(), joined.held.end(), i)) sum += w;
    });
    return sum;
  };
  std::vector<bool> is_seen(static_cast<std::size_t>(count), false);
  std::vector<Index> front, next;
  for (const auto& crossing : crossings) {
    if (!is_seen[crossing.ends[0]]) front.push_back(crossing.ends[0]);
    is_seen[crossing.ends[0]] = true;
  }
  for (Index depth = 1; !front.empty(); ++depth, front.swap(next), next.clear()) {
    for (const Index p : front) {
      if (mass(p) >= joint.mass) return depth;
      for (const Index q : neighbors[p]) {
        if (is_seen[q] || !before.weights.has_weights(q)) continue;
        is_seen[q] = true;
        next.push_back(q);
      }
    }
  }
  return -1;
}

// Prints which control points a joint holds, how many cells it spans, and the largest slope of the
// displacement at the border in the poses, before and after.
// \param before  the binding without the joint
template <int Dim>
void print_joint(const Binding<Dim>& before, const Binding<Dim>& joined, const Joint& joint,
                 const std::string& file, const std::vector<Pose<Dim>>& poses) {
  const auto rest = before.rest();
  const auto crossings = find_crossings(before.cage, rest, are_still(before.weights), before.edges);
  double slopes[2] = {0, 0};
  for (const auto& pose : poses) {
    const PointList<Dim> moved[2] = {before.deform(pose.points), joined.deform(pose.points)};
    for (const auto& crossing : crossings) {
      Vector<Dim> place = Vector<Dim>::Zero();
      for (int k = 0; k < Dim; ++k) {
        place +=
            crossing.coordinates[k] * before.cage.points.col(before.cage.facets(k, crossing.facet));
      }
      const Index inner = crossing.ends[0];
      const double distance = (rest.col(inner) - place).norm();
      if (distance <= kBoundaryTolerance * bounding_box_diagonal(before.cage.points)) continue;
      for (int k = 0; k < 2; ++k) {
        slopes[k] = std::max(slopes[k], (moved[k].col(inner) - rest.col(inner)).norm() / distance);
      }
    }
  }
  const Index band = cells_of_joint(before, joined, joint, crossings);
  Facts facts;
  facts << file << ": the joint holds control points " << app::joined(joined.held) << " and spans ";
  if (band < 0) {
    facts << "the whole mesh";
  } else {
    facts << band << (band == 1 ? " cell" : " cells");
  }
  facts << "; slope of the displacement at the border " << slopes[1]
        << " (without the joint: " << slopes[0] << ")";
  if (band >= 0 && band < 3) facts << "; fewer than 3 cells: take a larger mass, or a finer mesh";
  std::cerr << "flbc: " << facts.text() << '\n';
}

}  // namespace

template <int Dim>
Json border_json(const Binding<Dim>& binding, const std::vector<Pose<Dim>>& poses) {
  const auto& cage = binding.cage;
  const auto crossings =
      find_crossings(cage, binding.rest(), are_still(binding.weights), binding.edges);
  Json json{{"crossings", crossings.size()},
            {"control_points", control_points_at(cage, crossings)},
            {"jumps", Json::array()}};
  for (const auto& pose : poses) {
    const auto found = largest_jump<Dim>(cage, crossings, pose.points - cage.points);
    if (found.crossing < 0) break;
    json["jumps"].push_back(
        {{"pose", pose.name}, {"length", found.length}, {"edge", crossings[found.crossing].ends}});
  }
  return json;
}

template <int Dim>
void warn_border(const Binding<Dim>& binding, const std::string& file,
                 const std::vector<Pose<Dim>>& poses) {
  if (count_without_weights(binding.weights) == 0) return;
  if (binding.edges.ends.empty() && !poses.empty()) {
    std::cerr << "flbc: " << file
              << ": points have no edges, so jumps where a moved facet passes through them are "
                 "not checked; give a mesh, or keep the control points there at rest\n";
    return;
  }
  const auto border = border_json(binding, poses);
  if (border["crossings"] == 0) return;
  Facts facts;
  facts << file << " passes through the cage; the deformation ";
  if (poses.empty()) {
    facts << "is continuous there";
  } else {
    const auto& jumps = border["jumps"];
    const auto worst = std::max_element(jumps.begin(), jumps.end(),
                                        [](auto& a, auto& b) { return a["length"] < b["length"]; });
    const double length = worst == jumps.end() ? 0.0 : (*worst)["length"].template get<double>();
    if (length <= kBoundaryTolerance * bounding_box_diagonal(binding.cage.points)) return;
    facts << "jumps there by up to " << length << ", at the edge between vertices "
          << (*worst)["edge"][0] << " and " << (*worst)["edge"][1] << " in "
          << (*worst)["pose"].template get<std::string>() << "; it does not jump";
  }
  const std::vector<Index> held = border["control_points"];
  const bool are_all = static_cast<Index>(held.size()) == binding.cage.size();
  facts << " if these control points stay at rest: "
        << (are_all ? "all; the cage needs control points that no edge of the model reaches"
                    : joined(held));
  std::cerr << "flbc: " << facts.text() << '\n';
}

template <int Dim>
void join(Binding<Dim>& binding, const std::string& text, const std::string& file,
          const std::vector<Pose<Dim>>* poses) {
  if (text.empty()) return;
  const auto joint = parse_joint(text);
  auto joined = naming(file, [&] { return binding.joined(joint); });
  if (poses != nullptr) print_joint(binding, joined, joint, file, *poses);
  binding = std::move(joined);
}

template <int Dim>
void warn_inverted(const MovableModel<Dim>& model, const PointList<Dim>& posed,
                   const std::string& file, const std::string& pose) {
  CellCount count;
  const auto& mesh = model.mesh();
  if (mesh.num_cells() > 0) {
    const DomainMesh<Dim> moved{posed, mesh.cells};
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      count.add(signed_measure(mesh, s), signed_measure(moved, s));
    }
  }
  if constexpr (Dim == 2) {
    const std::vector<std::vector<Index>> none;
    for (const auto& polygon : model.model() ? model.model()->soup.polygons : none) {
      count.add(area_of(model.points(), polygon), area_of(posed, polygon));
    }
  }
  if (count.inverted == 0) return;
  std::cerr << "flbc: " << file << ": " << count.inverted << " of " << count.all
            << " cells are inverted in " << pose << '\n';
}

#define FLBC_INSTANTIATE(Dim)                                                                      \
  template void warn_border(const Binding<Dim>&, const std::string&,                               \
                            const std::vector<Pose<Dim>>&);                                        \
  template Json border_json(const Binding<Dim>&, const std::vector<Pose<Dim>>&);                   \
  template void join(Binding<Dim>&, const std::string&, const std::string&,                        \
                     const std::vector<Pose<Dim>>*);                                               \
  template void warn_inverted(const MovableModel<Dim>&, const PointList<Dim>&, const std::string&, \
                              const std::string&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
