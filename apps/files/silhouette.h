// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Pictures as models in the plane.
#pragma once

#include <string>

#include "files/model_facets.h"

namespace flbc::app {

//! The outline of the pixels of a .png file that are not wholly transparent. A pixel is a unit
//! square; the lower left corner of the picture is at the origin.
//! \throws IoError; InputError if the file is no such picture, or has no pixel that is transparent
//! or none that is not
ModelFacets<2> load_silhouette(const std::string& path);

}  // namespace flbc::app
