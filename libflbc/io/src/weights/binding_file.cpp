// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/binding_file.h"

#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <utility>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/report.h"
#include "flbc/version.h"
#include "weights/npz.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

void add_weights(NpzWriter& file, const std::string& prefix, const SparseWeights& weights) {
  file.add_list(prefix + "indptr", weights.starts());
  const auto count = static_cast<std::int64_t>(weights.values().size());
  // Below 2^31: NumPy and SciPy prefer signed numbers.
  file.add(prefix + "indices",
           reinterpret_cast<const std::int32_t*>(weights.control_points().data()), {count});
  file.add_list(prefix + "data", weights.values());
}

// A matrix as scipy.sparse.load_npz() reads it.
void add_matrix(NpzWriter& file, const SparseWeights& weights) {
  file.add_text("format", "csr");
  const std::int64_t shape[] = {weights.num_points(), weights.num_control_points()};
  file.add("shape", shape, {2});
  add_weights(file, "", weights);
}

SparseWeights weights_in(const NpzReader& file, const std::string& prefix, Index control_points) {
  const auto columns = file.numbers<std::int32_t>(prefix + "indices");
  try {
    return {control_points,
            file.numbers<std::int64_t>(prefix + "indptr"),
            {columns.begin(), columns.end()},
            file.numbers<double>(prefix + "data")};
  } catch (const InputError& error) {
    file.fail(std::string(error.what()));
  }
}

Index control_points_in(const NpzReader& file) {
  const auto shape = file.numbers<std::int64_t>("shape");
  if (shape.size() != 2 || shape[1] < 0 || shape[1] > std::numeric_limits<Index>::max()) {
    file.fail("the shape is not that of weights");
  }
  return static_cast<Index>(shape[1]);
}

void add_masks(NpzWriter& file, const std::string& name, const std::vector<Mask>& masks) {
  std::vector<std::int32_t> sizes, control_points, points;
  for (const auto& mask : masks) {
    sizes.push_back(static_cast<std::int32_t>(mask.control_points.size()));
    sizes.push_back(static_cast<std::int32_t>(mask.points.size()));
    control_points.insert(control_points.end(), mask.control_points.begin(),
                          mask.control_points.end());
    points.insert(points.end(), mask.points.begin(), mask.points.end());
  }
  file.add(name + "_sizes", sizes.data(), {static_cast<std::int64_t>(masks.size()), 2});
  file.add_list(name + "_control_points", control_points);
  file.add_list(name + "_points", points);
}

std::vector<Mask> masks_in(const NpzReader& file, const std::string& name) {
  const auto sizes = file.numbers<std::int32_t>(name + "_sizes", 2);
  const auto control_points = file.numbers<std::int32_t>(name + "_control_points");
  const auto points = file.numbers<std::int32_t>(name + "_points");
  std::vector<Mask> masks;
  std::size_t i = 0, p = 0;
  for (std::size_t k = 0; k + 1 < sizes.size(); k += 2) {
    const auto n = static_cast<std::size_t>(std::max(sizes[k], 0)),
               m = static_cast<std::size_t>(std::max(sizes[k + 1], 0));
    if (n > control_points.size() - i || m > points.size() - p) file.fail("masks end early");
    masks.push_back({{control_points.begin() + i, control_points.begin() + i + n},
                     {points.begin() + p, points.begin() + p + m}});
    i += n;
    p += m;
  }
  return masks;
}

template <int Dim>
Binding<Dim> read(const NpzReader& file, const nlohmann::json& info) {
  Binding<Dim> binding;
  binding.cage.points = file.columns<PointList<Dim>>("cage");
  binding.cage.facets = file.columns<FacetList<Dim>>("facets");
  const auto n = control_points_in(file);
  binding.weights = weights_in(file, "", n);
  binding.points = file.columns<PointList<Dim>>("points");
  binding.offsets = file.columns<PointList<Dim>>("offsets");
  const auto ends = file.columns<FacetList<2>>("edges");
  for (const auto& edge : ends.colwise()) binding.edges.ends.push_back({edge[0], edge[1]});
  binding.edges.weights = file.numbers<double>("edge_weights");
  binding.masks = masks_in(file, "mask");
  if (file.has("solid_sizes")) {
    for (auto& region : masks_in(file, "solid")) binding.solid.push_back(region.points);
  }
  binding.outside = file.numbers<std::int32_t>("outside");
  if (file.has("held")) binding.held = file.numbers<std::int32_t>("held");
  if (file.has("mirror_images")) {
    binding.mirror = {info.at("mirror_axis").get<int>(),
                      file.numbers<std::int32_t>("mirror_images"),
                      file.numbers<std::int32_t>("mirror_partners")};
  }
  if (file.has("domain")) {
    binding.domain = {file.columns<PointList<Dim>>("domain"), file.columns<CellList<Dim>>("cells")};
    binding.domain_weights = weights_in(file, "domain_", n);
  }
  if (const auto policy = value_named<OutsidePoints>(info.at("outside").get<std::string>())) {
    binding.policy = *policy;
  }
  auto& report = binding.report;
  report.method = info.at("method").get<std::string>();
  report.options = info.at("options").get<std::string>();
  report.mesher = info.at("mesher").get<std::string>();
  report.note = info.at("note").get<std::string>();
  report.solve.iterations = info.at("iterations").get<int>();
  report.outside = static_cast<Index>(binding.outside.size());
  if (const auto status = value_named<SolveStatus>(info.at("status").get<std::string>())) {
    report.solve.status = *status;
  }
  if (const auto method = value_named<Method>(report.method)) report.solve.method = *method;
  validate(binding);
  return binding;
}

template <int Dim>
void write(const std::string& path, std::ostream& out, const Binding<Dim>& binding) {
  check_finite(binding.weights);
  const auto& report = binding.report;
  nlohmann::ordered_json info{{"flbc", FLBC_VERSION},
                              {"dim", Dim},
                              {"outside", name_of(binding.policy)},
                              {"method", report.method},
                              {"options", report.options},
                              {"status", name_of(report.solve.status)},
                              {"iterations", report.solve.iterations},
                              {"mesher", report.mesher},
                              {"note", report.note}};
  NpzWriter file(path, out);
  add_matrix(file, binding.weights);
  file.add_columns("cage", binding.cage.points);
  file.add_columns("facets", binding.cage.facets);
  file.add_columns("points", binding.points);
  file.add_columns("offsets", binding.offsets);
  const auto& ends = binding.edges.ends;
  file.add("edges", ends.empty() ? nullptr : ends.front().data(),
           {static_cast<std::int64_t>(ends.size()), 2});
  file.add_list("edge_weights", binding.edges.weights);
  add_masks(file, "mask", binding.masks);
  if (!binding.solid.empty()) {
    std::vector<Mask> solid;
    for (const auto& region : binding.solid) solid.push_back({{}, region});
    add_masks(file, "solid", solid);
  }
  file.add_list("outside", binding.outside);
  if (!binding.held.empty()) file.add_list("held", binding.held);
  if (binding.mirror) {
    info["mirror_axis"] = binding.mirror->axis;
    file.add_list("mirror_images", binding.mirror->images);
    file.add_list("mirror_partners", binding.mirror->partners);
  }
  if (binding.domain.num_cells() > 0) {
    file.add_columns("domain", binding.domain.points);
    file.add_columns("cells", binding.domain.cells);
    add_weights(file, "domain_", binding.domain_weights);
  }
  file.add_text("info", info.dump());
  file.finish();
}

AnyBinding read(const NpzReader& file) {
  if (!file.has("info")) {
    file.fail("has weights alone, not a binding; make one by flbc run, or by flbc solve --model");
  }
  try {
    const auto info = nlohmann::json::parse(file.text("info"));
    return info.at("dim").get<int>() == 2 ? AnyBinding(read<2>(file, info))
                                          : AnyBinding(read<3>(file, info));
  } catch (const nlohmann::json::exception&) {
    file.fail("the array 'info' is damaged");
  }
}

}  // namespace

bool is_binding_file(const std::string& path) {
  return extension_of(path) == "npz";
}

template <int Dim>
void write_binding(const std::string& path, const Binding<Dim>& binding) {
  write_file(path, [&](std::ostream& out) { write(path, out, binding); });
}

template <int Dim>
std::string encode_binding(const Binding<Dim>& binding) {
  std::ostringstream out;
  write("the binding", out, binding);
  return out.str();
}

AnyBinding read_binding(const std::string& path) {
  return read(NpzReader(path));
}

AnyBinding decode_binding(std::string content) {
  return read(NpzReader("the binding", std::move(content)));
}

SparseWeights read_npz(const std::string& path, std::string) {
  const NpzReader file(path);
  if (!file.has("indptr") || !file.has("shape")) {
    file.fail("has no sparse matrix; scipy.sparse.save_npz(..., compressed=False) writes one");
  }
  return weights_in(file, "", control_points_in(file));
}

void write_npz(std::ostream& out, const SparseWeights& weights) {
  NpzWriter file("the weights", out);
  add_matrix(file, weights);
  file.finish();
}

template void write_binding(const std::string&, const Binding<2>&);
template void write_binding(const std::string&, const Binding<3>&);
template std::string encode_binding(const Binding<2>&);
template std::string encode_binding(const Binding<3>&);

}  // namespace flbc::io
