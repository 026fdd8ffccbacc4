// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/skeleton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "flbc/bounding_box.h"
#include "flbc/io/model_file.h"
#include "model/gltf_edit.h"
#include "model/gltf_json.h"

namespace flbc::gltf {
namespace {

class SkeletonReader {
 public:
  explicit SkeletonReader(const io::GltfSource& source)
      : source_(source), edit_(source), document_(edit_.document) {}

  Skeleton read(const PointList<3>& control_points) {
    double least = std::numeric_limits<double>::infinity();
    Eigen::Index farthest = 0;
    for (const auto& part : source_.parts) {
      if (!part.is_skinned) continue;
      auto result = joints_of(part);
      // Of the node above the joints, in whose coordinates Blender binds them.
      Eigen::Affine3d above = Eigen::Affine3d::Identity();
      for (auto node = result.parents[result.joints[0]]; node >= 0; node = result.parents[node]) {
        if (std::count(result.joints.begin(), result.joints.end(), node) > 0) continue;
        above = io::transform_of(result.nodes[node]) * above;
      }
      const Eigen::MatrixXd places = edit_.places(part);
      Eigen::MatrixXd posed = places, bound = places;
      for (Eigen::Index k = 0; k < places.cols(); ++k) {
        posed.col(k) = part.frame(static_cast<std::size_t>(k)) * Vector<3>(places.col(k));
        bound.col(k) = above * Vector<3>(places.col(k));
      }
      for (const auto* vertices : {&posed, &bound}) {
        std::vector<Eigen::Index> nearest(control_points.cols());
        Eigen::VectorXd distances(control_points.cols());
        for (Eigen::Index i = 0; i < distances.size(); ++i) {
          distances[i] =
              (vertices->colwise() - control_points.col(i)).colwise().norm().minCoeff(&nearest[i]);
        }
        // Cages pass through files with few digits.
        if (distances.maxCoeff() <= 1e-4 * bounding_box_diagonal<3>(control_points)) {
          result.cage = places(Eigen::all, nearest);
          bind(part, nearest, vertices == &posed ? nullptr : &above, result);
          add_clips(result);
          return result;
        }
        if (distances.maxCoeff() < least) least = distances.maxCoeff(&farthest);
      }
    }
    if (std::isinf(least)) document_.fail("no mesh has a skin, as a cage with bones does");
    std::ostringstream text;
    text << "no skinned mesh has all control points of the cage: number " << farthest << " at ("
         << control_points.col(farthest).transpose() << ") is " << least
         << " away from the nearest vertex; skin the cage of the weights, and export it with the "
            "same units and axes";
    document_.fail(text.str());
  }

 private:
  io::GltfJson& skin_of(const io::GltfPart& part) {
    return document_.json.at("skins").at(io::whole(edit_.node(part.node).at("skin")));
  }

  // \param vertices  of the control points \param above  null: a model that fits the cage in the pose
  // of the file is bound in this pose
  void bind(const io::GltfPart& part, const std::vector<Eigen::Index>& vertices,
            const Eigen::Affine3d* above, Skeleton& result) {
    const auto& attributes = edit_.primitive(part, part.primitives[0]).at("attributes");
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(result.joints.size(), vertices.size());
    for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
      const auto numbers = [&](const std::string& name) {
        return document_.numbers(io::whole(attributes.at(name + std::to_string(set))), 4);
      };
      const auto numbers_of_joints = numbers("JOINTS_"), weights = numbers("WEIGHTS_");
      for (Eigen::Index i = 0; i < sums.cols(); ++i) {
        for (int slot = 0; slot < 4; ++slot) {
          const double weight = std::max(0.0, weights(slot, vertices[i]));
          if (weight > 0) sums(io::to_whole(numbers_of_joints(slot, vertices[i])), i) += weight;
        }
      }
    }
    for (auto column : sums.colwise()) {
      if (column.isZero(0)) column[0] = 1;  // as the reader of models has it
      column /= column.sum();
    }
    result.weights = WeightMatrix(sums);
    Eigen::MatrixXd inverses = Eigen::Matrix4d::Identity().reshaped().replicate(1, sums.rows());
    if (const auto& skin = skin_of(part); skin.contains("inverseBindMatrices")) {
      inverses = document_.numbers(io::whole(skin["inverseBindMatrices"]), 16);
    }
    for (const auto& place : result.places(nullptr, 0)) {
      const auto j = static_cast<Eigen::Index>(result.binds.size());
      result.cage_binds.emplace_back(Eigen::Matrix4d(inverses.col(j).reshaped(4, 4)));
      result.binds.push_back(above ? result.cage_binds.back() * above->inverse() : place.inverse());
      if (result.binds.back().matrix().allFinite()) continue;
      document_.fail("joint " + std::to_string(j) + " has a scale of 0; export it at rest");
    }
  }

  // Nodes and joints alone.
  Skeleton joints_of(const io::GltfPart& part) {
    Skeleton result;
    const auto joints = io::wholes(skin_of(part), "joints");
    number_of_.clear();
    std::map<std::size_t, std::size_t> parent_of;
    for (std::size_t k = 0; k < document_.json.at("nodes").size(); ++k) {
      for (const auto child : io::wholes(edit_.node(k), "children")) parent_of[child] = k;
    }
    for (auto node : joints) {
      while (number_of_.emplace(node, 0).second && parent_of.count(node) > 0) {
        node = parent_of[node];
      }
    }
    for (auto& [node, number] : number_of_) {
      number = result.nodes.size();
      auto& kept = result.nodes.emplace_back(edit_.node(node));
      for (const char* name : {"children", "mesh", "skin", "weights", "camera", "extensions"}) {
        kept.erase(name);
      }
    }
    for (const auto& entry : number_of_) {
      const auto parent = parent_of.find(entry.first);
      result.parents.push_back(
          parent == parent_of.end() ? -1 : static_cast<std::ptrdiff_t>(number_of_[parent->second]));
    }
    for (const auto joint : joints) result.joints.push_back(number_of_[joint]);
    return result;
  }

  void add_clips(Skeleton& result) {
    for (const auto& animation : document_.json.value("animations", io::GltfJson::array())) {
      Clip clip{animation.value("name", "")};
      std::set<double> keys;
      for (const auto& channel : animation.at("channels")) {
        const auto& target = channel.at("target");
        const auto path = target.value("path", "");
        if (!target.contains("node") || path == "weights") continue;
        const auto node = number_of_.find(io::whole(target["node"]));
        if (node == number_of_.end()) continue;
        const auto& sampler = animation.at("samplers").at(io::whole(channel.at("sampler")));
        const auto interpolation = sampler.value("interpolation", "LINEAR");
        const Eigen::RowVectorXd times = document_.numbers(io::whole(sampler.at("input")), 1);
        const auto values =
            document_.numbers(io::whole(sampler.at("output")), path == "rotation" ? 4 : 3);
        if (interpolation == "CUBICSPLINE" || times.cols() == 0 || values.cols() != times.cols()) {
          document_.fail("the animation of node \"" + result.nodes[node->second].value("name", "") +
                         "\" has splines, or no value for each key; export sampled animations");
        }
        keys.insert(times.begin(), times.end());
        clip.channels.push_back({node->second, path, interpolation == "STEP", times, values});
      }
      clip.keys.assign(keys.begin(), keys.end());
      if (!keys.empty()) result.clips.push_back(std::move(clip));
    }
  }

  const io::GltfSource& source_;
  io::GltfEdit edit_;
  io::GltfDocument& document_;
  std::map<std::size_t, std::size_t> number_of_;  // of kept nodes, by their numbers in the file
};

std::vector<double> value_at(const JointChannel& channel, double time) {
  const auto& keys = channel.keys;
  const auto next = std::upper_bound(keys.begin(), keys.end(), time) - keys.begin();
  const auto last = std::max<Eigen::Index>(next - 1, 0);
  Eigen::VectorXd value = channel.values.col(last);
  if (!channel.is_step && next > 0 && next < keys.size()) {
    const double t = (time - keys[last]) / (keys[next] - keys[last]);
    const Eigen::VectorXd to = channel.values.col(next);
    value = channel.path != "rotation"
                ? Eigen::VectorXd(value + t * (to - value))
                : Eigen::VectorXd(Eigen::Quaterniond(value.data())
                                      .slerp(t, Eigen::Quaterniond(to.data()))
                                      .coeffs());
  }
  if (channel.path == "rotation") value.normalize();
  return {value.begin(), value.end()};
}

}  // namespace

std::vector<Eigen::Affine3d> Skeleton::places(const Clip* clip, double time) const {
  auto posed = nodes;
  if (clip) {
    for (const auto& channel : clip->channels) {
      posed[channel.node][channel.path] = value_at(channel, time);
    }
  }
  std::vector<Eigen::Affine3d> result;
  for (const auto joint : joints) {
    auto& place = result.emplace_back(io::transform_of(posed[joint]));
    for (auto node = parents[joint]; node >= 0; node = parents[node]) {
      place = io::transform_of(posed[node]) * place;
    }
  }
  return result;
}

PointList<3> Skeleton::pose(const std::vector<Eigen::Affine3d>& places) const {
  PointList<3> points = PointList<3>::Zero(3, cage.cols());
  for (Index i = 0; i < weights.num_points(); ++i) {
    weights.visit(i, [&](Index j, double weight) {
      points.col(i) += weight * (places[j] * (cage_binds[j] * Vector<3>(cage.col(i))));
    });
  }
  return points;
}

Skeleton read_skeleton(const std::string& path, const PointList<3>& control_points) {
  const io::ModelFile file(path);
  if (!file.model().gltf) throw InputError(path + ": a skeleton is in a .glb, .gltf, or .vrm file");
  return io::refusing_damage(
      path, [&] { return SkeletonReader(*file.model().gltf).read(control_points); });
}

}  // namespace flbc::gltf
