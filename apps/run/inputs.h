// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The inputs of flbc run.
#pragma once

#include <string>
#include <vector>

#include "flbc/cage.h"
#include "gltf/skin.h"
#include "poses/poses.h"
#include "run/arguments.h"
#include "run/shape.h"

namespace flbc::app {

//! Everything that is read beside the cage.
template <int Dim>
struct RunInputs {
  std::vector<std::string> files{};  //!< that are read, the cage's among them unless it is made
  bool makes_cage = false;           //!< the cage is a result
  std::string picture_format{};      //!< extension of pictures, without the dot
  std::vector<Pose<Dim>> poses{};    //!< of the cage
  gltf::Animation<Dim> animation{};  //!< through them
  Shape<Dim> shape{};                //!< the model's; empty without one
};

//! \throws IoError, InputError, OptionError; also if a pose does not fit the cage
template <int Dim>
RunInputs<Dim> load_inputs(const Cage<Dim>& cage, const RunArguments& arguments);

//! The names of all files that may be made.
template <int Dim>
std::vector<std::string> names_of_results(const RunInputs<Dim>& inputs);

//! The name of the model's file in a pose, which is numbered if there are several poses.
std::string name_of_deformed(std::int64_t number, std::size_t num_poses,
                             const std::string& extension);

}  // namespace flbc::app
