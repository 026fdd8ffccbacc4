// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The solver's state as properties of a mesh: the iteration works on their storage.
#pragma once

#include <string>

#include <OpenMesh/Core/Utils/Property.hh>

#include "flbc/errors.h"
#include "flbc/openmesh/domain.h"
#include "flbc/openmesh/tet_mesh.h"
#include "flbc/openmesh/wide_property.h"
#include "flbc/solver_state.h"

namespace flbc::openmesh {

//! The handle types that stand for a domain's cells and facets.
template <class Mesh>
struct PropertyHandles {
  template <class T>
  using Cell = OpenMesh::FPropHandleT<T>;  //!< cells are the mesh's faces
  template <class T>
  using Facet = OpenMesh::EPropHandleT<T>;  //!< facets are its edges
};
//! The same for tetrahedral meshes.
template <>
struct PropertyHandles<TetMesh> {
  template <class T>
  using Cell = CPropHandleT<T>;  //!< cells are cells
  template <class T>
  using Facet = OpenMesh::FPropHandleT<T>;  //!< facets are the mesh's faces
};

//! The name of a state's property, without prefix.
inline const char* name_of(StateArray array) {
  switch (array) {
    case StateArray::kIterate:
      return "iterate";
    case StateArray::kRelaxedIterate:
      return "relaxed_iterate";
    case StateArray::kNonNegativityDual:
      return "non_negativity_dual";
    case StateArray::kSplittingState:
      return "splitting_state";
    case StateArray::kGradient:
      return "gradient";
    case StateArray::kExtrapolatedGradient:
      return "extrapolated_gradient";
    case StateArray::kTvDual:
      return "tv_dual";
    case StateArray::kIntegrabilityDual:
      return "integrability_dual";
    case StateArray::kPeriodDual:
      break;
  }
  return "period_dual";
}

//! Gives the solver properties to work on, and knows whether an earlier run left any.
template <class Mesh>
class PropertyStorage : public StateStorage {
 public:
  //! \param prefix  of the properties' names \param control_points  n
  PropertyStorage(Mesh& mesh, std::string prefix, Index control_points)
      : mesh_(mesh), prefix_(std::move(prefix)), n_(static_cast<std::size_t>(control_points)) {}

  void* allocate(const StateShape& shape) override {
    return shape.precision == Precision::kDouble ? allocate_as<double, float>(shape)
                                                 : allocate_as<float, double>(shape);
  }
  double penalty() const override { return penalty_; }
  void keep_penalty(double penalty) override { penalty_ = penalty; }

  //! Whether all is there that a method goes on from. \param options  resolved
  bool is_complete(const SolverOptions& options) {
    using A = StateArray;
    const auto precision = options.precision;
    if (options.method == Method::kValue || options.method == Method::kLbc2014) {
      return has(A::kIterate, precision) && has(A::kSplittingState, precision) &&
             (options.method != Method::kValue || has(A::kRelaxedIterate, precision)) &&
             (options.non_negative != NonNegative::kConstraint ||
              has(A::kNonNegativityDual, precision));
    }
    return has(A::kGradient, precision) && has(A::kTvDual, precision) &&
           has(A::kExtrapolatedGradient, precision) && has(A::kIntegrabilityDual, precision);
  }

  //! Goes on from a state with this penalty. \param dual_factor  see rescale_duals()
  void resume(double penalty, double dual_factor) {
    penalty_ = penalty;
    dual_factor_ = dual_factor;
  }

  //! Multiplies the duals of the gradient methods, which are relative to the penalty, by the old
  //! penalty divided by the new one.
  void rescale_duals(Precision precision) {
    const double factor = dual_factor_;
    if (factor == 1) return;
    for (const auto array :
         {StateArray::kTvDual, StateArray::kIntegrabilityDual, StateArray::kPeriodDual}) {
      precision == Precision::kDouble ? rescale_as<double>(array, factor)
                                      : rescale_as<float>(array, factor);
    }
  }

  //! Marks what there is for .om files.
  void set_persistent() {
    for (int array = 0; array <= static_cast<int>(StateArray::kPeriodDual); ++array) {
      set_persistent_as<float>(static_cast<StateArray>(array));
      set_persistent_as<double>(static_cast<StateArray>(array));
    }
  }

  //! Drops all state from the mesh.
  void remove() {
    for (int array = 0; array <= static_cast<int>(StateArray::kPeriodDual); ++array) {
      remove_as<float>(static_cast<StateArray>(array));
      remove_as<double>(static_cast<StateArray>(array));
    }
  }

 private:
  template <class T>
  using CellHandle = typename PropertyHandles<Mesh>::template Cell<T>;
  template <class T>
  using FacetHandle = typename PropertyHandles<Mesh>::template Facet<T>;

  // Calls `use` with a property handle for the kind of element that the array belongs to.
  template <class Scalar, class Use>
  static auto with_handle(StateArray array, const Use& use) {
    using Rows = Wide<Scalar>;
    switch (array) {
      case StateArray::kIterate:
      case StateArray::kRelaxedIterate:
      case StateArray::kNonNegativityDual:
        return use(OpenMesh::VPropHandleT<Rows>());
      case StateArray::kIntegrabilityDual:
        return use(FacetHandle<Rows>());
      case StateArray::kPeriodDual:
        return use(OpenMesh::MPropHandleT<Rows>());
      default:
        return use(CellHandle<Rows>());
    }
  }

  template <class Handle>
  OpenMesh::PropertyT<typename Handle::Value>& property(Handle handle) {
    return mesh_.property(handle);
  }
  template <class T>
  OpenMesh::PropertyT<T>& property(OpenMesh::MPropHandleT<T> handle) {
    return mesh_.mproperty(handle);
  }

  std::string full_name(StateArray array) const { return prefix_ + name_of(array); }

  template <class Scalar, class Other>
  void* allocate_as(const StateShape& shape) {
    remove_as<Other>(shape.array);
    return with_handle<Scalar>(shape.array, [&](auto handle) -> void* {
      if (!mesh_.get_property_handle(handle, full_name(shape.array))) {
        mesh_.add_property(handle, full_name(shape.array));
      }
      auto& rows = property(handle);
      if (rows.components() != shape.components || rows.width() != n_) {
        rows.set_shape(shape.components, n_);
      }
      if (rows.stride() != shape.stride || rows.n_elements() != shape.elements) {
        throw SolverError("property " + full_name(shape.array) + " has not the shape it needs");
      }
      return rows.data();
    });
  }

  template <class Scalar>
  void remove_as(StateArray array) {
    with_handle<Scalar>(array, [&](auto handle) {
      if (mesh_.get_property_handle(handle, full_name(array))) mesh_.remove_property(handle);
    });
  }

  template <class Scalar>
  void set_persistent_as(StateArray array) {
    with_handle<Scalar>(array, [&](auto handle) {
      if (mesh_.get_property_handle(handle, full_name(array))) {
        property(handle).set_persistent(true);
      }
    });
  }

  template <class Scalar>
  void rescale_as(StateArray array, double factor) {
    with_handle<Scalar>(array, [&](auto handle) {
      if (!mesh_.get_property_handle(handle, full_name(array))) return;
      auto& rows = property(handle);
      const std::size_t count = rows.n_elements() * rows.components() * rows.stride();
      for (std::size_t i = 0; i < count; ++i) rows.data()[i] *= static_cast<Scalar>(factor);
    });
  }

  template <class Scalar>
  bool has_as(StateArray array) {
    return with_handle<Scalar>(array, [&](auto handle) {
      return mesh_.get_property_handle(handle, full_name(array)) && property(handle).width() == n_;
    });
  }
  bool has(StateArray array, Precision precision) {
    return precision == Precision::kDouble ? has_as<double>(array) : has_as<float>(array);
  }

  Mesh& mesh_;
  const std::string prefix_;
  const std::size_t n_;
  double penalty_ = 0;
  double dual_factor_ = 1;
};

}  // namespace flbc::openmesh
