// SPDX-License-Identifier: BSD-3-Clause
#include "run/inputs.h"

#include <filesystem>

#include "flbc/errors.h"
#include "front/load.h"
#include "front/model_facets.h"
#include "front/poses.h"

namespace flbc::app {
namespace {

template <int Dim>
void load_motion(const Cage<Dim>& cage, const RunArguments& arguments, RunInputs<Dim>& inputs) {
  const auto& given = arguments.poses;
  if (given.empty()) return;
  const auto files = find_cages(given.cages);
  inputs.files.insert(inputs.files.end(), files.paths.begin(), files.paths.end());
  const auto rest = arguments.makes_cage ? RestCage<Dim>(cage, "the cage")
                                         : RestCage<Dim>(arguments.settings.cage);
  inputs.poses = load_poses(given, files, rest, 1);
  inputs.animation = animation_of(inputs.poses, &cage.points);
}

template <int Dim>
Shape<Dim> load_shape(const std::string& path) {
  const std::filesystem::path file(path);
  if (!io::holds(path, {io::Content::kModel}) && !is_point_file(path)) {
    throw OptionError(path + ": unknown file format; a model must end in " +
                      io::extensions_of({io::Content::kModel}) + io::conversion_hint(path));
  }
  // The numbers of a .gltf file are elsewhere.
  const std::string moved = io::extension_of(path) == "gltf" ? ".glb" : "";
  Shape<Dim> shape{file.stem().string(), moved.empty() ? file.extension().string() : moved};
  shape.file =
      std::make_unique<MovableModel<Dim>>(MovedFile{path, moved.empty() ? path : "a" + moved});
  shape.points = shape.file->points();
  shape.edges = shape.file->edges();
  // Points and lines have none, and are fine nevertheless.
  const auto* model = shape.file->model();
  if (model != nullptr && !model->soup.polygons.empty()) shape.surface = shape.file->surface();
  return shape;
}

}  // namespace

template <int Dim>
Shape<Dim> shape_of(const DomainMesh<Dim>& domain) {
  Shape<Dim> shape{"domain", domain_extension<Dim>()};
  shape.points = domain.points;
  shape.edges = edges_of_cells(domain);
  shape.surface = gltf::surface_of_model<Dim>({io::to_polygons(domain)});
  return shape;
}

template <int Dim>
RunInputs<Dim> load_inputs(const Cage<Dim>& cage, const RunArguments& arguments) {
  const auto& settings = arguments.settings;
  RunInputs<Dim> inputs;
  if (!arguments.makes_cage) inputs.files.push_back(settings.cage);
  load_motion(cage, arguments, inputs);
  if (!settings.locality.empty()) inputs.files.push_back(settings.locality);
  inputs.shape.extension = domain_extension<Dim>();
  if (const auto& follower = arguments.follower; !follower.empty()) {
    inputs.files.push_back(follower);
    if (is_picture_file(follower)) {
      if (Dim == 3) throw InputError(follower + ": a picture needs a cage in 2D");
      inputs.picture = read_picture(follower);
      return inputs;
    }
    inputs.follower = std::make_unique<MovableModel<Dim>>(MovedFile{follower, follower});
  }
  if (settings.model.empty()) return inputs;
  inputs.files.push_back(settings.model);
  inputs.shape = load_shape<Dim>(settings.model);
  return inputs;
}

template <int Dim>
std::vector<std::string> names_of_results(const RunInputs<Dim>& inputs,
                                          const RunArguments& arguments) {
  std::vector<std::string> names{domain_file<Dim>(), kWeights, kSparseWeights, kBinding};
  if (arguments.makes_cage) names.emplace_back(kCage);
  if (inputs.shape.file) names.emplace_back(kDomainWeights);
  for (const auto& pose : inputs.poses) {
    names.push_back(name_of_deformed(pose.number, inputs.poses.size(), inputs.shape.extension));
    if (!arguments.follower.empty()) {
      names.push_back(name_of_follower(pose.number, inputs.poses.size(), arguments));
    }
  }
  names.insert(names.end(), {kSkin, kFullSkin});
  names.push_back(std::string(kFunction) + "." + arguments.pictures);
  if (!inputs.poses.empty()) {
    names.push_back(std::string(kDeformation) + "." + arguments.pictures);
  }
  names.emplace_back(kPage);
  names.emplace_back(kReport);
  return names;
}

std::string name_of_deformed(std::int64_t number, std::size_t num_poses,
                             const std::string& extension) {
  return with_number(num_poses == 1 ? "deformed" : "deformed_%03d", number) + extension;
}

std::string name_of_follower(std::int64_t number, std::size_t num_poses,
                             const RunArguments& arguments) {
  const auto& file = arguments.follower;
  const auto extension = is_picture_file(file) ? "png" : io::extension_of(file);
  return name_of_deformed(number, num_poses, "." + extension);
}

#define FLBC_INSTANTIATE(Dim)                                                 \
  template Shape<Dim> shape_of(const DomainMesh<Dim>&);                       \
  template RunInputs<Dim> load_inputs(const Cage<Dim>&, const RunArguments&); \
  template std::vector<std::string> names_of_results(const RunInputs<Dim>&, const RunArguments&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
