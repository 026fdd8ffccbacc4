// SPDX-License-Identifier: BSD-3-Clause
// What flbc run reads, and how the files are named that it makes.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/cage_from_model.h"
#include "flbc/domain_mesh.h"
#include "flbc/types.h"
#include "front/movable_model.h"
#include "front/picture_file.h"
#include "front/poses.h"
#include "front/up_axis.h"
#include "gltf/skin.h"
#include "model/surface.h"
#include "report/sparsify_report.h"
#include "solve/solve_settings.h"

namespace flbc::app {

constexpr const char* kCage = "cage.obj";  //!< made round a model
constexpr const char* kDomain = "domain";  //!< the extension depends on the dimension
constexpr const char* kDomainWeights = "domain_weights.npy";
constexpr const char* kWeights = "weights.npy";
constexpr const char* kSparseWeights = "sparse_weights.mtx";
constexpr const char* kBinding = "binding.npz";
constexpr const char* kSkin = "model.glb";        //!< of four influences, which every reader knows
constexpr const char* kFullSkin = "model_8.glb";  //!< of up to eight
// Pictures; the extension depends on the format.
constexpr const char* kFunction = "function";
constexpr const char* kDeformation = "deformation";
constexpr const char* kPage = "model.html";

//! The report, in which the names of all files are: the next run knows by them what is its own.
constexpr const char* kReport = "report.json";

struct RunArguments {
  SolveSettings settings;     //!< cage and model among them, but no domain
  bool makes_cage = false;    //!< whether to make a cage around the model
  std::string follower;       //!< splats, drawing, or picture that moves with the mesh, or empty
  CagingOptions caging;       //!< of that cage
  UpAxis up = UpAxis::kAuto;  //!< in pictures, page, and skins
  PoseArguments poses;
  std::string output;  //!< folder
  Index max_influences = 8;
  std::string reduction = kAutomatic;
  std::string joint;             //!< as --joint; empty: none
  Index control_point = -1;      //!< whose function is drawn, -1 = the program chooses
  std::string pictures = "png";  //!< format of pictures
  double caging_seconds = 0;     //!< for making the cage
  std::chrono::steady_clock::time_point start =
      std::chrono::steady_clock::now();  //!< of the command
  bool force = false;                    //!< results replace files of others, too
  bool quiet = false;
};

//! A model or mesh as the steps of flbc run need it.
template <int Dim>
struct Shape {
  std::string name;                           //!< in glTF
  std::string extension;                      //!< of its file, with the dot
  PointList<Dim> points{};                    //!< Dim x P
  EdgeList edges{};                           //!< between them; empty for a mere set of points
  gltf::Surface surface{};                    //!< without triangles if there are none
  std::unique_ptr<MovableModel<Dim>> file{};  //!< the model's; null for the mesh
};

template <int Dim>
Shape<Dim> shape_of(const DomainMesh<Dim>& domain);

template <int Dim>
constexpr const char* domain_extension() {
  return Dim == 2 ? ".obj" : ".mesh";
}

template <int Dim>
std::string domain_file() {
  return std::string(kDomain) + domain_extension<Dim>();
}

//! Everything that is read beside the cage.
template <int Dim>
struct RunInputs {
  std::vector<std::string> files{};  //!< that are read, the cage's among them unless it is made
  std::vector<Pose<Dim>> poses{};    //!< of the cage
  gltf::Animation<Dim> animation{};  //!< through them
  Shape<Dim> shape{};                //!< the model's; empty without one
  std::unique_ptr<MovableModel<Dim>> follower{};  //!< of that name, or null
  std::optional<io::Bitmap> picture{};            //!< or this
};

//! \throws IoError, InputError, OptionError; also if a pose does not fit the cage
template <int Dim>
RunInputs<Dim> load_inputs(const Cage<Dim>& cage, const RunArguments& arguments);

template <int Dim>
std::vector<std::string> names_of_results(const RunInputs<Dim>& inputs,
                                          const RunArguments& arguments);

//! The name of the model's file in a pose, which is numbered if there are several poses.
std::string name_of_deformed(std::int64_t number, std::size_t num_poses,
                             const std::string& extension);

//! The same of RunArguments::follower.
std::string name_of_follower(std::int64_t number, std::size_t num_poses,
                             const RunArguments& arguments);

}  // namespace flbc::app
