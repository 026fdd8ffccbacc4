// SPDX-License-Identifier: BSD-3-Clause
// The compiled part of the Python module: one function per function of the library, for arrays that
// the Python files have checked. Those files have the documentation.
#include <optional>
#include <string>

#include <Eigen/LU>

#include "arrays.h"
#include "flbc/border.h"
#include "flbc/cage_facts.h"
#include "flbc/check.h"
#include "flbc/errors.h"
#include "flbc/gradients.h"
#include "flbc/io/cage_io.h"
#include "flbc/masks.h"
#include "flbc/meshing.h"
#include "flbc/placement.h"
#include "flbc/pointwise.h"
#include "flbc/report.h"
#include "flbc/version.h"
#include "front/model_facets.h"
#include "options.h"
#ifdef FLBC_LINKS_CAGING
#include "flbc/cage_from_model.h"
#include "flbc/repair_cage.h"
#endif

namespace flbc::python {
namespace {

using namespace py::literals;

// \param arguments  of the exception: its message, and its data
template <class... Arguments>
void set_error(const char* type, const Arguments&... arguments) {
  // A signal may be the reason: Ctrl-C also ends the process of a mesher.
  if (PyErr_CheckSignals() != 0) return;
  const auto kind = py::module_::import("flbc._errors").attr(type);
  PyErr_SetObject(kind.ptr(), kind(arguments...).ptr());
}

// The library names its own options.
std::string in_words_of_python(std::string message) {
  const std::string library =
      "choose OutsidePoints kNearest, kKeep, or kExtend, or make a cage around the model with "
      "cage_from_model()";
  const auto at = message.find(library);
  if (at == std::string::npos) return message;
  return message.replace(at, library.size(),
                         "choose outside='nearest', 'keep', or 'extend', or make a cage around the "
                         "model with make_cage()");
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const OptionError& error) {
    set_error("OptionError", error.what());
  } catch (const MaskConflict& error) {
    set_error("MaskConflict", error.what(), error.points, error.control_points);
  } catch (const InputError& error) {
    set_error("InputError", in_words_of_python(error.what()));
  } catch (const IoError& error) {
    set_error("IoError", error.what());
  } catch (const SolverError& error) {
    set_error("SolverError", error.what());
  } catch (const Error& error) {
    set_error("Error", error.what());
  }
}

// ------------------------------------------------------------------------------------------ cages

py::array triangles(const Doubles& points, const Polygons& polygons) {
  return as_array(app::triangles_of(soup_of(points, polygons)));
}

py::list check_cage(const Doubles& points, const Indices& facets) {
  return by_dimension(points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const auto cage = cage_of<kDim>(points, facets);
    const auto defects = without_gil([&] {
      auto found = find_defects(cage);
#ifdef FLBC_LINKS_CGAL
      if (found.empty()) found = find_self_intersections(cage);
#endif
      return found;
    });
    py::list list;
    for (const auto& defect : defects) {
      list.append(
          py::make_tuple(name_of(defect.kind), defect.vertices, defect.facets, defect.message));
    }
    return list;
  });
}

// The indices and distances of points outside.
py::tuple outside(const Doubles& points, const Indices& facets, const Doubles& places) {
  return by_dimension(points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const auto cage = cage_of<kDim>(points, facets);
    const auto all = points_of<kDim>(places);
    const auto found =
        without_gil([&] { return nearest_on_cage(cage, all, points_outside(cage, all)); });
    std::vector<Index> which;
    std::vector<double> distances;
    for (const auto& point : found) {
      which.push_back(point.point);
      distances.push_back(point.distance());
    }
    return py::make_tuple(which, distances);
  });
}

// Control points that must stay at rest, so that points inside join still ones outside.
std::vector<Index> border(const Doubles& points, const Indices& facets, const Doubles& places,
                          const Polygons& polygons) {
  return by_dimension(points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const auto cage = cage_of<kDim>(points, facets);
    const auto all = points_of<kDim>(places);
    const auto lists = lists_of(polygons);
    return without_gil([&] {
      validate(cage);
      std::vector<bool> is_still(static_cast<std::size_t>(all.cols()), false);
      for (const Index p : points_outside(cage, all)) is_still[p] = true;
      return control_points_at(cage,
                               find_crossings(cage, all, is_still, edges_of_polygons(all, lists)));
    });
  });
}

py::tuple make_cage([[maybe_unused]] const Doubles& points,
                    [[maybe_unused]] const Polygons& polygons,
                    [[maybe_unused]] Index control_points, [[maybe_unused]] double offset,
                    [[maybe_unused]] const std::string& symmetry,
                    [[maybe_unused]] const Doubles& density) {
#ifdef FLBC_LINKS_CAGING
  const CagingOptions options{control_points, offset, symmetry_named(symmetry),
                              Eigen::Map<const Eigen::VectorXd>(density.data(), density.size())};
  return by_dimension(points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const auto all = points_of<kDim>(points);
    FacetList<kDim> facets;
    if constexpr (kDim == 3) {
      facets = app::elements_of(soup_of(points, polygons));
    } else {
      const auto ends = edges_of(all, polygons).ends;
      facets.resize(2, static_cast<Eigen::Index>(ends.size()));
      for (std::size_t e = 0; e < ends.size(); ++e) {
        facets.col(static_cast<Eigen::Index>(e)) << ends[e][0], ends[e][1];
      }
    }
    const auto made = without_gil([&] { return cage_from_model<kDim>(all, facets, options); });
    return py::make_tuple(as_python(made.cage), describe_bridged_gaps(made));
  });
#else
  throw OptionError("this flbc was built without CGAL and cannot make cages");
#endif
}

py::tuple repair([[maybe_unused]] const Doubles& points, [[maybe_unused]] const Indices& facets) {
#ifdef FLBC_LINKS_CAGING
  return by_dimension(points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const auto cage = cage_of<kDim>(points, facets);
    const auto repaired = without_gil([&] { return repair_cage(cage); });
    return py::make_tuple(as_python(repaired.cage), repaired.changes, repaired.new_numbers);
  });
#else
  throw OptionError("this flbc was built without CGAL and cannot repair cages");
#endif
}

py::tuple normalized_mesh(const Doubles& vertices, const Indices& cells) {
  return by_dimension(vertices, [&](auto dim) {
    auto mesh = mesh_of<decltype(dim)::value>(vertices, cells);
    without_gil([&] { normalize_and_validate(mesh); });
    return as_python(std::move(mesh));
  });
}

// ---------------------------------------------------------------------------------------- weights

// What weights at points are computed from.
template <int Dim>
struct Known {
  Known(const Doubles& points, const Indices& facets, const Doubles& vertices, const Indices& cells,
        const py::object& given, const Doubles& at)
      : cage(cage_of<Dim>(points, facets)),
        mesh(mesh_of<Dim>(vertices, cells)),
        places(points_of<Dim>(at)),
        weights(weights_of(given)) {}

  Cage<Dim> cage;
  DomainMesh<Dim> mesh;
  PointList<Dim> places;
  decltype(weights_of(py::object())) weights;
};

py::object weights_at(const Doubles& points, const Indices& facets, const Doubles& vertices,
                      const Indices& cells, const py::object& weights, const Doubles& places,
                      const std::string& policy_name) {
  const auto policy = named<OutsidePoints>("outside", policy_name);
  return by_dimension(points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const Known<kDim> known(points, facets, vertices, cells, weights, places);
    return as_python(without_gil([&] {
      const auto placement = place_points(known.cage, known.mesh, known.places, policy);
      return flbc::weights_at(known.cage, known.mesh, known.weights, placement);
    }));
  });
}

// The derivatives of piecewise linear weights.
template <int Dim>
SparseWeights exact_gradients(const Known<Dim>& known, const std::vector<Location<Dim>>& places) {
  const Index rows = Dim * known.cage.size();
  return SparseWeights::of(
      rows, static_cast<Index>(places.size()), [&](Index p) -> Eigen::VectorXd {
        const auto cell = known.mesh.cells.col(places[p].cell);
        Eigen::Matrix<double, Dim, Dim> sides;
        Eigen::Matrix<double, Dim, Eigen::Dynamic> differences(Dim, known.cage.size());
        for (int k = 0; k < Dim; ++k) {
          sides.row(k) = known.mesh.points.col(cell[k + 1]) - known.mesh.points.col(cell[0]);
          differences.row(k) = known.weights.at(cell[k + 1]) - known.weights.at(cell[0]);
        }
        return (sides.inverse() * differences).eval().reshaped();
      });
}

// Gradients at points, P x Dim n: number Dim i + d of a point is the derivative of weight i in
// direction d.
// \param exact  derivatives of the weights, instead of smooth gradients
py::array gradients(const Doubles& points, const Indices& facets, const Doubles& vertices,
                    const Indices& cells, const py::object& weights, const Doubles& places,
                    bool exact) {
  return by_dimension(points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const Known<kDim> known(points, facets, vertices, cells, weights, places);
    return as_array(without_gil([&] {
      const auto placement = place_points(known.cage, known.mesh, known.places);
      const auto found = places_in_mesh(known.cage, known.mesh, placement);
      return (exact ? exact_gradients(known, found)
                    : gradients_at(known.mesh, known.weights, found))
          .dense();
    }));
  });
}

py::array mean_value(const Doubles& points, const Indices& facets, const Doubles& places) {
  return by_dimension(points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const auto cage = cage_of<kDim>(points, facets);
    const auto all = points_of<kDim>(places);
    return as_array(without_gil([&] {
      validate(cage);
      return mean_value_coordinates<kDim>(cage, all);
    }));
  });
}

template <int Dim>
py::object as_python(const Extreme<Dim>& extreme) {
  if (extreme.point < 0) return py::none();
  py::dict dict("value"_a = extreme.value, "point"_a = extreme.point);
  if (extreme.control_point >= 0) dict["control_point"] = extreme.control_point;
  return dict;
}

template <int Dim>
py::dict as_python(const WeightCheck<Dim>& check) {
  py::dict dict(
      "points"_a = check.points, "control_points"_a = check.control_points,
      "non_finite"_a = check.non_finite, "negative"_a = check.negative,
      "mean_influences"_a = check.quality.mean_influences,
      "min_weight"_a = as_python(check.min_weight), "max_weight"_a = as_python(check.max_weight),
      "partition"_a = as_python(check.partition), "reproduction"_a = as_python(check.reproduction),
      "influences"_a = as_python(check.influences), "lagrange"_a = as_python(check.lagrange),
      "linearity"_a = as_python(check.linearity), "violations"_a = find_violations(check));
  if (!check.mesh) return dict;
  dict["local_minima"] = check.mesh->local_minima;
  dict["local_maxima"] = check.mesh->local_maxima;
  dict["deepest_minimum"] = as_python(check.mesh->deepest_minimum);
  dict["highest_maximum"] = as_python(check.mesh->highest_maximum);
  dict["total_variation"] = check.mesh->total_variation;
  dict["weighted_variation"] = check.mesh->weighted_variation;
  dict["gradient_jump"] = check.mesh->gradient_jump;
  return dict;
}

// \param cells  of the mesh whose vertices are the points; none for other points
py::dict measure(const Doubles& points, const Indices& facets, const Doubles& places,
                 const std::optional<Indices>& cells, const py::object& weights) {
  return by_dimension(points, [&](auto dim) {
    constexpr int kDim = decltype(dim)::value;
    const auto cage = cage_of<kDim>(points, facets);
    DomainMesh<kDim> mesh;
    mesh.points = points_of<kDim>(places);
    if (cells) mesh = mesh_of<kDim>(places, *cells);
    const auto given = weights_of(weights);
    return as_python(without_gil([&] {
      validate(cage);
      return cells ? check_weights(cage, mesh, given) : check_weights(cage, mesh.points, given);
    }));
  });
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Compiled part of flbc. Use the functions of the module flbc.";
  py::register_exception_translator(&translate);
  module.attr("version") = FLBC_VERSION;
  module.def("triangles", &triangles);
  module.def("check_cage", &check_cage);
  module.def("outside", &outside);
  module.def("border", &border);
  module.def("make_cage", &make_cage);
  module.def("repair", &repair);
  module.def("normalized_mesh", &normalized_mesh);
  module.def("weights_at", &weights_at);
  module.def("gradients", &gradients);
  module.def("mean_value", &mean_value);
  module.def("measure", &measure);
  bind_bindings(module);
  bind_solving(module);
  bind_files(module);
}

}  // namespace flbc::python
