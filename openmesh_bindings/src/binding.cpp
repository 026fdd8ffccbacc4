// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/binding.h"

#include <limits>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "flbc/deform.h"

namespace flbc::openmesh::internal {
namespace {

// The offset that marks a vertex as outside although nothing is to be added to it.
constexpr double kMark = std::numeric_limits<double>::denorm_min();

void require(bool is_sound, const char* property) {
  if (is_sound) return;
  throw InputError("the " + std::string(property) +
                   " of the weights do not match the mesh; bind the mesh again");
}

// -1: no index.
Index to_index(double number) {
  const bool is_index = number >= 0 && number < (std::numeric_limits<Index>::max)();
  return is_index ? static_cast<Index>(number) : -1;
}

std::optional<Mirror> mirror_in(const BindingRows& rows) {
  if (rows.partners.size() == 0 || rows.mirror.size() == 0) return std::nullopt;
  require(rows.partners.element_size() == 2 && rows.mirror.element_size() > 0, "mirror images");
  const auto row = rows.mirror[0];
  Mirror mirror{to_index(row[0])};
  for (std::size_t i = 1; i < row.width(); ++i) mirror.images.push_back(to_index(row[i]));
  // OpenMesh renumbers vertices.
  std::unordered_map<Index, Index> vertices;
  for (std::size_t v = 0; v < rows.partners.size(); ++v) {
    const Index number = to_index(rows.partners[v][0]);
    if (number > 0) vertices.emplace(number, static_cast<Index>(v));
  }
  for (std::size_t v = 0; v < rows.partners.size(); ++v) {
    const auto found = vertices.find(to_index(rows.partners[v][1]));
    mirror.partners.push_back(found == vertices.end() ? -1 : found->second);
  }
  return mirror;
}

}  // namespace

void refuse_rest_cage(std::size_t dimension, const std::string& weights) {
  if (dimension == 0) {
    throw InputError("the mesh does not know the cage of its weights '" + weights +
                     "'; call sparsify(mesh, cage, k), or set_rest_cage() first");
  }
  throw InputError("the cage of the weights '" + weights + "' has " + std::to_string(dimension) +
                   " dimensions, but the mesh or the poses do not");
}

RowBlock<double> zeros(std::size_t elements, std::size_t components, std::size_t width) {
  RowBlock<double> rows(components, width);
  rows.resize(elements);
  return rows;
}

std::vector<Mask> masks_in(const BindingRows& rows) {
  if (rows.kinds.size() == 0 || rows.masks.size() == 0) return {};
  require(rows.kinds.element_size() == 1, "masks");
  const auto table = rows.masks[0];
  std::vector<Mask> masks(table.components());
  for (std::size_t k = 0; k < masks.size(); ++k) {
    for (std::size_t i = 0; i < table.width(); ++i) {
      if (table(k, i) != 0) masks[k].control_points.push_back(static_cast<Index>(i));
    }
  }
  for (std::size_t v = 0; v < rows.kinds.size(); ++v) {
    const Index kind = to_index(rows.kinds[v][0]);
    require(kind >= 0 && kind <= static_cast<Index>(masks.size()), "masks");
    if (kind > 0) masks[kind - 1].points.push_back(static_cast<Index>(v));
  }
  return masks;
}

void set_masks(BindingRows& rows, const std::vector<Mask>& masks, Index n, Index count) {
  const auto kinds = PointMasks(masks, n, count).list([](Index) { return true; });
  if (kinds.empty()) return;
  rows.kinds = zeros(static_cast<std::size_t>(count), 1, 1);
  rows.masks = zeros(1, kinds.size(), static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    for (const Index i : kinds[k].control_points) rows.masks[0](k, i) = 1;
    for (const Index v : kinds[k].points) rows.kinds[v][0] = static_cast<double>(k + 1);
  }
}

template <int Dim>
BindingRows rows_of(const Binding<Dim>& binding) {
  const auto& [cage, weights] = std::tie(binding.cage, binding.weights);
  const auto count = static_cast<std::size_t>(weights.num_points());
  if (!binding.solid.empty()) {
    throw InputError("solid regions cannot be stored in a mesh; use flbc::Binding and flbc::Rig");
  }
  BindingRows rows;
  rows.cage = zeros(1, static_cast<std::size_t>(cage.size()), Dim);
  rows.cage[0].matrix() = cage.points.transpose();
  if (!binding.outside.empty()) rows.offsets = zeros(count, 1, Dim);
  if (!binding.held.empty()) {
    // Weights of a joint do not reproduce vertices inside, either.
    rows.held = zeros(1, 1, static_cast<std::size_t>(cage.size()));
    for (const Index i : binding.held) rows.held[0][static_cast<std::size_t>(i)] = 1;
    for (std::size_t v = 0; v < count; ++v) {
      rows.offsets[v].matrix() = binding.offsets.col(static_cast<Index>(v)).transpose();
    }
  }
  for (const Index v : binding.outside) {
    const auto offset = rows.offsets[static_cast<std::size_t>(v)];
    if (binding.offsets.cols() > 0) offset.matrix() = binding.offsets.col(v).transpose();
    if (offset.matrix().isZero(0)) offset[0] = kMark;
  }
  set_masks(rows, binding.masks, cage.size(), weights.num_points());
  if (!binding.mirror) return rows;
  rows.partners = zeros(count, 1, 2);
  for (std::size_t v = 0; v < count; ++v) {
    rows.partners[v][0] = static_cast<double>(v + 1);
    rows.partners[v][1] = binding.mirror->partners[v] + 1;
  }
  rows.mirror = zeros(1, 1, 1 + binding.mirror->images.size());
  rows.mirror[0][0] = binding.mirror->axis;
  std::copy(binding.mirror->images.begin(), binding.mirror->images.end(), rows.mirror.data() + 1);
  return rows;
}

template <int Dim>
Binding<Dim> binding_from(SparseWeights weights, const BindingRows& rows,
                          const RowBlock<double>& positions, const std::string& name) {
  if (rows.cage.width() != Dim) refuse_rest_cage(rows.cage.width(), name);
  Binding<Dim> binding;
  binding.cage.points = rows.cage[0].matrix().transpose();
  require_control_points(static_cast<std::size_t>(weights.num_control_points()),
                         binding.cage.points.cols());
  binding.points = flbc::deform<Dim>(weights, binding.cage.points);
  const bool has_offsets = rows.offsets.size() > 0;
  for (std::size_t i = 0; rows.held.size() > 0 && i < rows.held.width(); ++i) {
    if (rows.held[0][i] != 0) binding.held.push_back(static_cast<Index>(i));
  }
  if (has_offsets) {
    require(rows.offsets.element_size() == Dim && rows.offsets.size() == positions.size(),
            "offsets");
    binding.offsets =
        Eigen::Map<const PointList<Dim>>(rows.offsets.data(), Dim, binding.points.cols());
  }
  for (Index v = 0; v < weights.num_points(); ++v) {
    const bool is_outside = has_offsets && !binding.offsets.col(v).isZero(0);
    const bool stays = !weights.has_weights(v);
    if (stays) {
      for (int d = 0; d < Dim; ++d) {
        binding.points(d, v) =
            is_outside ? binding.offsets(d, v)
                       : positions[static_cast<std::size_t>(v)][static_cast<std::size_t>(d)];
      }
    }
    if (!is_outside || (!stays && !binding.held.empty())) continue;
    binding.outside.push_back(v);
    const bool is_marked = binding.offsets.col(v).cwiseAbs().maxCoeff() <= kMark;
    binding.policy = stays       ? OutsidePoints::kKeep
                     : is_marked ? OutsidePoints::kExtend
                                 : OutsidePoints::kNearest;
  }
  binding.weights = std::move(weights);
  binding.masks = masks_in(rows);
  binding.mirror = mirror_in(rows);
  validate(binding);
  return binding;
}

#define FLBC_INSTANTIATE(Dim)                                                                    \
  template BindingRows rows_of(const Binding<Dim>&);                                             \
  template Binding<Dim> binding_from(SparseWeights, const BindingRows&, const RowBlock<double>&, \
                                     const std::string&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::openmesh::internal
