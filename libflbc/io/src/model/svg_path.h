// SPDX-License-Identifier: BSD-3-Clause
// Paths of SVG as cubic Bezier curves: read, sampled, fitted to moved samples, and written.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "flbc/types.h"

namespace flbc::io {

using Affine2 = Eigen::Affine2d;

constexpr double kPi = 3.14159265358979323846;

//! A cubic Bezier curve. A line has its inner control points on it.
struct Cubic {
  Eigen::Matrix<double, 2, 4> points;
  bool is_line = false;

  static Cubic line(const Vector<2>& from, const Vector<2>& to);
  Vector<2> at(double t) const;
  Vector<2> first() const { return points.col(0); }
  Vector<2> last() const { return points.col(3); }
};

//! Cubics, each from the end of the one before. A closed one ends where it begins.
struct SubPath {
  std::vector<Cubic> cubics{};
  bool is_closed = false;
};
using Path = std::vector<SubPath>;

//! Takes a number of SVG from the front of a text, with blanks and a comma before it.
//! \return whether there was one
bool take_number(std::string_view& text, double& number);

//! Reads path data as browsers do: up to the first error (SVG 1.1, appendix F.2). Arcs and
//! quadratic curves become cubics. \param is_whole  output: whether there was no error
Path parse_path(std::string_view text, bool& is_whole);

//! A part of an ellipse with half axes along x and y, by a cubic for each quarter.
//! \param from, to  angles in radians
std::vector<Cubic> arc(const Vector<2>& center, const Vector<2>& radii, double from, double to);

//! Path data with absolute commands. \param decimals  after the point, 0 to 12
std::string to_text(const Path& path, int decimals);

//! The affine map, or similarity, that is nearest to moved points in the sense of least squares.
//! That of points on a line is a similarity. \param from, to  as many points
Affine2 fitted_map(const std::vector<Vector<2>>& from, const std::vector<Vector<2>>& to,
                   bool is_similarity = false);

//! The points by which a path follows a deformation: on each cubic with equal steps of its
//! parameter, more on longer ones. The ends of a cubic are among them.
class PathSamples {
 public:
  //! \param path  must outlive them \param size  of the drawing, in the units of the path
  PathSamples(const Path& path, double size);

  std::size_t size() const { return points_.size(); }
  const std::vector<Vector<2>>& points() const { return points_; }

  //! The path through moved samples, with as few cubics as the tolerance permits. Cubics that an
  //! affine map moves stay exact, and lines that stay straight stay lines. Where cubics meet
  //! smoothly at rest, they do afterwards.
  //! \param moved  size() points
  Path fitted(const std::vector<Vector<2>>& moved, double tolerance) const;

 private:
  const Path& path_;
  std::vector<Vector<2>> points_{};
  std::vector<std::size_t> begins_{};  // of the samples of each cubic, over all subpaths
};

}  // namespace flbc::io
