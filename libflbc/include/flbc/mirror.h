// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Exact mirror symmetry of weights, also where mesh and model are not symmetric.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/place_masks.h"

namespace flbc {

//! A part of a model, for a reduction.
template <int Dim>
struct ModelPart {
  PointList<Dim> points;
  EdgeList edges;
  SparseWeights weights;
  std::vector<Mask> masks;

  //! Some of its points, with the edges between them.
  //! \param chosen  points \param numbers  output: the number of each point in the part, -1: none
  ModelPart taken(const std::vector<Index>& chosen, std::vector<Index>& numbers) const;
};

//! What a mirror maps to what.
struct Mirror {
  int axis = 0;                   //!< normal to the plane, 0 to Dim - 1
  std::vector<Index> images{};    //!< the mirror image of each control point
  std::vector<Index> partners{};  //!< that of each point, itself in the plane; -1: none
};

//! A model in a cage that is symmetric across a plane (2D: line) x, y, or z = constant. With s(i)
//! the mirror image of control point i and M the mirror, the weights (w_i(x) + w_s(i)(M x)) / 2 are
//! non-negative, sum to 1, reproduce x, and do not increase the objective. They are bit-identical
//! at M x for s(i). Files store few digits, so mirror images are so up to kBoundaryTolerance of the
//! cage size. The weights of two points then reproduce the symmetric positions between them.
template <int Dim>
class MirroredModel {
 public:
  //! \param axis  normal to the plane, which is in the middle of the cage
  //! \param points  Dim x P, finite
  //! \throws OptionError if there is no such axis; InputError naming the first control point or
  //! facet without a mirror image
  MirroredModel(const Cage<Dim>& cage, int axis, const PointList<Dim>& points);

  //! With a known mirror. \throws InputError if it is not one of this cage and these points
  MirroredModel(const Cage<Dim>& cage, const Mirror& mirror, const PointList<Dim>& points);

  //! Which images were found.
  Mirror mirror() const;

  //! Adds the mirror images of masks of P points.
  std::vector<Mask> symmetrized(const std::vector<Mask>& masks) const;

  //! The mirror image of each control point.
  const std::vector<Index>& images() const { return image_; }

  //! About the points without a mirror image, with their number; empty if there are none.
  std::string note() const;

  //! Moves placed points to where symmetric weights put them: the mean of the place and of the
  //! mirrored place of the image.
  //! \param placement  of the P points \param at  returns where given points are put
  void symmetrize(Placement<Dim>& placement,
                  const std::function<PointList<Dim>(const PointList<Dim>& points)>& at) const;

  //! Frees control points whose image is free at the image of a point. Masks may end at facets on
  //! one side only, because flat quads may be cut differently.
  //! \param given  from symmetrized() \param masks  the same, placed
  void keep_common(const std::vector<Mask>& given, PlacedMasks& masks) const;

  //! The masks of points without a mirror image.
  PlacedMasks of_single_points(PlacedMasks masks) const;

  //! Makes weights symmetric, except where a point or its image has none.
  //! \param weights  of P points \param at  returns weights at given points
  SparseWeights symmetrized(
      const SparseWeights& weights,
      const std::function<SparseWeights(const PointList<Dim>& points)>& at) const;

  //! Reduces symmetric weights on one half, and mirrors the result. Points in the plane keep
  //! symmetric weights if these are within the limit.
  //! \param model  P points with symmetric weights \param most  maximum influences per point
  //! \param reduce  reduces the influences of a part to at most so many
  //! \return weights of P points
  SparseWeights reduced(
      const ModelPart<Dim>& model, Index most,
      const std::function<SparseWeights(const ModelPart<Dim>& part, Index most)>& reduce) const;

 private:
  void number_single_points();
  Eigen::VectorXd mirrored(const Eigen::VectorXd& weights) const { return weights(image_); }
  PointList<Dim> mirrored(const PointList<Dim>& points) const;

  // What a function returns for the images of single points.
  template <class Result>
  Result at_images(const std::function<Result(const PointList<Dim>&)>& at) const {
    return single_.empty() ? Result() : at(mirrored(points_)(Eigen::all, single_));
  }

  int axis_;
  double place_;              // of the plane
  std::string plane_;         // in words
  std::vector<Index> image_;  // of each control point
  PointList<Dim> points_;
  std::vector<Index> single_;   // points without an image
  std::vector<Index> partner_;  // of each point; ~k: none, the k-th single point
};

}  // namespace flbc
