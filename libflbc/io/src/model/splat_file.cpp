// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/splat_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <ostream>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/parallel.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "linear/dense.h"
#include "model/following_normals.h"
#include "model/ply_reader.h"
#include "text/bytes.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

// Real spherical harmonics of one degree, in the order and with the signs of 3D Gaussian
// splatting.
template <int Degree>
Eigen::Matrix<double, 2 * Degree + 1, 1> harmonics(const Eigen::Vector3d& d) {
  const double x = d.x(), y = d.y(), z = d.z();
  const double xx = x * x, yy = y * y, zz = z * z;
  Eigen::Matrix<double, 2 * Degree + 1, 1> values;
  if constexpr (Degree == 1) {
    values << -y, z, -x;
    values *= 0.4886025119029199;
  } else if constexpr (Degree == 2) {
    values << 1.0925484305920792 * x * y, -1.0925484305920792 * y * z,
        0.31539156525252005 * (2 * zz - xx - yy), -1.0925484305920792 * x * z,
        0.5462742152960396 * (xx - yy);
  } else {
    static_assert(Degree == 3);
    values << -0.5900435899266435 * y * (3 * xx - yy), 2.890611442640554 * x * y * z,
        -0.4570457994644658 * y * (4 * zz - xx - yy),
        0.3731763325901154 * z * (2 * zz - 3 * xx - 3 * yy),
        -0.4570457994644658 * x * (4 * zz - xx - yy), 1.445305721320277 * z * (xx - yy),
        -0.5900435899266435 * x * (xx - 3 * yy);
  }
  return values;
}

// Rotates functions that are given by coefficients: f'(d) = f(R^T d). Harmonics of one degree are
// determined by their values in 2 Degree + 1 directions, so the rotated function is interpolated
// from these.
template <int Degree>
class TurnedHarmonics {
 public:
  static constexpr int kSize = 2 * Degree + 1;
  //! Coefficients of red, green, and blue.
  using Coefficients = Eigen::Matrix<double, kSize, 3>;

  // Directions that are evenly spread over half a sphere: opposite ones would give the same values,
  // up to the sign.
  TurnedHarmonics() {
    constexpr double kGoldenAngle = 2.399963229728653;
    Eigen::Matrix<double, kSize, kSize> values;
    for (int k = 0; k < kSize; ++k) {
      const double z = (k + 0.5) / kSize;
      const double radius = std::sqrt(1 - z * z);
      const double angle = k * kGoldenAngle;
      directions_.col(k) << radius * std::cos(angle), radius * std::sin(angle), z;
      values.row(k) = harmonics<Degree>(directions_.col(k)).transpose();
    }
    from_values_ = values.inverse();
  }

  Coefficients turn(const Eigen::Matrix3d& rotation, const Coefficients& coefficients) const {
    Coefficients values;
    for (int k = 0; k < kSize; ++k) {
      const Eigen::Vector3d before = rotation.transpose() * directions_.col(k);
      values.row(k) = harmonics<Degree>(before).transpose() * coefficients;
    }
    return from_values_ * values;
  }

 private:
  Eigen::Matrix<double, 3, kSize> directions_;
  Eigen::Matrix<double, kSize, kSize> from_values_;
};

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The rotation of the polar decomposition, by Newton's method where J is far from singular.
Matrix3d rotation_of(const Matrix3d& j) {
  const double scale = std::cbrt(std::abs(j.determinant()));
  if (!(j.determinant() > 0) || scale < 0.05 * j.norm()) return dense::nearest_rotation(j);
  Matrix3d r = j / scale;
  for (int k = 0; k < 30; ++k) {
    const Matrix3d next = 0.5 * (r + r.inverse().transpose());
    const bool is_done = (next - r).squaredNorm() < 1e-20;
    r = next;
    if (is_done) break;
  }
  return r;
}

}  // namespace

struct SplatFile::Content {
  explicit Content(const std::string& path);

  // The byte of a number of a splat.
  std::size_t byte(Index splat, std::size_t offset) const {
    return begin + splat * stride + offset;
  }

  template <std::size_t N>
  Eigen::Matrix<double, int(N), 1> read(Index splat,
                                        const std::array<std::size_t, N>& offsets) const {
    Eigen::Matrix<double, int(N), 1> values;
    for (std::size_t k = 0; k < N; ++k) {
      values[static_cast<int>(k)] = number_at<float>(text.data() + byte(splat, offsets[k]));
    }
    return values;
  }

  // Both change the bytes of a splat. They return whether all numbers are finite in single
  // precision.
  bool deform(char* moved, Index splat, const Vector3d& point, const Matrix3d& j) const;
  template <int Degree>
  bool turn(char* moved, Index splat, const Matrix3d& rotation) const;

  template <std::size_t N>
  bool put(char* moved, const std::array<std::size_t, N>& offsets,
           const Eigen::Matrix<double, int(N), 1>& values) const {
    for (std::size_t k = 0; k < N; ++k) {
      const auto value = static_cast<float>(values[static_cast<int>(k)]);
      if (!std::isfinite(value)) return false;
      put_number(value, moved + offsets[k]);
    }
    return true;
  }

  std::string text;
  std::size_t begin = 0;   // of the splats
  std::size_t stride = 0;  // bytes of one
  std::array<std::size_t, 3> center{}, scale{};
  std::array<std::size_t, 4> rotation{};
  std::array<std::size_t, 3> normal{};
  bool has_normals = false;
  std::vector<std::size_t> rest;  // f_rest_0 and so on
  int degree = 0;
  PointList<3> points;
  TurnedHarmonics<1> first;
  TurnedHarmonics<2> second;
  TurnedHarmonics<3> third;
};

SplatFile::Content::Content(const std::string& path) : text(read_file(path)) {
  const PlyReader reader(path, text);
  const auto fail = [&](const std::string& message) { throw InputError(path + ": " + message); };
  if (!reader.is_binary_little_endian()) {
    fail("splats must be binary and little-endian (format binary_little_endian 1.0)");
  }
  if (reader.elements().empty() || reader.elements().front().name != "vertex") {
    fail("the vertices must be the first element of a file of splats");
  }
  const auto& element = reader.elements().front();
  std::vector<std::size_t> offsets;
  for (const auto& property : element.properties) {
    if (property.count_type) fail("property " + in_quotes(property.name) + " is a list");
    offsets.push_back(stride);
    stride += property.type->bytes;
  }
  const auto find = [&](const std::string& name) {
    const int k = element.find(name);
    if (k < 0) fail("the splats have no property " + in_quotes(name));
    const auto& type = *element.properties[k].type;
    if (type.kind != 'f' || type.bytes != 4) fail("property " + in_quotes(name) + " is not float");
    return offsets[k];
  };
  for (const char* name : kSplatProperties) find(name);
  center = {find("x"), find("y"), find("z")};
  scale = {find("scale_0"), find("scale_1"), find("scale_2")};
  rotation = {find("rot_0"), find("rot_1"), find("rot_2"), find("rot_3")};
  has_normals = element.find("nx") >= 0;
  if (has_normals) normal = {find("nx"), find("ny"), find("nz")};
  for (int k = 0; element.find("f_rest_" + std::to_string(k)) >= 0; ++k) {
    rest.push_back(find("f_rest_" + std::to_string(k)));
  }
  while (degree < 4 && 3 * ((degree + 1) * (degree + 1) - 1) != static_cast<int>(rest.size())) {
    ++degree;
  }
  if (degree > 3) {
    fail("there are " + std::to_string(rest.size()) +
         " properties f_rest; degrees 0 to 3 have 0, 9, 24, or 45");
  }
  begin = reader.position();
  const auto count = static_cast<std::size_t>(element.count);
  if (count > (text.size() - begin) / stride) {
    fail("ends within splat " + std::to_string((text.size() - begin) / stride) + " of " +
         std::to_string(element.count));
  }
  points.resize(3, static_cast<Eigen::Index>(count));
  for (Index p = 0; p < points.cols(); ++p) {
    points.col(p) = read(p, center);
    const bool is_finite =
        points.col(p).allFinite() && read(p, scale).allFinite() && read(p, rotation).allFinite();
    if (!is_finite) fail("splat " + std::to_string(p) + " has numbers that are not finite");
    if (read(p, rotation).isZero(0)) fail("the quaternion of splat " + std::to_string(p) + " is 0");
  }
}

template <int Degree>
bool SplatFile::Content::turn(char* moved, Index splat, const Matrix3d& by) const {
  if (degree < Degree) return true;
  const std::size_t per_channel = rest.size() / 3;
  constexpr std::size_t kBefore = Degree * Degree - 1;
  typename TurnedHarmonics<Degree>::Coefficients coefficients;
  const auto offset = [&](int channel, int k) {
    return std::array<std::size_t, 1>{rest[channel * per_channel + kBefore + k]};
  };
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 2 * Degree + 1; ++k) coefficients(k, c) = read(splat, offset(c, k))[0];
  }
  if constexpr (Degree == 1) coefficients = first.turn(by, coefficients);
  if constexpr (Degree == 2) coefficients = second.turn(by, coefficients);
  if constexpr (Degree == 3) coefficients = third.turn(by, coefficients);
  bool is_finite = true;
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 2 * Degree + 1; ++k) {
      is_finite &= put(moved, offset(c, k), Eigen::Matrix<double, 1, 1>(coefficients(k, c)));
    }
  }
  return is_finite;
}

bool SplatFile::Content::deform(char* moved, Index splat, const Vector3d& point,
                                const Matrix3d& j) const {
  constexpr double kStill = 1e-6;
  if (!j.allFinite() || !put(moved, center, point)) return false;
  if ((j - Matrix3d::Identity()).norm() < kStill) return true;
  const Eigen::Vector4d q = read(splat, rotation);
  const Matrix3d axes = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  // A root of the covariance: J S J^T = root root^T.
  const Matrix3d root = j * axes * read(splat, scale).array().exp().matrix().asDiagonal();
  const Matrix3d covariance = root * root.transpose();
  Matrix3d new_axes = dense::fast_principal_axes(covariance);
  if (new_axes.determinant() < 0) new_axes.col(0) *= -1;
  // From the root, because the least eigenvalue of the covariance would lose its digits.
  const Vector3d deviations = (new_axes.transpose() * root).rowwise().norm();
  constexpr double kLeast = 1e-30;  // of a splat that was flattened
  bool is_finite = put(moved, scale, Vector3d(deviations.array().max(kLeast).log()));
  const Eigen::Quaterniond turned(new_axes);
  is_finite &=
      put(moved, rotation, Eigen::Vector4d(turned.w(), turned.x(), turned.y(), turned.z()));
  if (has_normals) {
    const Vector3d n = read(splat, normal);
    if (!n.isZero(0)) is_finite &= put(moved, normal, transformed_normal(j, n));
  }
  if (degree == 0) return is_finite;
  const Matrix3d by = rotation_of(j);
  return is_finite && turn<1>(moved, splat, by) && turn<2>(moved, splat, by) &&
         turn<3>(moved, splat, by);
}

bool is_splat_file(const std::string& path) {
  if (extension_of(path) != "ply") return false;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line) || line.rfind("ply", 0) != 0) return false;
  std::vector<std::string> names;
  constexpr int kMaxLines = 1000;
  for (int k = 0; k < kMaxLines && std::getline(file, line); ++k) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line == "end_header") break;
    if (line.rfind("property ", 0) == 0) names.push_back(line.substr(line.rfind(' ') + 1));
  }
  return std::all_of(
      std::begin(kSplatProperties), std::end(kSplatProperties),
      [&](const char* name) { return std::find(names.begin(), names.end(), name) != names.end(); });
}

SplatFile::SplatFile(const std::string& path) : content_(std::make_unique<Content>(path)) {
}
SplatFile::~SplatFile() = default;
SplatFile::SplatFile(SplatFile&&) noexcept = default;
SplatFile& SplatFile::operator=(SplatFile&&) noexcept = default;

const PointList<3>& SplatFile::points() const {
  return content_->points;
}

void SplatFile::write(std::ostream& out, const PointList<3>& points,
                      const Eigen::MatrixXd& jacobians) const {
  const auto count = content_->points.cols();
  if (points.cols() != count || jacobians.cols() != count || jacobians.rows() != 9) {
    throw InputError("the file has " + std::to_string(count) + " splats, but there are " +
                     std::to_string(points.cols()) + " points and " +
                     std::to_string(jacobians.cols()) + " Jacobians");
  }
  const std::string& text = content_->text;
  const std::size_t stride = content_->stride;
  constexpr Index kBlock = 1 << 16;  // a copy of the whole file would take long to allocate
  std::string moved;
  std::size_t done = content_->begin;
  out.write(text.data(), static_cast<std::streamsize>(done));
  for (Index first = 0; first < count; first += kBlock) {
    const Index size = std::min(kBlock, static_cast<Index>(count) - first);
    moved.assign(text, done, size * stride);
    const Index first_bad = first_where(size, [&](Index k) {
      const Index p = first + k;
      const Matrix3d j = jacobians.col(p).reshaped(3, 3);
      return !content_->deform(moved.data() + k * stride, p, points.col(p), j);
    });
    if (first_bad < size) {
      throw InputError("splat " + std::to_string(first + first_bad) +
                       " would have numbers that are not finite in single precision");
    }
    out.write(moved.data(), static_cast<std::streamsize>(moved.size()));
    done += moved.size();
  }
  out.write(text.data() + done, static_cast<std::streamsize>(text.size() - done));
}

}  // namespace flbc::io
