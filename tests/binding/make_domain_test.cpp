// SPDX-License-Identifier: BSD-3-Clause
// Which mesher makes a mesh, and what is said about it. The meshers are made for the tests.
#include "flbc/make_domain.h"

#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
PartMesher<Dim> makes(int resolution) {
  return [resolution](const Cage<Dim>&, const MeshingOptions<Dim>&) {
    return make_sample<Dim>(Shape::kBox, resolution).mesh;
  };
}

template <class Error, int Dim>
PartMesher<Dim> fails(const char* reason) {
  return [reason](const Cage<Dim>&, const MeshingOptions<Dim>&) -> DomainMesh<Dim> {
    throw Error(reason);
  };
}

template <int Dim>
MadeDomain<Dim> made_by(std::vector<NamedMesher<Dim>> meshers, Index vertices = 0) {
  MeshingOptions<Dim> options{vertices};
  return make_domain<Dim>(make_sample<Dim>(Shape::kBox, 1).cage, options, {std::move(meshers)});
}

TEST_IN_2D_AND_3D(MakeDomainTest, TheFirstThatCanMakesTheMesh) {
  const auto first = made_by<Dim>({{"a", makes<Dim>(2)}, {"b", makes<Dim>(3)}});
  EXPECT_EQ(first.mesher, "a");
  EXPECT_EQ(first.note, "");
  EXPECT_EQ(first.mesh.cells, make_sample<Dim>(Shape::kBox, 2).mesh.cells);
  const auto second = made_by<Dim>({{"a", fails<InputError, Dim>("thin")}, {"b", makes<Dim>(3)}});
  EXPECT_EQ(second.mesher, "b");
  EXPECT_EQ(second.note, "thin; the mesh was made by b");
  EXPECT_EQ(second.mesh.cells, make_sample<Dim>(Shape::kBox, 3).mesh.cells);
}

TEST_IN_2D_AND_3D(MakeDomainTest, AllReasonsAreGivenOnce) {
  const auto thin = fails<InputError, Dim>("thin"), flat = fails<InputError, Dim>("flat");
  expect_refused<InputError>("thin; flat", [&] { made_by<Dim>({{"a", thin}, {"b", flat}}); });
  try {
    made_by<Dim>({{"a", thin}, {"b", thin}});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "thin");
  }
  const auto cannot = fails<OptionError, Dim>("cannot embed");
  expect_refused<OptionError>("cannot embed", [&] { made_by<Dim>({{"a", cannot}, {"b", thin}}); });
  expect_refused<InputError>("thin", [&] { made_by<Dim>({{"a", thin}, {"b", cannot}}); });
  expect_refused<OptionError>("there is no mesher", [] { made_by<Dim>({}); });
}

TEST_IN_2D_AND_3D(MakeDomainTest, TooFewVerticesBecomeTheFewest) {
  const PartMesher<Dim> mesher = [](const Cage<Dim>&, const MeshingOptions<Dim>& options) {
    if (options.vertices > 0) throw TooFewVertices("too few");
    return make_sample<Dim>(Shape::kBox, 4).mesh;
  };
  const auto made = made_by<Dim>({{"a", mesher}}, 5);
  EXPECT_EQ(made.mesh.cells, make_sample<Dim>(Shape::kBox, 4).mesh.cells);
  expect_piece(made.note, " vertices instead of 5");
}

TEST_IN_2D_AND_3D(MakeDomainTest, ChecksTheWholeCageAndCanBeCanceled) {
  const auto cage = make_sample<Dim>(Shape::kBox, 1).cage;
  Meshers<Dim> meshers{{{"a", fails<InputError, Dim>("thin")}, {"b", makes<Dim>(1)}}};
  MeshingOptions<Dim> cancelled;
  cancelled.poll = [] { throw std::out_of_range("stop"); };
  EXPECT_THROW(make_domain<Dim>(cage, cancelled, meshers), std::out_of_range);
  meshers.check = [&](const Cage<Dim>& given) {
    EXPECT_EQ(given.points, cage.points);
    throw InputError("crosses itself");
  };
  expect_refused<InputError>("crosses itself", [&] { make_domain<Dim>(cage, {}, meshers); });
}

}  // namespace
}  // namespace flbc::testing
