// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Gaussian splats: point clouds in .ply files, as 3D Gaussian splatting trains them.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "flbc/types.h"

namespace flbc::io {

//! Whether a file is a .ply file whose vertices have all attributes of Gaussian splats: x, y, z,
//! f_dc_0 to f_dc_2, opacity, scale_0 to scale_2, rot_0 to rot_3.
//! \return false for all other files, also for those that cannot be read
bool is_splat_file(const std::string& path);

//! A file of Gaussian splats that can be deformed. A splat has a center x, y, z, the logarithms
//! scale_0 to scale_2 of its standard deviations along its axes, a quaternion rot_0 to rot_3 (w, x,
//! y, z; of any length) that rotates the axes, and colors that depend on the direction of view:
//! f_dc_0 to f_dc_2 and, for spherical harmonics up to degree 1, 2, or 3, 9, 24, or 45 numbers
//! f_rest_0 and so on, red first.
class SplatFile {
 public:
  //! Reads a binary little-endian .ply file.
  //! \throws IoError; InputError naming file and line, byte, or splat if the file is text or
  //! big-endian, ends early, lacks an attribute, has one that is not float, has another number of
  //! f_rest attributes, lists, or elements before the vertices, or has numbers that are not finite
  explicit SplatFile(const std::string& path);
  ~SplatFile();
  SplatFile(SplatFile&&) noexcept;
  SplatFile& operator=(SplatFile&&) noexcept;

  //! 3 x P centers.
  const PointList<3>& points() const;

  //! Writes the file with moved splats. A covariance S becomes J S J^T, stored as scales and
  //! quaternion. Harmonics rotate by the rotation of the polar decomposition of J, so that a splat
  //! looks the same from a camera that rotates with it. Normals nx, ny, nz, if not 0, are
  //! multiplied by the inverse transpose of J. All other bytes are unchanged, and so are scales,
  //! quaternion, harmonics, and normal where J differs from the identity by less than 1e-6.
  //! \param points  3 x P
  //! \param jacobians  9 x P, each J column by column (flbc/gradients.h)
  //! \throws InputError if numbers of splats differ, or a result is not finite in single precision
  void write(std::ostream& out, const PointList<3>& points, const Eigen::MatrixXd& jacobians) const;

 private:
  struct Content;
  std::unique_ptr<const Content> content_;
};

}  // namespace flbc::io
