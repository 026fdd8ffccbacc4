// SPDX-License-Identifier: BSD-3-Clause
// Pictures of coordinate functions in space, as the bytes of a file.
#pragma once

#include <string>

#include "draw/picture_options.h"
#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc::draw {

//! Draws one coordinate function on parallel slices through the cage, in an oblique view: the
//! cage's edges, lighter at its back and hidden by the slices before them, and the control point in
//! red, pale where the model hides it. It is seen from the side of the z axis. Slices that are not
//! empty have letters. The planes are those of choose_planes().
//! \param model  a surface shown as a pale shape, with its section on each slice
//! \param values  V, the function's value at each vertex of the mesh
//! \param number_of_slices  1 .. 50
//! \throws InputError if a value is missing or not finite, OptionError if there is no such control
//! point or an option is outside its range
std::string draw_slices(const Cage<3>& cage, const DomainMesh<3>& mesh,
                        const Eigen::VectorXd& values, Index control_point,
                        int number_of_slices = 3, const WeightPictureOptions& options = {},
                        const Cage<3>* model = nullptr);

//! Draws all coordinate functions in this way, as a sheet of small pictures in rows.
//! \param weights  n x V \throws as draw_slices()
std::string draw_slice_sheet(const Cage<3>& cage, const DomainMesh<3>& mesh,
                             const WeightMatrix& weights, int number_of_slices = 3,
                             const WeightPictureOptions& options = {});

}  // namespace flbc::draw
