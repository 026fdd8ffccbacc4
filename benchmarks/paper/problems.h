// SPDX-License-Identifier: BSD-3-Clause
// Models, methods, and from a model to a problem, its optimum, and the columns of its rows.
#pragma once

#include <omp.h>

#include <optional>
#include <string>
#include <vector>

#include "flbc/lbc_problem.h"
#include "flbc/meshing.h"
#include "flbc/options.h"
#include "flbc/quality.h"
#include "flbc/solver.h"
#include "toolkit.h"

namespace flbc::bench {

//! Results of the paper's table 2 and, last, table 1; 0 = not there.
struct PaperNumbers {
  double lbc_error = 0;
  double lbc_seconds = 0;
  double flbc_error = 0;
  double flbc_seconds = 0;
  double squared_distance = 0;  //!< of the optima with and without non-negativity
};

struct Model {
  std::string name;
  int dim;
  std::string cage;      //!< file under the models folder
  Index paper_size = 0;  //!< vertices for tables 1 and 2
  PaperNumbers paper{};
};

//! In the order of the paper's table 2. Gecko is missing: its cage was not published.
const std::vector<Model>& models();

//! \throws std::out_of_range
const Model& model(const std::string& name);

struct NamedMethod {
  std::string name;
  Method method;
  double penalty;  //!< as published, 0 = by method

  //! For the problem of the papers; the method's defaults otherwise.
  template <int Dim>
  SolverOptions options(const LbcProblem<Dim>& problem, int threads) const {
    SolverOptions options;
    options.method = method;
    options.smoothness = 0;
    if (penalty > 0)
      options.penalty = published_penalty(problem.cage, problem.mesh, method, penalty);
    options.threads = threads;
    return options;
  }
};

//! The slowest first: the 2014 solver with its published penalty and at its best, the paper's, the
//! over-relaxed gradient method, the splitting on the weights.
const std::vector<NamedMethod>& methods();

//! Meshes a cage.
DomainMesh<2> mesh_of(const Cage<2>& cage, Index vertices);
DomainMesh<3> mesh_of(const Cage<3>& cage, Index vertices);

//! The cage in a file. \throws flbc::Error
template <int Dim>
Cage<Dim> read_cage(const std::string& file);

std::string cage_path(const Context& context, const Model& model);

template <int Dim>
struct Setting {
  const Context& context;
  const Model& model;
  std::string name;  //!< of the model and its mesh
  LbcProblem<Dim> problem;
  double setup_seconds;  //!< from mesh to problem, the same for all methods
};

//! The mesh of a setting below OUT.
std::string domain_path(const Model& model, const std::string& name);

//! Writes the mesh of a setting in a child process, once in a run of the program. If that fails,
//! its cases fail as well.
void prepare_domain(const Context& context, const Model& model, const std::string& name,
                    Index vertices);

//! Reads cage and mesh. The problem is that of the papers, without smoothness. \throws flbc::Error
template <int Dim>
Setting<Dim> load_setting(const Context& context, const Model& model, const std::string& name);

//! Adds the rows body(setting) -> Rows of a case. Nothing for a model that is not wanted.
//! \param vertices  in a full run \param variant  of the case
template <class Body>
void add_rows(ResultTable& table, const Model& model, Index vertices, const Body& body,
              const std::string& variant = "") {
  const auto& context = table.context();
  if (!context.wants(model.name)) return;
  const auto name = model.name + "-" + std::to_string(context.size(vertices));
  const auto which = variant.empty() ? name : name + " " + variant;
  if (table.has(which)) return;
  prepare_domain(context, model, name, context.size(vertices));
  table.add(which, [&]() -> Rows {
    omp_set_num_threads(context.threads);
    if (model.dim == 2) return body(load_setting<2>(context, model, name));
    return body(load_setting<3>(context, model, name));
  });
}

//! The smoothness that users get.
inline double default_smoothness() {
  return *resolve({}).smoothness;
}

//! An optimum of a problem on a mesh, non-negativity included.
struct Reference {
  SparseWeights weights;
  double relative_gap;  //!< certified
};

//! How optima are computed, also those of table 1.
SolverOptions optimum_options(const Context& context, double smoothness, NonNegative non_negative);

//! Reads the reference from OUT/references if it was made for exactly this problem, else computes
//! and keeps it.
template <int Dim>
Reference reference(const Setting<Dim>& setting);

//! model .. cells
template <int Dim>
Row mesh_row(const std::string& model, const Cage<Dim>& cage, const DomainMesh<Dim>& mesh) {
  return Row()
      .add("model", model)
      .add("control_points", cage.size())
      .add("vertices", mesh.num_vertices())
      .add("cells", mesh.num_cells());
}

template <int Dim>
Row mesh_row(const Setting<Dim>& setting) {
  return mesh_row(setting.model.name, setting.problem.cage, setting.problem.mesh);
}

inline double seconds_after_setup(const SolveReport& report) {
  return report.seconds.solve + report.seconds.recover;
}

inline double seconds_of(const SolveReport& report) {
  return report.seconds.setup + seconds_after_setup(report);
}

//! coarse_levels .. total_seconds. The total adds up setup, solve, and recovery.
inline void add_run(Row& row, double setup_seconds, const SolveReport& report) {
  row.add("coarse_levels", report.coarse_levels.size())
      .add("converged", report.status == SolveStatus::kConverged)
      .add("iterations", report.iterations)
      .add("setup_seconds", setup_seconds)
      .add("solve_seconds", report.seconds.solve)
      .add("recover_seconds", report.seconds.recover)
      .add("total_seconds", setup_seconds + seconds_after_setup(report));
}

//! The solution that took the least time of some. \param run  () -> Solution
template <class Run>
Solution fastest(int repetitions, const Run& run) {
  Solution best = run();
  for (int k = 1; k < repetitions; ++k) {
    auto solution = run();
    if (seconds_of(solution.report) < seconds_of(best.report)) best = std::move(solution);
  }
  return best;
}

}  // namespace flbc::bench
