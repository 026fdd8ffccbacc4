// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/glb_writer.h"

#include <limits>
#include <sstream>

#include <Eigen/Geometry>

namespace flbc::gltf {
namespace {

constexpr double kFrames = 24;  // per second, in which times are counted

// "(x, y, z)" of a column.
template <class Column>
std::string tuple(const Column& column) {
  std::ostringstream text;
  text.precision(std::numeric_limits<float>::max_digits10);
  for (Eigen::Index k = 0; k < column.size(); ++k) text << (k == 0 ? "(" : ", ") << column[k];
  text << ')';
  return text.str();
}

// "[a, b, c]" from the output of write(k).
template <class Write>
std::string list(Eigen::Index count, const Write& write) {
  std::ostringstream text;
  text.precision(std::numeric_limits<float>::max_digits10);
  text << '[';
  for (Eigen::Index k = 0; k < count; ++k) {
    if (k > 0) text << ", ";
    text << write(k);
  }
  text << ']';
  return text.str();
}

template <class Matrix>
std::string columns(const Matrix& matrix) {
  return list(matrix.cols(), [&](Eigen::Index k) { return tuple(matrix.col(k)); });
}

template <class Matrix>
std::string numbers(const Matrix& matrix) {
  return list(matrix.size(), [&](Eigen::Index k) { return +matrix.reshaped()[k]; });
}

std::string repeated(Eigen::Index count, const char* value) {
  return list(count, [&](Eigen::Index) { return value; });
}

// Some readers require a single root that precedes its children: a joint at the origin that never
// moves.
constexpr int kRoots = 1;

Eigen::Matrix3Xf with_root(const Eigen::Matrix3Xf& joints) {
  Eigen::Matrix3Xf all = Eigen::Matrix3Xf::Zero(3, kRoots + joints.cols());
  all.rightCols(joints.cols()) = joints;
  return all;
}

std::string joint_names(const GlbScene& scene) {
  return list(kRoots + scene.joints.cols(), [&](Eigen::Index j) -> std::string {
    return j < kRoots ? "\"cage\"" : "\"cage/" + joint_name(scene, j - kRoots) + '"';
  });
}

// Metadata over several lines, as usdcat writes it: other readers, such as that of three.js, need
// the line breaks.
constexpr char kBinding[] = " (\n        prepend apiSchemas = [\"SkelBindingAPI\"]\n    )\n";

void write_skeleton(std::ostream& text, const GlbScene& scene) {
  const auto joints = with_root(scene.joints);
  const auto binds = list(joints.cols(), [&](Eigen::Index j) {
    return "((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), " +
           tuple(Eigen::Vector4f(joints.col(j).homogeneous())) + ')';
  });
  text << "    def Skeleton \"cage\"" << kBinding << "    {\n"
       << "        uniform token[] joints = " << joint_names(scene) << '\n'
       << "        uniform matrix4d[] bindTransforms = " << binds << '\n'
       << "        uniform matrix4d[] restTransforms = " << binds << '\n';
  if (!scene.channels.empty()) text << "        rel skel:animationSource = </model/poses>\n";
  text << "    }\n";
}

// \param pose(k)  the list of a property of all joints at time k
template <class PoseAt>
void write_samples(std::ostream& text, const GlbScene& scene, const char* property,
                   const PoseAt& pose) {
  text << "        " << property << ".timeSamples = {\n";
  for (std::size_t k = 0; k < scene.times.size(); ++k) {
    text << "            " << kFrames * scene.times[k] << ": " << pose(static_cast<Eigen::Index>(k))
         << ",\n";
  }
  text << "        }\n";
}

void write_animation(std::ostream& text, const GlbScene& scene) {
  if (scene.channels.empty()) return;
  const auto count = kRoots + scene.joints.cols();
  text << "    def SkelAnimation \"poses\"\n    {\n"
       << "        uniform token[] joints = " << joint_names(scene) << '\n';
  if (scene.solid_regions > 0) {
    write_samples(text, scene, "quatf[] rotations", [&](Eigen::Index k) {
      Eigen::Matrix4Xf turns(4, count);  // w, x, y, z
      turns.colwise() = Eigen::Vector4f::UnitX();
      for (const auto& channel : scene.channels) {
        if (channel.rotations.cols() == 0) continue;
        turns.col(kRoots + channel.joint) = channel.rotations({3, 0, 1, 2}, k);
      }
      return columns(turns);
    });
  } else {
    text << "        quatf[] rotations = " << repeated(count, "(1, 0, 0, 0)") << '\n';
  }
  text << "        half3[] scales = " << repeated(count, "(1, 1, 1)") << '\n';
  write_samples(text, scene, "float3[] translations", [&](Eigen::Index k) {
    Eigen::Matrix3Xf pose = scene.joints;
    for (const auto& channel : scene.channels)
      pose.col(channel.joint) = channel.translations.col(k);
    return columns(with_root(pose));
  });
  text << "    }\n";
}

void write_surface(std::ostream& text, const GlbScene& scene) {
  const auto& surface = scene.surface;
  const auto slots = scene.weights.joints.rows();
  const auto num_joints = static_cast<int>(scene.joints.cols());
  const Eigen::MatrixXi joints = scene.weights.joints.cast<int>().unaryExpr(
      [num_joints](int joint) { return joint == num_joints ? 0 : joint + kRoots; });
  const std::string per_vertex = " (\n            interpolation = \"vertex\"\n        )\n";
  const std::string per_slot =
      " (\n            elementSize = " + std::to_string(slots) + per_vertex.substr(2);
  text << "    def Mesh \"surface\"" << kBinding << "    {\n"
       << "        uniform bool doubleSided = 1\n"
       << "        uniform token subdivisionScheme = \"none\"\n"
       << "        int[] faceVertexCounts = " << repeated(surface.triangles.cols(), "3") << '\n'
       << "        int[] faceVertexIndices = " << numbers(surface.triangles) << '\n'
       << "        point3f[] points = " << columns(scene.positions) << '\n'
       << "        normal3f[] normals = " << columns(surface.normals.cast<float>().eval())
       << per_vertex;
  if (surface.texture_coordinates.cols() > 0) {
    Eigen::Matrix2Xf upwards =
        surface.texture_coordinates.cast<float>();  // glTF counts from the top
    upwards.row(1) = 1 - upwards.row(1).array();
    text << "        texCoord2f[] primvars:st = " << columns(upwards) << per_vertex;
  }
  if (surface.colors.cols() > 0) {
    text << "        color3f[] primvars:displayColor = "
         << columns(surface.colors.cast<float>().eval()) << per_vertex;
  }
  text << "        int[] primvars:skel:jointIndices = " << numbers(joints) << per_slot
       << "        float[] primvars:skel:jointWeights = " << numbers(scene.weights.numbers)
       << per_slot
       << "        matrix4d primvars:skel:geomBindTransform = ((1, 0, 0, 0), (0, 1, 0, 0), "
          "(0, 0, 1, 0), (0, 0, 0, 1))\n"
       << "        rel skel:skeleton = </model/cage>\n    }\n";
}

}  // namespace

std::string encode_usda(const GlbScene& scene) {
  std::ostringstream text;
  text << "#usda 1.0\n(\n    defaultPrim = \"model\"\n    upAxis = \"Y\"\n"
       << "    timeCodesPerSecond = " << kFrames << '\n';
  if (!scene.channels.empty()) {
    text << "    startTimeCode = " << kFrames * scene.times.front()
         << "\n    endTimeCode = " << kFrames * scene.times.back() << '\n';
  }
  text << ")\n\ndef SkelRoot \"model\"\n{\n";
  if (!scene.turn.isIdentity(0)) {
    const auto& turn = scene.turn;  // USD multiplies rows by matrices
    text << "    matrix4d xformOp:transform = (";
    for (int k = 0; k < 3; ++k) {
      text << '(' << turn(0, k) << ", " << turn(1, k) << ", " << turn(2, k) << ", 0), ";
    }
    text << "(0, 0, 0, 1))\n    uniform token[] xformOpOrder = [\"xformOp:transform\"]\n";
  }
  write_skeleton(text, scene);
  write_animation(text, scene);
  write_surface(text, scene);
  text << "}\n";
  return text.str();
}

}  // namespace flbc::gltf
