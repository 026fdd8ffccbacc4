// SPDX-License-Identifier: BSD-3-Clause
// Meshes of cages, solves, and solves that resume.
#include <omp.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "arrays.h"
#include "flbc/errors.h"
#include "flbc/make_domain.h"
#include "flbc/report.h"
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

// The observer of a solve that runs without the GIL.
// \param callback  a Python function or None; outlives the observer
Observer observer_of(const py::object& callback) {
  Observer observer;
  observer.poll = interruption();
  observer.progress = [&callback](const Progress& progress) {
    if (callback.is_none()) return true;
    const py::gil_scoped_acquire gil;
    const auto object = py::cast(progress);
    const auto result = callback(object);
    object.cast<Progress&>().objective = {};  // refers to the running solve
    const int goes_on = result.is_none() ? 1 : PyObject_IsTrue(result.ptr());
    if (goes_on < 0) throw py::error_already_set();
    return goes_on != 0;
  };
  return observer;
}

py::tuple as_tuple(Solution solution, const BindOptions& options) {
  const auto report =
      as_dict(solution.report, options.coordinates ? name_of(*options.coordinates) : "");
  const auto proof = as_python(solution.report.certificate.proof);
  return py::make_tuple(as_python(std::move(solution.weights)), report, proof);
}

// A Rig of either dimension, for one thread at a time. Without a model, it is one of the mesh, and
// masks are those of its vertices.
class AnyRig {
  struct Release {
    void operator()(std::atomic<bool>* flag) const { *flag = false; }
  };

  template <class Action>
  auto use(const Action& action) {
    if (is_used_.exchange(true)) {
      throw Error("this object is in use, by another thread or by the caller of this callback");
    }
    const std::unique_ptr<std::atomic<bool>, Release> lock(&is_used_);
    return std::visit([&](auto& rig) { return action(*rig); }, rig_);
  }

  template <class Action>
  auto run(const py::object& callback, const Action& action) {
    return use([&](auto& rig) {
      callback_ = callback;
      const std::unique_ptr<py::object, void (*)(py::object*)> reset(
          &callback_, [](py::object* kept) { *kept = py::none(); });
      return without_gil([&] { return action(rig); });
    });
  }

  // \param freed  output: the control points of masks that could not be obeyed
  template <int Dim>
  static BindOptions parsed(const py::dict& keywords, const Cage<Dim>& cage,
                            const PointList<Dim>& points, std::vector<Index>& freed) {
    auto options = options_of(keywords);
    if (is_forked) options.solver.threads = 1;
    if (points.cols() == 0) return options;
    std::swap(options.masks, options.solver.masks);
    if (keywords["relax"].cast<bool>() && !options.masks.empty()) {
      options.masks = without_gil([&] {
        return relax_masks(cage, points, std::move(options.masks), freed, options.mirror_axis);
      });
    }
    return options;
  }

 public:
  // \param domain  none: it is made if these coordinates need one, or `vertices` are given
  AnyRig(const Doubles& points, const Indices& facets,
         const std::optional<std::pair<Doubles, Indices>>& domain,
         const std::optional<Index>& vertices, const Doubles& model, const Polygons& polygons,
         const py::dict& keywords) {
    by_dimension(points, [&](auto dim) {
      constexpr int kDim = decltype(dim)::value;
      const auto cage = cage_of<kDim>(points, facets);
      const auto all = points_of<kDim>(model);
      auto options = parsed(keywords, cage, all, freed_);
      options.vertices = vertices.value_or(kDefaultVertices);
      options.observer = observer_of(callback_);
      const auto edges = edges_of(all, polygons);
      MadeDomain<kDim> given;
      if (domain) given.mesh = mesh_of<kDim>(domain->first, domain->second);
      const bool needs_mesh =
          vertices || !options.coordinates || !is_pointwise(*options.coordinates);
      rig_ = without_gil([&] {
        if (domain) {
          return std::make_unique<Rig<kDim>>(cage, std::move(given), all, edges, options);
        }
        if (!needs_mesh) return std::make_unique<Rig<kDim>>(cage, all, edges, options);
        return std::make_unique<Rig<kDim>>(cage, all, edges, options, linked_meshers<kDim>());
      });
    });
  }

  // \param control_points  moved ones, or none
  py::tuple solve(const std::optional<Doubles>& control_points, int iterations, double seconds,
                  const py::object& callback) {
    auto solution = run(callback, [&](auto& rig) {
      constexpr int kDim = kDimOf<std::decay_t<decltype(rig)>>;
      const Budget budget{iterations, seconds};
      return Solution(control_points ? rig.reshape(points_of<kDim>(*control_points), budget)
                                     : rig.solve(budget));
    });
    return use([&](auto& rig) { return as_tuple(std::move(solution), rig.options()); });
  }

  void restart() {
    use([](auto& rig) {
      auto solution = rig.solution();
      if (solution.weights.num_points() == 0) return;
      solution.report.status = SolveStatus::kStopped;
      rig.set_solution(std::move(solution));
    });
  }

  void set_model(const Doubles& model, const Polygons& polygons) {
    use([&](auto& rig) {
      const auto points = points_of<kDimOf<std::decay_t<decltype(rig)>>>(model);
      const auto edges = edges_of(points, polygons);
      without_gil([&] { rig.set_model(points, edges); });
    });
  }

  void set_options(const py::dict& keywords, bool has_model) {
    use([&](auto& rig) {
      std::vector<Index> freed;
      auto points = rig.placement().points;
      if (!has_model) points.resize(Eigen::NoChange, 0);
      auto options = parsed(keywords, rig.cage(), points, freed);
      options.vertices = rig.options().vertices;
      options.observer = rig.options().observer;
      without_gil([&] { rig.set_options(options); });
      freed_ = std::move(freed);
    });
  }

  AnyBinding bind(bool reduces, const py::object& callback) {
    return run(callback, [&](auto& rig) {
      auto binding = reduces ? rig.bind() : rig.binding();
      auto& note = binding.report.note;
      for (const Index i : freed_) {
        note += i != freed_.front() ? ", "
                : note.empty()      ? "masks were removed from control points "
                                    : "; masks were removed from control points ";
        note += std::to_string(i);
      }
      return AnyBinding{std::move(binding)};
    });
  }

  py::object solution() {
    return use([](auto& rig) -> py::object {
      if (rig.solution().weights.num_points() == 0) return py::none();
      return as_tuple(rig.solution(), rig.options());
    });
  }

  py::tuple cage() {
    return use([](auto& rig) { return as_python(rig.cage()); });
  }
  py::tuple mesh() {
    return use([](auto& rig) { return as_python(rig.mesh()); });
  }

 private:
  std::variant<std::unique_ptr<Rig<2>>, std::unique_ptr<Rig<3>>> rig_;
  std::atomic<bool> is_used_{false};
  py::object callback_ = py::none();
  std::vector<Index> freed_{};
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
  module.def("mesh", &mesh);

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

  py::class_<AnyRig>(module, "Rig")
      .def(py::init<const Doubles&, const Indices&,
                    const std::optional<std::pair<Doubles, Indices>>&, const std::optional<Index>&,
                    const Doubles&, const Polygons&, const py::dict&>())
      .def("solve", &AnyRig::solve)
      .def("restart", &AnyRig::restart)
      .def("set_model", &AnyRig::set_model)
      .def("set_options", &AnyRig::set_options)
      .def("bind", &AnyRig::bind)
      .def("solution", &AnyRig::solution)
      .def("cage", &AnyRig::cage)
      .def("mesh", &AnyRig::mesh);
}

}  // namespace flbc::python
