// SPDX-License-Identifier: BSD-3-Clause
// The parts of a page that come from files of cages and their poses.
#pragma once

#include <string>
#include <vector>

#include "flbc/io/model_file.h"
#include "front/page.h"
#include "front/poses.h"
#include "front/up_axis.h"

namespace flbc::app {

//! A cage at rest with the edges of its polygons and, if it is OBJ, its text.
//! \throws IoError, InputError
template <int Dim>
view::ShownCage<Dim> load_shown_cage(const std::string& path);

//! The same of a file that has been read. \param path  where it was
template <int Dim>
view::ShownCage<Dim> cage_as_shown(const io::ModelFile& file, const std::string& path);

//! A model, or a mesh of the interior with its boundary.
//! \throws IoError, InputError, OptionError
template <int Dim>
view::ShownModel<Dim> load_shown_model(const std::string& path);

//! Shows the model upright and from its front at first.
template <int Dim>
void look_from_front(view::PageContent<Dim>& content, UpAxis up);

//! Poses at their times, named by their files without folders.
template <int Dim>
std::vector<view::ShownPose<Dim>> shown_poses(const std::vector<Pose<Dim>>& poses);

//! A file as commands name it that run in the folder of the page.
std::string path_beside(const std::string& page, const std::string& file);

}  // namespace flbc::app
