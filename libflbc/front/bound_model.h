// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Bindings as commands read and write them: one file, or weights with the files of the rest.
#pragma once

#include <memory>
#include <string>

#include "flbc/binding.h"
#include "flbc/io/binding_file.h"
#include "front/movable_model.h"
#include "front/page.h"
#include "front/poses.h"

namespace flbc::app {

//! Files that hold a binding. A .npz file has the cage; weights of other formats need it.
struct BindingFiles {
  std::string weights;
  std::string cage;
  std::string domain;  //!< mesh that has these weights instead of a model; a .npz file has it

  bool is_one() const;
  //! Whether the rest cage is known.
  bool has_cage() const { return is_one() || !cage.empty(); }
  //! The file that has the cage, for messages.
  const std::string& cage_file() const { return cage.empty() ? weights : cage; }
  //! The content of a .npz file, which is read once. \throws IoError, InputError
  const io::AnyBinding& content() const;

 private:
  mutable std::shared_ptr<const io::AnyBinding> content_;
};

//! \throws OptionError if there is no cage, or a second one
void require_cage(const BindingFiles& files, const char* option = "--cage");

//! 2 or 3.
int dimension_of(const BindingFiles& files);

//! A binding of a .npz file. \throws IoError; InputError if its dimension is another one
template <int Dim>
const Binding<Dim>& load_binding(const BindingFiles& files);

//! The same, or a binding of the domain mesh by weights and cage: it can be transferred to any
//! points.
template <int Dim>
Binding<Dim> load_domain_binding(const BindingFiles& files);

//! The binding of a model: of the file, or by weights and cage.
//! \param model  for messages \param points  Dim x P, at rest
//! \param reproduces  whether weights must reproduce the points; those of method bbw do not
//! \throws IoError; InputError if it is not the binding of these points, naming both files
template <int Dim>
Binding<Dim> load_binding(const BindingFiles& files, const std::string& model,
                          const PointList<Dim>& points, EdgeList edges, bool reproduces = true);

//! Writes a binding (.npz), or its weights in another format; signals wait meanwhile.
template <int Dim>
void write_binding(const std::string& path, const Binding<Dim>& binding);

//! The rest cage of a binding, as its file has it if there is one, for poses.
template <int Dim>
RestCage<Dim> rest_cage_of(const BindingFiles& files, const Binding<Dim>& binding);

//! The cage of a binding, as its file has it if there is one.
template <int Dim>
view::ShownCage<Dim> shown_cage_of(const BindingFiles& files, const Binding<Dim>& binding);

//! Prints how many points are outside the cage, how far, and what they do, if there are any.
//! \param file  of the model
template <int Dim>
void warn_outside(const Binding<Dim>& binding, const std::string& file);

//! Files that should belong together, for messages.
struct WeightFiles {
  std::string weights;
  std::string cage;
  std::string model;
};

//! \throws InputError naming both files if there are not as many rows as control points, or not as
//! many columns as points
void check_sizes(const SparseWeights& weights, Eigen::Index num_control_points,
                 Eigen::Index num_points, const WeightFiles& files);

//! The number of points without weights, which do not move.
Index count_without_weights(const SparseWeights& weights);

//! The binding of what moves with the mesh of another one: points, splats, or the points of a
//! drawing. A drawing outside of the cage stays, unless `outside` says how it moves, and a line on
//! standard error names its first element there.
//! \param file  of the model \param outside  kFail: as the binding says
template <int Dim>
Binding<Dim> bind_by_mesh(const Binding<Dim>& bound, const MovableModel<Dim>& model,
                          const std::string& file, OutsidePoints outside);

//! How the points of a drawing move with that mesh, without a binding of them: they may be
//! millions.
//! \param bound, model  must outlive it
template <int Dim>
Motion<Dim> drawing_by_mesh(const Binding<Dim>& bound, const MovableModel<Dim>& model,
                            const std::string& file, OutsidePoints outside);

}  // namespace flbc::app
