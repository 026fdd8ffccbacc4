// SPDX-License-Identifier: BSD-3-Clause
// Files in every format, skins for engines, and pages.
#include <ostream>
#include <string>

#include "arrays.h"
#include "flbc/errors.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/files.h"
#include "flbc/io/formats.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "flbc/placement.h"
#include "front/model_facets.h"
#include "front/page.h"
#include "gltf/skin.h"

namespace flbc::python {
namespace {

// Missing coordinates are 0.
py::tuple read_cage(const std::string& path) {
  const auto cage = without_gil([&] { return io::to_cage(io::read_polygons(path), path); });
  return std::visit([](const auto& any) { return as_python(any); }, cage);
}

// Points (always with three coordinates), polygons, polylines.
py::tuple read_model(const std::string& path) {
  const auto soup = without_gil([&] { return io::read_polygons(path); });
  PointList<3> points(3, soup.points.size());
  for (std::size_t k = 0; k < soup.points.size(); ++k) points.col(k) = soup.points[k];
  return py::make_tuple(as_array(std::move(points)), polygons_of(soup.polygons),
                        polygons_of(soup.polylines));
}

void write_cage(const std::string& path, const Doubles& points, const Indices& facets) {
  by_dimension(points, [&](auto dim) {
    const auto cage = cage_of<decltype(dim)::value>(points, facets);
    without_gil([&] { app::write_cage(path, cage); });
  });
}

void write_model(const std::string& path, const Doubles& points, const Polygons& polygons) {
  const io::Model model{soup_of(points, polygons)};
  without_gil([&] { io::write_model(path, model); });
}

// Writes a file again with its vertices moved.
void write_moved(const std::string& path, const Doubles& points, const std::string& source) {
  by_dimension(points, [&](auto dim) {
    const auto moved = points_of<decltype(dim)::value>(points);
    without_gil([&] {
      const io::ModelFile file(source);
      if (io::extension_of(path) != io::extension_of(source))
        return io::write_model(path, file.moved(moved));
      io::write_file(path, [&](std::ostream& out) { file.write(out, moved); });
    });
  });
}

py::tuple read_mesh(const std::string& path) {
  if (io::holds(path, {io::Content::kMesh3D})) {
    return as_python(without_gil([&] { return io::read_domain<3>(path); }));
  }
  return as_python(without_gil([&] { return io::read_domain<2>(path); }));
}

void write_mesh(const std::string& path, const Doubles& vertices, const Indices& cells,
                const std::vector<std::pair<std::string, Doubles>>& fields) {
  by_dimension(vertices, [&](auto dim) {
    const auto mesh = mesh_of<decltype(dim)::value>(vertices, cells);
    std::vector<io::VertexField> all;
    for (const auto& [name, values] : fields) {
      all.push_back({name, Eigen::Map<const Eigen::VectorXd>(values.data(), values.size())});
    }
    without_gil([&] { io::write_domain(path, mesh, all); });
  });
}

py::object read_weights(const std::string& path) {
  auto weights = without_gil([&] { return io::read_weights(path); });
  if (io::extension_of(path) == "mtx") return as_python(std::move(weights));
  return as_array(without_gil([&] { return weights.dense(); }));
}

void write_weights(const std::string& path, const py::object& weights) {
  const auto given = weights_of(weights);
  without_gil([&] { io::write_weights(path, given); });
}

// ------------------------------------------------------------------------------- engines and pages

template <int Dim>
gltf::Surface surface_of(const Binding<Dim>& binding, const Polygons& polygons) {
  const io::Model model{soup_of(as_array(binding.rest()), polygons)};
  return model.soup.polygons.empty() ? gltf::Surface() : gltf::surface_of_model<Dim>(model);
}

void export_skin(const AnyBinding& any, const std::string& path, const Polygons& polygons,
                 const std::vector<double>& times, const std::vector<Doubles>& poses,
                 Index max_influences, bool rigid, const std::string& name) {
  const auto extension = io::extension_of(path);
  if (extension != "glb" && extension != "usda") {
    throw OptionError(path + ": unknown file format; the file must end in .glb or .usda");
  }
  gltf::SkinOptions options;
  options.max_influences = max_influences;
  options.rigid = rigid;
  options.name = name;
  if (extension == "usda") options.format = gltf::SkinFormat::kUsda;
  any.visit([&](const auto& binding) {
    constexpr int kDim = kDimOf<std::decay_t<decltype(binding)>>;
    const gltf::Animation<kDim> animation{times, poses_of<kDim>(poses)};
    const auto surface = surface_of<kDim>(binding, polygons);
    without_gil([&] {
      const auto skin = gltf::export_skin<kDim>(binding, surface, options, animation);
      io::write_file(path, [&](std::ostream& out) { out << skin.content; });
    });
  });
}

std::string make_page(const AnyBinding& any, const Polygons& polygons,
                      const std::vector<Doubles>& poses, const std::string& title) {
  return any.visit([&](const auto& binding) {
    constexpr int kDim = kDimOf<std::decay_t<decltype(binding)>>;
    const auto moved = poses_of<kDim>(poses);
    const auto& cage = binding.cage;
    view::PageContent<kDim> content{
        title,
        "model.obj",
        "binding.npz",
        "cage.obj",
        {cage.points, cage.facets, view::edges_of_cage<kDim>({}, cage.facets)},
        binding.rest(),
        surface_of<kDim>(binding, polygons)};
    for (std::size_t k = 0; k < moved.size(); ++k) {
      content.poses.push_back(
          {"pose " + std::to_string(k + 1), static_cast<double>(k + 1), moved[k]});
    }
    return without_gil([&] {
      content.weights = view::limit_influences(binding, view::kMostInfluences);
      return view::make_page(content);
    });
  });
}

}  // namespace

void bind_files(py::module_& module) {
  module.def("read_cage", &read_cage);
  module.def("read_model", &read_model);
  module.def("write_cage", &write_cage);
  module.def("write_model", &write_model);
  module.def("write_moved", &write_moved);
  module.def("read_mesh", &read_mesh);
  module.def("write_mesh", &write_mesh);
  module.def("read_weights", &read_weights);
  module.def("write_weights", &write_weights);
  module.def("export_skin", &export_skin);
  module.def("make_page", &make_page);
}

}  // namespace flbc::python
