// SPDX-License-Identifier: BSD-3-Clause
// Bindings: the methods of flbc::Binding for arrays, and their files.
#include "flbc/binding.h"

#include <array>
#include <optional>
#include <string>

#include "arrays.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/io/binding_file.h"
#include "front/model_facets.h"
#include "model/bitmap.h"
#include "model/svg_document.h"
#include "options.h"

namespace flbc::python {
namespace {

template <class Action>
AnyBinding changed(const AnyBinding& binding, const Action& action) {
  return binding.visit([&](const auto& known) {
    constexpr int kDim = kDimOf<std::decay_t<decltype(known)>>;
    return AnyBinding{action(known, std::integral_constant<int, kDim>())};
  });
}

AnyBinding bound_by(const Doubles& cage_points, const Indices& facets, const Doubles& points,
                    const py::object& weights, const Polygons& polygons, const MaskLists& masks) {
  return by_dimension(cage_points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const auto all = points_of<kDim>(points);
    return AnyBinding{flbc::bound_by<kDim>(cage_of<kDim>(cage_points, facets), all,
                                           weights_of(weights), edges_of(all, polygons),
                                           masks_of(masks))};
  });
}

// The arrays of a binding, by name; those of its weights belong to it.
py::dict arrays(const py::object& self) {
  using namespace py::literals;
  return self.cast<const AnyBinding&>().visit([&](const auto& binding) {
    py::list masks;
    for (const auto& mask : binding.masks) {
      masks.append(py::make_tuple(as_array(mask.control_points), as_array(mask.points)));
    }
    py::list solid;
    for (const auto& region : binding.solid) solid.append(as_array(region));
    py::dict dict("solid"_a = solid, "cage"_a = as_python(binding.cage),
                  "weights"_a = view_of(binding.weights, self),
                  "points"_a = as_array(binding.rest()), "offsets"_a = py::none(),
                  "outside"_a = as_array(binding.outside), "masks"_a = masks,
                  "held"_a = as_array(binding.held), "report"_a = as_dict(binding.report),
                  "domain"_a = py::none());
    if (binding.offsets.cols() > 0) dict["offsets"] = view_of(binding.offsets, self);
    if (binding.domain.num_cells() > 0) {
      dict["domain"] =
          py::make_tuple(view_of(binding.domain.points, self), view_of(binding.domain.cells, self));
      dict["domain_weights"] = view_of(binding.domain_weights, self);
      dict["proof"] = as_python(binding.report.solve.certificate.proof);
    }
    return dict;
  });
}

// \param moved  P x d, receives the points
void deform_into(const AnyBinding& self, const Doubles& control_points, Doubles moved) {
  self.visit([&](const auto& binding) {
    constexpr int kDim = kDimOf<std::decay_t<decltype(binding)>>;
    const auto pose = points_of<kDim>(control_points);
    Eigen::Map<PointList<kDim>> points(moved.mutable_data(), kDim, moved.shape(0));
    return without_gil([&] { return binding.deform_into(pose, points); });
  });
}

// The Jacobian of each point, column by column.
py::array jacobians(const AnyBinding& self, const Doubles& control_points) {
  return self.visit([&](const auto& binding) {
    const auto pose = points_of<kDimOf<std::decay_t<decltype(binding)>>>(control_points);
    return as_array(without_gil([&] { return binding.jacobians(pose); }));
  });
}

AnyBinding reduced(const AnyBinding& self, Index most, double threshold,
                   const std::vector<Doubles>& poses) {
  SparsifyOptions limits;
  limits.max_influences = most;
  limits.threshold = threshold;
  limits.progress = [poll = interruption()](double) { poll(); };
  return changed(self, [&](const auto& binding, auto dim) {
    const auto moved = poses_of<decltype(dim)::value>(poses);
    return without_gil([&] { return binding.reduced(limits, moved); });
  });
}

// \param from  polygons of this model; none: by the domain mesh
AnyBinding transferred(const AnyBinding& self, const Doubles& points, const Polygons& polygons,
                       const std::string& outside, const std::optional<Polygons>& from,
                       double limit) {
  const auto policy = named<OutsidePoints>("outside", outside);
  return changed(self, [&](const auto& binding, auto dim) {
    const auto to = points_of<decltype(dim)::value>(points);
    const auto edges = edges_of(to, polygons);
    FacetList<3> elements;
    if (from) elements = app::elements_of(soup_of(as_array(binding.rest()), *from));
    return without_gil([&] {
      return from ? binding.transferred(elements, to, edges, limit)
                  : binding.transferred(to, edges, policy);
    });
  });
}

AnyBinding composed(const AnyBinding& self, const py::object& map, const Doubles& points,
                    const Indices& facets) {
  const auto shares = weights_of(map);
  return changed(self, [&](const auto& binding, auto dim) {
    auto outer = cage_of<decltype(dim)::value>(points, facets);
    return without_gil([&] { return binding.composed(shares, std::move(outer)); });
  });
}

py::object skin(const AnyBinding& self, const py::object& bones, Index most) {
  const auto shares = weights_of(bones);
  return self.visit([&](const auto& binding) {
    return as_python(without_gil([&] { return flbc::skin(binding.weights, shares, most); }));
  });
}

AnyBinding joined(const AnyBinding& self, const std::string& joint) {
  return changed(self,
                 [&](const auto& binding, auto) { return binding.joined(parse_joint(joint)); });
}

py::array adjoint(const AnyBinding& self, const Doubles& gradients) {
  return self.visit([&](const auto& binding) {
    const auto columns = points_of<kDimOf<std::decay_t<decltype(binding)>>>(gradients);
    return as_array(without_gil([&] { return binding.adjoint(columns); }));
  });
}

// The control points, and numbers by name.
py::tuple fit(const AnyBinding& self, const Doubles& targets, std::vector<Index> points,
              std::vector<Index> held, double stiffness) {
  using namespace py::literals;
  const FitOptions options{std::move(points), std::move(held), stiffness};
  return self.visit([&](const auto& binding) {
    const auto columns = points_of<kDimOf<std::decay_t<decltype(binding)>>>(targets);
    const auto found = without_gil([&] { return binding.fit(columns, options); });
    return py::make_tuple(as_array(found.control_points),
                          py::dict("rms"_a = found.rms, "largest"_a = found.largest,
                                   "worst"_a = found.worst, "condition"_a = found.condition));
  });
}

const Binding<2>& in_plane(const AnyBinding& self) {
  if (const auto* binding = std::get_if<Binding<2>>(&self.value)) return *binding;
  throw InputError("drawings and pictures need a binding in 2D, but this one is in 3D");
}

// The moved drawing, and what does not bend.
py::tuple deform_drawing(const AnyBinding& self, const std::string& svg, const Doubles& pose) {
  const auto& binding = in_plane(self);
  const auto points = points_of<2>(pose);
  std::vector<std::string> notes;
  const auto moved = without_gil([&] {
    const auto drawing = io::drawing_of(svg, "svg");
    notes = drawing.notes();
    return drawing.moved(binding.deform(points, drawing.points(), OutsidePoints::kKeep));
  });
  return py::make_tuple(moved, notes);
}

// The moved picture, and its place. \param size  in units of the model
template <class Sample>
py::tuple deform_picture(const AnyBinding& self,
                         const py::array_t<Sample, py::array::c_style>& picture,
                         const Doubles& pose, double scale, const std::array<double, 2>& size) {
  const auto& binding = in_plane(self);
  const auto extent = [&](int axis) { return static_cast<Index>(picture.shape(axis)); };
  using Samples = std::vector<Sample>;
  const io::Bitmap bitmap{extent(1), extent(0), static_cast<int>(extent(2)),
                          Samples(picture.data(), picture.data() + picture.size())};
  io::Bitmap moved;
  without_gil([&, points = points_of<2>(pose)] {
    return io::warp(bitmap, binding, {points}, scale, {size[0], size[1]},
                    [&](std::size_t, io::Bitmap result) { moved = std::move(result); });
  });
  const std::vector<py::ssize_t> shape{moved.height, moved.width, moved.channels};
  return py::make_tuple(py::array_t<Sample>(shape, std::get<Samples>(moved.samples).data()),
                        py::make_tuple(moved.left, moved.top));
}

void save(const AnyBinding& self, const std::string& path) {
  without_gil([&] { self.visit([&](const auto& binding) { io::write_binding(path, binding); }); });
}

AnyBinding load(const std::string& path) {
  return {without_gil([&] { return io::read_binding(path); })};
}

py::bytes content(const AnyBinding& self) {
  return without_gil(
      [&] { return self.visit([](const auto& binding) { return io::encode_binding(binding); }); });
}

AnyBinding from_content(const std::string& content) {
  return {without_gil([&] { return io::decode_binding(content); })};
}

}  // namespace

void bind_bindings(py::module_& module) {
  py::class_<AnyBinding>(module, "Binding")
      .def(py::init(&bound_by))
      .def("arrays", &arrays)
      .def("deform_into", &deform_into, py::arg(), py::arg().noconvert())
      .def("jacobians", &jacobians)
      .def("reduced", &reduced)
      .def("transferred", &transferred)
      .def("composed", &composed)
      .def("skin", &skin)
      .def("joined", &joined)
      .def("adjoint", &adjoint)
      .def("fit", &fit)
      .def("deform_drawing", &deform_drawing)
      .def("deform_picture", &deform_picture<std::uint8_t>)
      .def("deform_picture", &deform_picture<std::uint16_t>)
      .def("save", &save)
      .def("content", &content);
  module.def("load_binding", &load);
  module.def("binding_of", &from_content);
}

}  // namespace flbc::python
