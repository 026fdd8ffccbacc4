// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/poses.h"
#include "flbc/sparsify_error.h"
#include "gltf/glb_writer.h"

namespace flbc::gltf {
namespace {

constexpr Eigen::Index kMaxJoints = std::numeric_limits<std::uint16_t>::max();
using RowVector = Eigen::Matrix<Index, 1, Eigen::Dynamic>;

// Every integer up to this is a float.
constexpr Eigen::Index kMaxExactFloat = 1 << 24;

void require_equal(Eigen::Index found, Eigen::Index expected, const char* what) {
  if (found == expected) return;
  throw InputError("the skin needs " + std::string(what) + " for " + std::to_string(expected) +
                   ", but there are some for " + std::to_string(found));
}

template <int Dim>
void check(const PointList<Dim>& control_points, const PointList<Dim>& points,
           const SparseWeights& weights, const Surface& surface, const SkinOptions& options,
           std::size_t num_regions = 0) {
  if (options.max_influences != 4 && options.max_influences != 8) {
    throw OptionError("a skin has at most 4 or 8 influences per vertex, not " +
                      std::to_string(options.max_influences));
  }
  const auto num_joints = control_points.cols() + static_cast<Eigen::Index>(num_regions);
  if (num_joints > kMaxJoints) {
    throw InputError("the cage has " + std::to_string(num_joints) +
                     " control points and rigid regions, but a skin can have " +
                     std::to_string(kMaxJoints) + " joints at most");
  }
  require_equal(weights.num_control_points(), control_points.cols(), "weights of control points");
  require_equal(weights.num_points(), points.cols(), "weights of points");
  const auto num_vertices = static_cast<Eigen::Index>(surface.sources.size());
  require_equal(surface.normals.cols(), num_vertices, "normals of vertices");
  const auto is_of = [](const auto& indices, Eigen::Index size) {
    return std::all_of(indices.begin(), indices.end(),
                       [&](Index index) { return index >= 0 && index < size; });
  };
  if (surface.triangles.cols() == 0 || !is_of(surface.triangles.reshaped(), num_vertices) ||
      !is_of(surface.sources, points.cols())) {
    throw InputError("the surface of the skin is empty, or not one of these points");
  }
}

// In space, in single precision. \param owner  for messages
template <int Dim>
Eigen::Matrix3Xf to_floats(const PointList<Dim>& points, const std::string& owner) {
  Eigen::Matrix3Xf result = Eigen::Matrix3Xf::Zero(3, points.cols());
  result.topRows<Dim>() = points.template cast<float>();
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    if (result.col(k).allFinite()) continue;
    throw InputError("vertex " + std::to_string(k) + " of " + owner +
                     " has a coordinate that is too large for single precision, which glTF has");
  }
  return result;
}

// The joints of a skin: n control points, and the R solid regions that are to stay rigid.
template <int Dim>
struct Joints {
  const std::vector<std::vector<Index>>& solid;
  PointList<Dim> rest{};  // Dim x (n + R): control points, then centers of regions
  std::vector<PointList<Dim>> poses{};
  std::vector<Eigen::Matrix4Xf> turns{};  // a quaternion per region and pose: x, y, z, w
};

// \param matrix  orthogonal \param before  quaternion in the pose before, of which one of the two
// that stand for the rotation is nearer
template <int Dim>
Eigen::Vector4f quaternion_of(const Eigen::Matrix<double, Dim, Dim>& matrix,
                              const Eigen::Vector4f& before) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<Dim, Dim>() = matrix;
  const Eigen::Vector4f result = Eigen::Quaterniond(turn).coeffs().cast<float>();
  return result.dot(before) < 0 ? Eigen::Vector4f(-result) : result;
}

// Moves each region by the rigid map that is nearest to its deformation by the cage.
// \param distances  get how far it is from it, of each point
template <int Dim>
Joints<Dim> joints_of(const Binding<Dim>& binding, const std::vector<std::vector<Index>>& solid,
                      const std::vector<PointList<Dim>>& poses, std::vector<double>& distances) {
  const PointList<Dim> points = binding.rest();
  const auto num_regions = static_cast<Eigen::Index>(solid.size());
  Joints<Dim> joints{solid};
  joints.rest.resize(Dim, binding.cage.points.cols() + num_regions);
  joints.rest.leftCols(binding.cage.points.cols()) = binding.cage.points;
  for (Eigen::Index r = 0; r < num_regions; ++r) {
    joints.rest.col(binding.cage.points.cols() + r) = points(Eigen::all, solid[r]).rowwise().mean();
  }
  Eigen::Matrix4Xf turns = Eigen::Vector4f::UnitW().replicate(1, num_regions);
  for (const auto& pose : poses) {
    PointList<Dim> moved;
    if (num_regions > 0) moved = binding.deform(pose);
    auto places = joints.rest;
    places.leftCols(pose.cols()) = pose;
    for (Eigen::Index r = 0; r < num_regions; ++r) {
      const PointList<Dim> from = points(Eigen::all, solid[r]), to = moved(Eigen::all, solid[r]);
      Eigen::Transform<double, Dim, Eigen::Affine> map;
      map.setIdentity();
      if (from != to) map.matrix() = Eigen::umeyama(from, to, false);
      places.col(pose.cols() + r) = map * Vector<Dim>(places.col(pose.cols() + r));
      turns.col(r) = quaternion_of<Dim>(map.linear(), turns.col(r));
      for (Eigen::Index p = 0; p < from.cols(); ++p) {
        distances.push_back((map * Vector<Dim>(from.col(p)) - to.col(p)).norm());
      }
    }
    joints.poses.push_back(std::move(places));
    joints.turns.push_back(turns);
  }
  return joints;
}

// The points of a region belong to its joint.
SparseWeights with_regions(const SparseWeights& weights,
                           const std::vector<std::vector<Index>>& solid) {
  if (solid.empty()) return weights;
  const auto num_points = weights.num_control_points();
  std::map<Index, Index> joint_of;
  for (std::size_t r = 0; r < solid.size(); ++r) {
    for (const Index p : solid[r]) joint_of[p] = num_points + static_cast<Index>(r);
  }
  const auto num_joints = num_points + static_cast<Index>(solid.size());
  return SparseWeights::of(num_joints, weights.num_points(), [&](Index p) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(num_joints);
    const auto joint = joint_of.find(p);
    if (joint == joint_of.end()) {
      row.head(num_points) = weights.at(p);
    } else {
      row[joint->second] = 1;
    }
    return row;
  });
}

// A channel for every joint that moves in some pose.
template <int Dim>
std::vector<Channel> channels_of(const Joints<Dim>& joints, const Eigen::Matrix3Xf& rest,
                                 const Vector<Dim>& origin) {
  std::vector<Eigen::Matrix3Xf> poses;
  for (const auto& pose : joints.poses) {
    poses.push_back(to_floats<Dim>(pose.colwise() - origin,
                                   "the cage in pose " + std::to_string(poses.size())));
  }
  const auto first_region = rest.cols() - static_cast<Eigen::Index>(joints.solid.size());
  std::vector<Channel> channels;
  for (Eigen::Index i = 0; i < rest.cols(); ++i) {
    Channel channel{static_cast<Index>(i), Eigen::Matrix3Xf(3, poses.size())};
    for (std::size_t k = 0; k < poses.size(); ++k) channel.translations.col(k) = poses[k].col(i);
    bool moves = (channel.translations.colwise() - rest.col(i)).cwiseAbs().sum() > 0;
    if (i >= first_region) {
      channel.rotations.resize(4, channel.translations.cols());
      for (std::size_t k = 0; k < poses.size(); ++k) {
        channel.rotations.col(k) = joints.turns[k].col(i - first_region);
      }
      moves = moves || channel.rotations.topRows<3>().cwiseAbs().sum() > 0;
    }
    if (moves) channels.push_back(std::move(channel));
  }
  return channels;
}

bool is_identity(const std::vector<Index>& sources, Eigen::Index num_points) {
  for (std::size_t v = 0; v < sources.size(); ++v) {
    if (sources[v] != static_cast<Index>(v)) return false;
  }
  return static_cast<Eigen::Index>(sources.size()) == num_points;
}

// The center of the cage if it is so far from the origin that float spacing exceeds 1e-6 of its
// size; otherwise zero.
template <int Dim>
Vector<Dim> origin_of(const PointList<Dim>& control_points, SkinFormat format) {
  const Vector<Dim> low = control_points.rowwise().minCoeff();
  const Vector<Dim> high = control_points.rowwise().maxCoeff();
  const bool is_far = (low + high).norm() / 2 > 16 * (high - low).norm();
  if (format != SkinFormat::kGlb || !is_far) return Vector<Dim>::Zero();
  return (low + high) / 2;
}

template <int Dim>
GlbScene make_scene(const PointList<Dim>& points, const JointWeights& stored,
                    const Surface& surface, const Vector<Dim>& origin, bool keeps_document) {
  const auto& sources = surface.sources;
  GlbScene scene{surface};
  scene.origin.head<Dim>() = origin;
  if (keeps_document) scene.document = surface.gltf;
  if (scene.document) {
    scene.weights = stored;
  } else {
    scene.positions = to_floats<Dim>(points.colwise() - origin, "the model")(Eigen::all, sources);
    if (!is_identity(sources, points.cols()) && points.cols() <= kMaxExactFloat) {
      const auto count = static_cast<Eigen::Index>(sources.size());
      scene.sources = Eigen::Map<const RowVector>(sources.data(), count).cast<float>();
    }
    scene.weights = {stored.joints(Eigen::all, sources), stored.numbers(Eigen::all, sources)};
  }
  return scene;
}

ExportedSkin encode(const GlbScene& scene, const SkinOptions& options, const Surface& surface) {
  ExportedSkin result;
  for (const auto& file : surface.missing_files) {
    result.left_out.push_back("materials: " + file + " cannot be read");
  }
  result.content =
      options.format == SkinFormat::kUsda ? encode_usda(scene) : encode_glb(scene, result.left_out);
  result.vertices = static_cast<Index>(surface.sources.size());
  if (scene.document) {
    result.vertices = 0;
    for (const auto& part : scene.document->parts) {
      result.vertices += static_cast<Index>(part.points.size());
    }
  }
  result.triangles = static_cast<Index>(surface.triangles.cols());
  result.joints = static_cast<Index>(scene.num_joints());
  return result;
}

// The shift of a point at rest that moves it by this much. Joints that press it flat can move it
// within a plane only.
Vector<3> shift_for(const Eigen::Matrix3d& linear, const Vector<3>& move) {
  constexpr double kFlat = 1e-3;
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> solver;
  solver.setThreshold(kFlat);
  return solver.compute(linear).solve(move);
}

ErrorNorms norms_of(const std::vector<double>& lengths) {
  const Eigen::Map<const Eigen::VectorXd> all(lengths.data(),
                                              static_cast<Eigen::Index>(lengths.size()));
  return all.size() == 0
             ? ErrorNorms{}
             : ErrorNorms{std::sqrt(all.squaredNorm() / static_cast<double>(all.size())),
                          all.maxCoeff()};
}

// The errors of the stored skin at the points that are vertices and not in rigid regions.
template <int Dim>
void measure(const PointList<Dim>& points, const SparseWeights& weights, const JointWeights& stored,
             const std::vector<Index>& sources, const std::vector<PointList<Dim>>& poses,
             const Vector<Dim>& origin, ExportedSkin& result) {
  auto used = sources;
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const PointList<Dim> exact = points(Eigen::all, used).colwise() - origin;
  const PointList<Dim> rounded = exact.template cast<float>().template cast<double>();
  result.position_change = (rounded - exact).colwise().norm().maxCoeff();

  const auto of_used = [&](const SparseWeights& all) {
    return SparseWeights::of(all.num_control_points(), static_cast<Index>(used.size()),
                             [&](Index v) { return all.at(used[v]); });
  };
  const auto before = of_used(weights);
  const auto after = of_used(to_weights(stored, weights.num_control_points()));
  result.given_influences = count_influences(before).max;
  result.influences = count_influences(after).max;
  result.deformation_error = deformation_error(poses, before, after);
}

}  // namespace

template <int Dim>
void validate(const Animation<Dim>& animation, Eigen::Index num_control_points) {
  require_equal(static_cast<Eigen::Index>(animation.times.size()),
                static_cast<Eigen::Index>(animation.poses.size()), "times of poses");
  for (std::size_t k = 0; k < animation.times.size(); ++k) {
    require_equal(animation.poses[k].cols(), num_control_points, "poses of control points");
    const auto time = static_cast<float>(animation.times[k]);
    std::ostringstream text;
    text << "pose " << k << " is at " << animation.times[k] << " s, ";
    if (!(time >= 0) || !std::isfinite(time)) {
      throw InputError(text.str() + "but an animation in glTF starts at 0 or later");
    }
    if (k > 0 && !(time > static_cast<float>(animation.times[k - 1]))) {
      throw InputError(text.str() + "not later than the one before it");
    }
  }
}

template <int Dim>
ExportedSkin export_skin(const Binding<Dim>& binding, const Surface& surface,
                         const SkinOptions& options, const Animation<Dim>& animation) {
  const auto& control_points = binding.cage.points;
  const PointList<Dim> points = binding.rest();
  const auto& weights = binding.weights;
  if (options.rigid && binding.solid.empty()) {
    throw InputError(
        "no region is solid, so none can be rigid; bind with solid regions (\"solid\" in a "
        "locality file)");
  }
  const std::vector<std::vector<Index>> none, &solid = options.rigid ? binding.solid : none;
  check(control_points, points, weights, surface, options, solid.size());
  validate(animation, control_points.cols());
  const auto few = binding.reduced({options.max_influences}, animation.poses).weights;
  constexpr int kRandomPoses = 20;
  const auto poses =
      animation.poses.empty() ? smooth_poses(control_points, kRandomPoses) : animation.poses;
  std::vector<double> bent;  // distances
  const auto joints = joints_of(binding, solid, poses, bent);

  const Vector<Dim> origin = origin_of(control_points, options.format);
  const bool is_usd = options.format == SkinFormat::kUsda;
  const auto stored = to_joint_weights(with_regions(few, solid));
  auto scene = make_scene(points, stored, surface, origin, !is_usd);
  scene.joints = to_floats<Dim>(joints.rest.colwise() - origin, "the cage");
  scene.solid_regions = static_cast<Index>(solid.size());
  scene.times.assign(animation.times.begin(), animation.times.end());
  if (!scene.times.empty()) scene.channels = channels_of(joints, scene.joints, origin);
  scene.name = options.name;
  scene.turn = options.turn;

  auto result = encode(scene, options, surface);
  result.moving_joints = static_cast<Index>(scene.channels.size());
  measure(points, weights, solid.empty() ? stored : to_joint_weights(few), surface.sources, poses,
          origin, result);
  if (!solid.empty()) result.rigid_error = norms_of(bent);
  return result;
}

ExportedSkin export_skin(const Binding<3>& binding, const Surface& surface,
                         const SkinOptions& options, const Skeleton& skeleton, bool corrects) {
  if (options.format != SkinFormat::kGlb) {
    throw OptionError("joints of a skeleton can be written as .glb only");
  }
  const PointList<3> points = binding.rest();
  check(binding.cage.points, points, binding.weights, surface, options);
  const auto bones = skin(binding.weights, skeleton.weights);
  const auto stored =
      to_joint_weights(skin(binding.weights, skeleton.weights, options.max_influences));
  auto scene = make_scene<3>(points, stored, surface, Vector<3>::Zero(), true);
  scene.name = options.name;
  scene.skeleton = &skeleton;
  std::vector<double> skinned, corrected;  // distances
  std::set<std::size_t> moving;
  for (const auto& clip : skeleton.clips) {
    for (const auto& channel : clip.channels) moving.insert(channel.node);
    for (const double key : clip.keys) {
      auto places = skeleton.places(&clip, key);
      const auto targets = binding.deform(skeleton.pose(places));
      for (std::size_t j = 0; j < places.size(); ++j) places[j] = places[j] * skeleton.binds[j];
      places.push_back(Eigen::Affine3d::Identity());
      Eigen::Matrix3Xf correction(3, points.cols());
      for (Eigen::Index p = 0; p < points.cols(); ++p) {
        Eigen::Affine3d frame(Eigen::Matrix4d::Zero());
        for (Eigen::Index slot = 0; slot < stored.joints.rows(); ++slot) {
          frame.matrix() += stored.numbers(slot, p) * places[stored.joints(slot, p)].matrix();
        }
        Vector<3> error = targets.col(p) - frame * Vector<3>(points.col(p));
        skinned.push_back(error.norm());
        if (!corrects) continue;
        correction.col(p) = shift_for(frame.linear(), error).cast<float>();
        corrected.push_back((error - frame.linear() * correction.col(p).cast<double>()).norm());
      }
      if (!corrects) continue;
      scene.corrections.push_back(scene.document ? correction
                                                 : correction(Eigen::all, surface.sources).eval());
    }
  }
  auto result = encode(scene, options, surface);
  for (const auto joint : skeleton.joints) {
    result.moving_joints += static_cast<Index>(moving.count(joint));
  }
  for (const auto& clip : skeleton.clips) result.keys += clip.keys.size();
  result.given_influences = count_influences(bones).max;
  result.influences = count_influences(to_weights(stored, scene.num_joints())).max;
  result.skeleton_error = norms_of(skinned);
  if (corrects) result.corrected_error = norms_of(corrected);
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                                                \
  template void validate(const Animation<Dim>&, Eigen::Index);                               \
  template ExportedSkin export_skin(const Binding<Dim>&, const Surface&, const SkinOptions&, \
                                    const Animation<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::gltf
