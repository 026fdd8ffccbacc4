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

std::vector<bool> are_still(const SparseWeights& weights) {
  std::vector<bool> still(static_cast<std::size_t>(weights.num_points()));
  for (Index p = 0; p < weights.num_points(); ++p) still[p] = !weights.has_weights(p);
  return still;
}

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
  if (binding.edges.ends.empty()) {
    std::cerr << "flbc: " << file
              << ": the deformation jumps where a moved facet passes through a mesh of these "
                 "points; this is not checked, because points have no edges\n";
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
  template void warn_inverted(const MovableModel<Dim>&, const PointList<Dim>&, const std::string&, \
                              const std::string&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
