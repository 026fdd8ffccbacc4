// SPDX-License-Identifier: BSD-3-Clause
#include "poses/outside.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/placement.h"
#include "front/facts.h"

namespace flbc::app {
namespace {

// \param all  the number of control points
std::string list(const std::vector<Index>& numbers, Index all) {
  if (static_cast<Index>(numbers.size()) == all) {
    return "all; the cage needs control points that no edge of the model reaches";
  }
  std::string text;
  for (const Index number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text;
}

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
Border<Dim>::Border(const Binding<Dim>& binding)
    : cage_(binding.cage),
      crossings_(find_crossings(cage_, binding.rest(), are_still(binding.weights), binding.edges)) {
}

template <int Dim>
void warn_border(const Binding<Dim>& binding, const std::string& file,
                 const std::vector<Pose<Dim>>& poses) {
  const auto still = are_still(binding.weights);
  if (std::find(still.begin(), still.end(), true) == still.end()) return;
  if (binding.edges.ends.empty()) {
    std::cerr << "flbc: " << file
              << ": the deformation jumps where a moved facet passes through a mesh of these "
                 "points; this is not checked, because points have no edges\n";
    return;
  }
  const auto text = Border<Dim>(binding).describe(poses);
  if (!text.empty()) std::cerr << "flbc: " << file << ' ' << text << '\n';
}

template <int Dim>
BorderJump Border<Dim>::jump(const Pose<Dim>& pose) const {
  return largest_jump<Dim>(cage_, crossings_, pose.points - cage_.points);
}

template <int Dim>
std::string Border<Dim>::describe(const std::vector<Pose<Dim>>& poses) const {
  if (is_empty()) return "";
  const auto held = list(control_points_at(cage_, crossings_), cage_.size());
  if (poses.empty()) {
    return "passes through the cage; the deformation is continuous there if these control points "
           "stay at rest: " +
           held;
  }
  BorderJump largest;
  const Pose<Dim>* worst = nullptr;
  for (const auto& pose : poses) {
    const auto found = jump(pose);
    if (worst && found.length <= largest.length) continue;
    largest = found;
    worst = &pose;
  }
  if (largest.length <= kBoundaryTolerance * bounding_box_diagonal(cage_.points)) return "";
  const auto& ends = crossings_[largest.crossing].ends;
  Facts facts;
  facts << "passes through the cage; the deformation jumps there by up to " << largest.length
        << ", at the edge between vertices " << ends[0] << " and " << ends[1] << " in "
        << worst->name << "; it does not jump if these control points stay at rest: " << held;
  return facts.text();
}

template <int Dim>
nlohmann::ordered_json Border<Dim>::json(const std::vector<Pose<Dim>>& poses) const {
  nlohmann::ordered_json json{{"crossings", crossings_.size()},
                              {"control_points", control_points_at(cage_, crossings_)},
                              {"jumps", nlohmann::ordered_json::array()}};
  for (const auto& pose : poses) {
    const auto found = jump(pose);
    if (found.crossing < 0) break;
    json["jumps"].push_back(
        {{"pose", pose.name}, {"length", found.length}, {"edge", crossings_[found.crossing].ends}});
  }
  return json;
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
  template class Border<Dim>;                                                                      \
  template void warn_inverted(const MovableModel<Dim>&, const PointList<Dim>&, const std::string&, \
                              const std::string&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
