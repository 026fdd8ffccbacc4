// SPDX-License-Identifier: BSD-3-Clause
// The errors due to sparsity, as JSON and as text.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "flbc/binding.h"
#include "flbc/sparsify_error.h"
#include "flbc/types.h"

namespace flbc::app {

//! How influences are reduced, as options name it.
constexpr const char* kQuadratic = "quadratic";
constexpr const char* kPoisson = "poisson";
constexpr const char* kAutomatic = "auto";

//! Adds --reduction to a command: of flbc run and flbc sparsify.
void add_reduction_option(CLI::App& command, std::string& reduction);

//! Which of the two to use: poisson where there are neighbors, unless one was asked for.
//! \throws InputError if poisson was asked for without neighbors
std::string reduction_for(const std::string& asked, const std::string& points_file,
                          const EdgeList& edges);

//! The reduction of a name other than kAutomatic.
inline Reduction reduction_named(const std::string& name) {
  return name == kQuadratic ? Reduction::kQuadratic : Reduction::kPoisson;
}

//! Over so many the error of a reduction is measured, where none are given.
constexpr int kRandomPoses = 20;

//! deformation_error() relative to the size of the points. \param poses  of n control points
template <int Dim>
ErrorNorms relative_deformation_error(const PointList<Dim>& points,
                                      const std::vector<PointList<Dim>>& poses,
                                      const SparseWeights& before, const SparseWeights& after);

//! \param name  of the file in reports \param path  of the file, for its size
template <int Dim>
nlohmann::ordered_json weights_json(const std::string& name, const std::string& path,
                                    const Binding<Dim>& binding);

//! Of weights, of points in poses relative to the size of the points, and, if there are edges, of
//! their differences along edges relative to the edges' lengths.
//! \param names  of the poses
template <int Dim>
nlohmann::ordered_json errors_json(const Binding<Dim>& before, const Binding<Dim>& after,
                                   const std::vector<PointList<Dim>>& poses,
                                   const std::vector<std::string>& names);

//! The summary of a whole report, with "before", "after" and "error". \return a line
std::string summary_of(const nlohmann::ordered_json& report);

}  // namespace flbc::app
