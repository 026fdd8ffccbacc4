// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a model to a problem ready to be solved, in a process of its own.
#pragma once

#include <omp.h>

#include <cstdio>
#include <optional>
#include <string>

#include "flbc/lbc_problem.h"
#include "flbc/solver.h"
#include "paper/child.h"
#include "paper/context.h"
#include "paper/models.h"
#include "speed/real_models.h"

namespace flbc::bench {

//! A model's cage in the models folder, and its mesh, which prepare_domain() writes under OUT.
std::string cage_path(const Context& context, const Model& model);
std::string domain_path(const Context& context, const Model& model, Index vertices);

//! Meshes the cage, once in the program's run.
//! \return false after a message on stderr if that failed
bool prepare_domain(const Context& context, const Model& model, Index vertices);

//! Makes the coarser meshes that solve() may start from.
template <int Dim>
CoarseMesher<Dim> coarse_mesher() {
  return [](const Cage<Dim>& cage, Index vertices) { return mesh_of(cage, vertices, true); };
}

//! A model on a mesh.
template <int Dim>
struct Setting {
  const Model& model;
  Index wanted_vertices;
  LbcProblem<Dim> problem;
  double setup_seconds;  //!< from mesh to problem, the same for all methods
};

//! Reads cage and mesh. \throws flbc::Error
template <int Dim>
Setting<Dim> load_setting(const Context& context, const Model& model, Index vertices);

//! Calls body(setting) -> std::string in a child process; for a model that is not wanted the answer
//! is empty.
//! \param experiment  for messages \return what the body returned, nothing if it failed
template <class Body>
std::optional<std::string> in_setting(const Context& context, const std::string& experiment,
                                      const Model& model, Index vertices, const Body& body) {
  if (!context.wants(model.name)) return std::string();
  if (!prepare_domain(context, model, vertices)) return std::nullopt;
  const auto what = experiment + ": " + model.name + ", " + std::to_string(vertices) + " vertices";
  std::printf("%s\n", what.c_str());
  return in_child(what, [&]() -> std::string {
    omp_set_num_threads(context.threads);
    if (model.dim == 2) return body(load_setting<2>(context, model, vertices));
    return body(load_setting<3>(context, model, vertices));
  });
}

}  // namespace flbc::bench
