// SPDX-License-Identifier: BSD-3-Clause
// A drawing in SVG that is edited: its geometry follows a deformation, everything else stays.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "flbc/types.h"

namespace flbc::io {

class SvgDocument {
 public:
  //! \param text  of the file \param name  of the file, for messages \param page  width and height
  //! \param to_model  from units of the page, with the y axis down, to those of the points
  //! \throws InputError if it is no drawing, or has too much of what it repeats (use)
  SvgDocument(const std::string& text, std::string name, const Vector<2>& page,
              const Eigen::Affine2d& to_model);
  ~SvgDocument();
  SvgDocument(SvgDocument&&) noexcept;
  SvgDocument& operator=(SvgDocument&&) noexcept;

  //! The points from which moved() computes the geometry, 2 x P.
  const PointList<2>& points() const;

  //! "path 'nose'": the element of a point, by its id if it has one.
  std::string element_of(Index point) const;

  //! The document with its geometry where the points are moved to. Elements become paths where they
  //! must, and keep all other attributes. Strokes keep their width. Text and pictures move by the
  //! similarity or affine map that fits best.
  //! \param moved  2 x P
  std::string moved(const PointList<2>& moved) const;

  //! As given to the constructor.
  const Vector<2>& page() const;
  const Eigen::Affine2d& to_model() const;

  //! What does not follow the points, a phrase each.
  const std::vector<std::string>& notes() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

//! A drawing with points in the coordinates of the model that the program takes from it.
//! \param text  of the file \param name  of the file, for messages \throws InputError
SvgDocument drawing_of(const std::string& text, const std::string& name);

//! The same of a file. \throws IoError, InputError
SvgDocument read_drawing(const std::string& path);

}  // namespace flbc::io
