// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Files that keep a TetMesh with its properties, as .om files keep OpenMesh's meshes: so that a
//! solve goes on in another process.
#pragma once

#include <string>

#include "flbc/openmesh/tet_mesh.h"

namespace flbc::openmesh {

//! Writes points, cells and all properties that are persistent, to the bit, in this machine's order
//! of bytes. \throws IoError; InputError naming a property that cannot be written
void save_tet_mesh(const std::string& path, const TetMesh& mesh);

//! Reads what save_tet_mesh() wrote: elements have the numbers they had, properties are persistent.
//! \throws IoError; InputError naming the file if it is damaged or none of these, or a property of
//! a type that is not registered in this program (OM_REGISTER_PROPERTY_TYPE)
TetMesh load_tet_mesh(const std::string& path);

}  // namespace flbc::openmesh
