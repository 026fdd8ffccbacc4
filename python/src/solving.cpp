// SPDX-License-Identifier: BSD-3-Clause
// Meshes of cages, solves, and solves that continue.
#include <omp.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "arrays.h"
#include "flbc/errors.h"
#include "flbc/linked_meshers.h"
#include "flbc/rig.h"
#include "flbc/solver.h"
#include "options.h"

namespace flbc::python {
namespace {

std::atomic<bool> is_forked{false};

// For code that runs without the GIL.
void throw_if_interrupted() {
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

// ---------------------------------------------------------------------------------------- meshing

py::tuple mesh(const Doubles& points, const Indices& facets, Index vertices,
               const std::optional<Doubles>& embedded, double time_limit) {
  return by_dimension(points, [&](auto dim) -> py::tuple {
    constexpr int kDim = decltype(dim)::value;
    const auto cage = cage_of<kDim>(points, facets);
    MeshingOptions<kDim> options;
    options.vertices = vertices;
    options.time_limit = time_limit;
    options.poll = interruption();
    if (embedded) options.embedded_points = points_of<kDim>(*embedded);
    const auto made = without_gil([&] {
      validate(cage);
      options.embedded_points = embeddable_points(cage, options.embedded_points).points;
      return make_domain(cage, options, linked_meshers<kDim>());
    });
    return py::make_tuple(as_python(made.mesh), made.note);
  });
}

// --------------------------------------------------------------------------------------- solving

// The observer of a solve that runs without the GIL.
// \param callback  a Python function or None; outlives the solve
Observer observer_of(const py::object& callback) {
  Observer observer;
  observer.poll = interruption();
  if (callback.is_none()) return observer;
  observer.progress = [handle = py::handle(callback)](const Progress& progress) {
    const py::gil_scoped_acquire gil;
    const auto object = py::cast(progress);
    const auto result = handle(object);
    object.cast<Progress&>().objective = {};  // refers to the running solve
    const int goes_on = result.is_none() ? 1 : PyObject_IsTrue(result.ptr());
    if (goes_on < 0) throw py::error_already_set();
    return goes_on != 0;
  };
  return observer;
}

template <class Options>
Options here(Options options) {
  if (is_forked) options.threads = 1;
  return options;
}

// The arrays of a proof, a row per cell or vertex; None without one.
py::object arrays_of(const std::shared_ptr<const Proof>& proof) {
  if (!proof) return py::none();
  const auto cells = proof->phi.cols(), n = proof->phi.rows(), axes = proof->multipliers.rows();
  const auto phi = proof->phi.dense();
  py::dict arrays;
  arrays["phi"] = py::array_t<double>({cells, n}, phi.data());
  arrays["flux"] = py::array_t<float>({cells, axes, n}, proof->flux.data());
  arrays["multipliers"] =
      py::array_t<double>({proof->multipliers.cols(), axes}, proof->multipliers.data());
  arrays["smoothness"] = proof->smoothness;
  arrays["masked"] =
      py::array_t<Index>({proof->masked.cols(), Eigen::Index(2)}, proof->masked.data());
  return std::move(arrays);
}

py::tuple solved(Solution solution, const std::optional<Coordinates>& coordinates = {}) {
  const auto report = as_dict(solution.report, coordinates);
  const auto proof = arrays_of(solution.report.certificate.proof);
  return py::make_tuple(as_python(std::move(solution.weights)), report, proof);
}

// What solve() and bind() are asked for.
struct Request {
  Request(const py::dict& keywords, const std::optional<Doubles>& array)
      : coordinates(coordinates_of(keywords)),
        options(here(coordinates ? coordinates_options_of(keywords) : options_of(keywords))) {
    if (!array) return;
    phi = Eigen::MatrixXd::Map(array->data(), array->shape(1), array->shape(0)).eval();
  }

  template <int Dim>
  Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& domain, const Observer& observer) {
    if (coordinates) {
      return compute_coordinates(cage, domain, *coordinates,
                                 {options.non_negative, options.threads}, observer);
    }
    if (!phi) return flbc::solve<Dim>(cage, domain, options, observer);
    validate(options);
    auto problem =
        make_problem(cage, domain, DistanceScheme::kConstant, *resolve(options).smoothness);
    problem.phi = WeightFunctions(std::move(*phi));
    return flbc::solve(problem, options, observer);
  }

  std::optional<Coordinates> coordinates;
  SolverOptions options;  // coordinates read non_negative and threads
  std::optional<Eigen::MatrixXd> phi{};
};

py::tuple solve(const Doubles& points, const Indices& facets, const Doubles& vertices,
                const Indices& cells, const py::dict& keywords, const std::optional<Doubles>& phi,
                const py::object& callback) {
  Request request(keywords, phi);
  return by_dimension(points, [&](auto dim) -> py::tuple {
    constexpr int kDim = decltype(dim)::value;
    const auto cage = cage_of<kDim>(points, facets);
    const auto domain = mesh_of<kDim>(vertices, cells);
    const auto observer = observer_of(callback);
    return solved(without_gil([&] { return request.solve(cage, domain, observer); }),
                  request.coordinates);
  });
}

// \param domain  none: it is made, of so many vertices, or as many as usual
// \param options  of the solve, with the mask of the model
// \return weights, report, note, offsets or None, and points outside
py::tuple bind_model(const Doubles& points, const Indices& facets,
                     const std::optional<std::pair<Doubles, Indices>>& domain,
                     const std::optional<Index>& vertices, const Doubles& model,
                     const Polygons& polygons, const py::dict& keywords,
                     const std::optional<Doubles>& phi, Index max_influences,
                     const std::string& outside, int mirror_axis, const py::object& callback) {
  Request request(keywords, phi);
  BindOptions options;
  options.vertices = vertices.value_or(kDefaultVertices);
  options.solver.threads = request.options.threads;
  options.observer = observer_of(callback);
  options.max_influences = max_influences;
  options.outside = named<OutsidePoints>("outside", outside);
  options.masks = std::move(request.options.masks);
  options.mirror_axis = mirror_axis;
  return by_dimension(points, [&](auto dim) -> py::tuple {
    constexpr int kDim = decltype(dim)::value;
    const auto cage = cage_of<kDim>(points, facets);
    const auto all = points_of<kDim>(model);
    const auto lists = lists_of(polygons);
    MadeDomain<kDim> given;
    if (domain) given.mesh = mesh_of<kDim>(domain->first, domain->second);
    std::string note;
    auto binding = without_gil([&] {
      const auto edges = edges_of_polygons(all, lists);
      auto rig = domain ? Rig<kDim>(cage, std::move(given), all, edges, options)
                        : Rig<kDim>(cage, all, edges, options, linked_meshers<kDim>());
      request.options.masks = rig.masks().of_mesh;
      rig.set_solution(request.solve(rig.cage(), rig.mesh(), options.observer));
      auto bound = rig.bind();
      note = vertices ? bound.report.note : rig.masks().note();
      return bound;
    });
    const py::object offsets =
        binding.offsets.cols() > 0 ? py::object(as_array(binding.offsets)) : py::none();
    return py::make_tuple(as_python(std::move(binding.weights)),
                          as_dict(binding.report.solve, request.coordinates), note, offsets,
                          binding.outside);
  });
}

template <class Solver>
struct DimensionOf;
template <int Dim>
struct DimensionOf<Solver<Dim>> : std::integral_constant<int, Dim> {};

// A Solver of either dimension, for one thread at a time.
class AnySolver {
  struct Release {
    void operator()(std::atomic<bool>* flag) const { *flag = false; }
  };

  template <class Action>
  auto use(const Action& action) {
    if (is_used_.exchange(true)) {
      throw Error("this Solver is in use, by another thread or by the caller of this callback");
    }
    const std::unique_ptr<std::atomic<bool>, Release> lock(&is_used_);
    return std::visit([&](auto& solver) { return action(*solver); }, solver_);
  }

  template <class Action>
  py::tuple run(const py::object& callback, const Action& action) {
    return use([&](auto& solver) {
      const auto observer = observer_of(callback);
      // A copy, because the Solver needs its weights for the next move.
      return solved(without_gil([&] { return Solution(action(solver, observer)); }));
    });
  }

 public:
  AnySolver(const Doubles& points, const Indices& facets, const Doubles& vertices,
            const Indices& cells, const py::dict& keywords) {
    by_dimension(points, [&](auto dim) {
      constexpr int kDim = decltype(dim)::value;
      auto cage = cage_of<kDim>(points, facets);
      auto domain = mesh_of<kDim>(vertices, cells);
      const auto options = here(options_of(keywords));
      solver_ = without_gil([&] {
        return std::make_unique<Solver<kDim>>(std::move(cage), std::move(domain), options);
      });
    });
  }

  py::tuple solve(int iterations, double seconds, const py::object& callback) {
    return run(callback, [&](auto& solver, const Observer& observer) {
      return solver.solve({iterations, seconds}, observer);
    });
  }

  py::tuple move(const Doubles& control_points, int iterations, double seconds,
                 const py::object& callback) {
    return run(callback, [&](auto& solver, const Observer& observer) {
      constexpr int kDim = DimensionOf<std::decay_t<decltype(solver)>>::value;
      return solver.reshape(points_of<kDim>(control_points), {iterations, seconds}, observer);
    });
  }

  void set_options(const py::dict& keywords) {
    use([&](auto& solver) { solver.set_options(here(options_of(keywords))); });
  }
  void restart() {
    use([](auto& solver) { solver.restart(); });
  }
  py::dict options() {
    return use([](auto& solver) { return as_dict(solver.options()); });
  }
  py::tuple cage() {
    return use([](auto& solver) { return as_python(solver.cage()); });
  }
  py::tuple mesh() {
    return use([](auto& solver) { return as_python(solver.mesh()); });
  }

 private:
  std::variant<std::unique_ptr<Solver<2>>, std::unique_ptr<Solver<3>>> solver_;
  std::atomic<bool> is_used_{false};
};

}  // namespace

std::function<void()> interruption() {
  using Clock = std::chrono::steady_clock;
  // Waiting for the GIL takes up to 5 ms while other Python threads compute.
  return [last = Clock::now()]() mutable {
    constexpr std::chrono::milliseconds kInterval(100);
    const auto now = Clock::now();
    if (now - last < kInterval) return;
    last = now;
    throw_if_interrupted();
  };
}

void use_threads_of_this_process() {
  // Also in CHOLMOD, which has its own number of threads.
  if (is_forked) omp_set_max_active_levels(0);
}

void bind_solving(py::module_& module) {
  module.def("has_forked", [] { is_forked = true; });
  module.def("option_names", &option_names);
  module.def("mesh", &mesh);
  module.def("solve", &solve);
  module.def("bind_model", &bind_model);

  py::class_<Progress>(module, "Progress", "Progress of a solve, for callbacks.")
      .def_readonly("iteration", &Progress::iteration, "int: counted from 1")
      .def_readonly("relative_primal_residual", &Progress::relative_primal_residual,
                    "float: residual or estimated error, divided by its threshold")
      .def_readonly("relative_dual_residual", &Progress::relative_dual_residual,
                    "float: divided by its threshold; 0 if the method has none")
      .def_readonly("finer_levels", &Progress::finer_levels,
                    "int: meshes or parts that follow this one")
      .def(
          "objective",
          [](const Progress& progress) {
            if (!progress.objective) throw Error("objective() works only during the callback");
            return progress.objective();
          },
          "Computes the objective of the current weights, in about the time of two iterations.")
      .def("__repr__", [](const Progress& progress) {
        return "<flbc.Progress: iteration " + std::to_string(progress.iteration) + ", " +
               std::to_string(progress.relative_primal_residual) + " of the threshold>";
      });

  py::class_<AnySolver>(module, "Solver")
      .def(py::init<const Doubles&, const Indices&, const Doubles&, const Indices&,
                    const py::dict&>())
      .def("solve", &AnySolver::solve)
      .def("move", &AnySolver::move)
      .def("set_options", &AnySolver::set_options)
      .def("restart", &AnySolver::restart)
      .def("options", &AnySolver::options)
      .def("cage", &AnySolver::cage)
      .def("mesh", &AnySolver::mesh);
}

}  // namespace flbc::python
