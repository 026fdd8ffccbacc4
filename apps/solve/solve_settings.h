// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The settings of a solve, and the options of the command line for them.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "flbc/coordinates.h"
#include "flbc/placement.h"
#include "front/make_domain.h"

namespace flbc::app {

//! Where the weights are wanted and how they are computed. Files may be empty for none.
struct SolveSettings {
  std::string cage;
  std::string domain;         //!< mesh of the interior; empty: one is made
  std::string model;          //!< whose vertices get weights; empty: those of the mesh do
  bool needs_domain = false;  //!< a mesh is made even if the method needs none
  bool embed = false;         //!< the model's vertices become vertices of the mesh
  OutsidePoints outside = OutsidePoints::kFail;  //!< treatment of the model's vertices there
  Index vertices = 0;                            //!< wanted, 0 = as make_domain() chooses
  MesherSettings meshing{};
  std::optional<double> penalty{};           //!< as published (flbc/options.h)
  SolverOptions options{};                   //!< but for the penalty, which depends on the mesh
  std::string locality{};                    //!< file of the model's masks, or else the domain's
  int mirror_axis = -1;                      //!< of the exact mirror of model weights; -1 for none
  std::string phi{};                         //!< file of phi, a row per cell of the domain
  std::optional<Coordinates> coordinates{};  //!< instead of the method of the options, of which
                                             //!< they read threads and non_negative
};

//! Checks what --method names, and its options. \throws OptionError
void validate_settings(const SolveSettings& settings);

//! The name of the coordinates, or of a method without them.
const char* name_of_method(const SolveSettings& settings, Method method);

//! Whether the weights minimize an objective whose optimum does not determine them.
bool is_ambiguous(const SolveSettings& settings);

//! Whether the weights are those of a model by a method that needs no mesh, and none is made.
bool is_meshless(const SolveSettings& settings);

//! Adds --mesher and --mesh-timeout to a command. \param settings  outlives it
void add_mesher_options(CLI::App& command, MesherSettings& settings);

//! Refuses options that were given to a command and that change nothing, because the method does
//! not read them, or there is no model, or no mesh to be made.
//! \param command  with the options of add_solver_options(), parsed
//! \throws OptionError naming the option
void refuse_unread_options(const CLI::App& command, const SolveSettings& settings);

//! Adds all options about the solver to a command. \param settings  outlives it
void add_solver_options(CLI::App& command, SolveSettings& settings);

}  // namespace flbc::app
