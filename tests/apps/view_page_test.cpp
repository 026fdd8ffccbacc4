// SPDX-License-Identifier: BSD-3-Clause
// Pages of flbc view contain their input, as read back from the finished file.
#include "front/base64.h"
#include "front/page.h"
#include "support/command_line.h"

namespace flbc::view {
namespace {

using nlohmann::json;

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

template <class Number>
std::vector<Number> numbers_from(const std::string& text) {
  const auto bytes = from_base64(text);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

std::vector<Index> indices_from(const json& packed) {
  const auto convert = [](const auto& numbers) {
    return std::vector<Index>(numbers.begin(), numbers.end());
  };
  const std::string data = packed["data"];
  if (packed["bytes"] == 1) return convert(numbers_from<std::uint8_t>(data));
  if (packed["bytes"] == 2) return convert(numbers_from<std::uint16_t>(data));
  return convert(numbers_from<std::uint32_t>(data));
}

json content_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"content\">";
  const auto start = page.find(begin) + begin.size();
  return json::parse(page.substr(start, page.find("</script>", start) - start));
}

// The weights that a page holds. \return n x P
WeightMatrix weights_in(const json& content, Index n) {
  const auto counts = numbers_from<std::uint8_t>(content["weights"]["counts"]);
  const auto owners = indices_from(content["weights"]["controlPoints"]);
  const auto values = numbers_from<float>(content["weights"]["values"]);
  WeightMatrix weights = WeightMatrix::Zero(n, counts.size());
  std::size_t k = 0;
  for (std::size_t p = 0; p < counts.size(); ++p) {
    for (int c = 0; c < counts[p]; ++c, ++k) {
      weights(owners[k], static_cast<Index>(p)) = static_cast<double>(values[k]);
    }
  }
  return weights;
}

// The corners of the cube [0, 1]^Dim as cage, far away, and its multilinear weights at some points.
template <int Dim>
PageContent<Dim> cube_content() {
  constexpr Index n = 1 << Dim;
  PageContent<Dim> content;
  content.title = "a </script><b>cube";
  content.cage.points.resize(Dim, n);
  const Vector<Dim> corner = Vector<Dim>::Constant(1e4);
  for (Index i = 0; i < n; ++i) {
    for (int k = 0; k < Dim; ++k) content.cage.points(k, i) = corner[k] + (i >> k & 1);
  }
  content.points = PointList<Dim>::Zero(Dim, 5);
  WeightMatrix weights(n, 5);
  for (Index p = 0; p < 5; ++p) {
    const Vector<Dim> place = Vector<Dim>::LinSpaced(0.1 + 0.15 * p, 0.8 - 0.1 * p);
    for (Index i = 0; i < n; ++i) {
      double weight = 1;
      for (int k = 0; k < Dim; ++k) weight *= (i >> k & 1) != 0 ? place[k] : 1 - place[k];
      weights(i, p) = weight;
    }
    content.points.col(p) = corner + place;
  }
  content.weights = weights;
  content.surface.triangles.resize(3, 2);
  content.surface.triangles << 0, 1, 1, 2, 2, 4;
  content.surface.sources = {0, 1, 2, 3, 4};
  content.surface.normals = Vector<3>::UnitZ().replicate(1, 5);
  content.poses.push_back({"moved", 1, content.cage.points.array() + 0.125});
  return content;
}

TEST_IN_2D_AND_3D(ViewPage, HoldsWhatItWasGiven) {
  constexpr Index n = 1 << Dim;
  const auto given = cube_content<Dim>();
  const auto page = make_page(given);
  const auto content = content_of(page);
  EXPECT_EQ(content["title"], given.title);
  EXPECT_EQ(weights_in(content, n),
            given.weights.dense().template cast<float>().template cast<double>());

  const auto cage = numbers_from<double>(content["cage"]["points"]);
  EXPECT_EQ((Eigen::Map<const PointList<Dim>>(cage.data(), Dim, n)), given.cage.points);
  const auto pose = numbers_from<double>(content["poses"][0]["points"]);
  EXPECT_EQ((Eigen::Map<const PointList<Dim>>(pose.data(), Dim, n)), given.poses[0].points);

  // Offsets keep the digits that single precision does not have so far from the origin.
  const auto offsets = numbers_from<float>(content["points"]["offsets"]);
  const auto center = content["points"]["center"].template get<std::vector<double>>();
  for (Index p = 0; p < 5; ++p) {
    for (int k = 0; k < Dim; ++k) {
      EXPECT_NEAR(center[k] + static_cast<double>(offsets[Dim * p + k]), given.points(k, p), 1e-7);
    }
  }
  EXPECT_EQ(indices_from(content["surface"]["triangles"]), (std::vector<Index>{0, 1, 2, 1, 2, 4}));
}

TEST_IN_2D_AND_3D(ViewPage, ShowsMaterialsAndWhatIsTransparentLast) {
  auto content = cube_content<Dim>();
  io::Material glass, paint;
  glass.opacity = 0.25;
  paint.color = {0, 0, 0};  // the picture replaces it
  paint.alpha_cutoff = 0.5;
  paint.texture = "paint.png";
  paint.picture = std::string("\x89PNG\r\n\x1a\n", 8);
  content.surface.materials = {glass, paint};
  content.surface.texture_coordinates =
      PointList<2>::Zero(2, static_cast<Eigen::Index>(content.surface.sources.size()));
  content.surface.triangle_materials = {0, 1};
  const auto surface = content_of(make_page(content))["surface"];
  EXPECT_EQ(indices_from(surface["triangles"]), (std::vector<Index>{1, 2, 4, 0, 1, 2}));
  ASSERT_EQ(surface["parts"].size(), 2u);
  const auto &first = surface["parts"][0], &last = surface["parts"][1];
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(first["color"][k], 1, 1e-12);
  EXPECT_EQ(first["cutoff"], 0.5);
  EXPECT_EQ(first["picture"], 0);
  EXPECT_EQ(last["opacity"], 0.25);
  EXPECT_EQ(last["picture"], -1);
  EXPECT_EQ(last["first"], 3);
  EXPECT_EQ(last["count"], 3);
  ASSERT_EQ(surface["pictures"].size(), 1u);
  const std::string address = surface["pictures"][0], begin = "data:image/png;base64,";
  EXPECT_EQ(address.substr(0, begin.size()), begin);
  EXPECT_EQ(from_base64(address.substr(begin.size())), paint.picture);
}

TEST_IN_2D_AND_3D(ViewPage, IsOneFileWithoutNetwork) {
  const auto page = make_page(cube_content<Dim>());
  for (const char* word :
       {"{{", "http:", "https:", "src=", "<link rel=\"stylesheet", "</script><b>"}) {
    flbc::testing::expect_no_piece(page, word);
  }
  flbc::testing::expect_no_piece(page, "\nimport ");
  flbc::testing::expect_no_piece(page, "\nexport ");
}

TEST_IN_2D_AND_3D(ViewPage, InfluencesAreReducedOnlyWhereThereAreTooMany) {
  auto content = cube_content<Dim>();
  WeightMatrix weights = content.weights.dense();
  weights.col(1).setZero();
  weights(0, 1) = 1.5;  // as others deliver them: few, but one of them negative
  weights(1, 1) = -0.5;
  Binding<Dim> binding;
  binding.cage.points = content.cage.points;
  binding.points = content.points;
  binding.weights = weights;
  const auto few = limit_influences(binding, Dim + 1).dense();
  EXPECT_EQ(few.col(1), weights.col(1));
  for (const Index p : {0, 2, 3, 4}) {
    EXPECT_LE((few.col(p).array() != 0).count(), Dim + 1);
    EXPECT_LT((content.cage.points * few.col(p) - content.points.col(p)).norm(), 1e-8);
  }
  EXPECT_EQ(limit_influences(binding, 8).dense(), weights);
  for (const Index most : {Dim, 17}) {
    EXPECT_THROW(limit_influences(binding, most), OptionError);
  }
}

TEST(ViewCage, EdgesArePolygonsAndNotTheirDiagonals) {
  const FacetList<3> facets = (FacetList<3>(3, 2) << 0, 0, 1, 2, 2, 3).finished();
  EXPECT_EQ(edges_of_cage<3>({{0, 1, 2, 3}}, facets).size(), 4u);
  EXPECT_EQ(edges_of_cage<3>({}, facets).size(), 5u);
}

using ViewCommand = testing::CommandLineTest;

TEST_F(ViewCommand, RefusesWithTheReason) {
  const std::string cage = "2d/figure_cage.obj", model = "2d/figure_model.obj";
  expect("solve " + cage + " --method meanvalue -q --model " + model + " -o w.npy");
  const auto rig = " --weights w.npy --cage " + cage + " -o p.";
  expect_refused("view " + model + rig + "txt", 1, ".html");
  expect_refused("view " + model + rig + "html -k 17", 1, "from 3 to 16 influences");
  expect_refused("view 2d/ring_model.obj" + rig + "html", 2, "ring_model.obj");
}

}  // namespace
}  // namespace flbc::view
