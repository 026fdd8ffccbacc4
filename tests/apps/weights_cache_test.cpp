// SPDX-License-Identifier: BSD-3-Clause
// Weights that are kept: nothing but what was stored for the same key ever comes back, whatever
// happens to the files.
#include "solve/weights_cache.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

#include "flbc/byte_archive.h"
#include "flbc/errors.h"
#include "flbc/version.h"
#include "solve/cache_key.h"
#include "support/io_files.h"
#include "support/scratch.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

using app::key_of;
using app::SolvedDomain;
using app::WeightOrigin;
using app::WeightsCache;

// All that a test may change about where weights come from.
template <int Dim>
struct Origin {
  Sample<Dim> sample = make_sample<Dim>(Shape::kSimplex, 1);
  PointList<Dim> embedded{};
  bool has_domain = false;
  Index vertices = 0;
  bool can_mesh = true;
  double penalty = 0;
  SolverOptions options{};

  std::string key() const {
    return key_of<Dim>({sample.cage, has_domain ? &sample.mesh : nullptr,
                        embedded.cols() > 0 ? &embedded : nullptr, vertices, can_mesh, penalty,
                        options});
  }
};

template <class Dimension>
class WeightsCacheOf : public FolderTest {
 protected:
  using Solved = SolvedDomain<Dimension::value>;

  void SetUp() override {
    cache_ = std::make_unique<WeightsCache>(path("cache"));
    key_ = Origin<Dimension::value>().key();
    file_ = cache_->path_of(key_);
  }

  // Awkward numbers in every field.
  static Solved make_solved() {
    Solved solved;
    const auto sample = make_sample<Dimension::value>(Shape::kSimplex, 1);
    solved.domain = sample.mesh;
    const auto numbers = awkward_numbers();
    WeightMatrix weights(sample.cage.size(), sample.mesh.num_vertices());
    std::size_t next = 0;
    for (auto& weight : weights.reshaped()) weight = numbers[next++ % numbers.size()];
    solved.solution.weights = SparseWeights(weights);
    solved.mesh_seconds = 0.1;
    auto& report = solved.solution.report;
    report.method = Method::kLbc2014;
    report.iterations = 123;
    report.objective = 1.0 / 3;
    report.certificate = {1, 2, 3};
    report.seconds = {4, 5, 6, 7};
    report.quality = {-1, 8, 9, 10};
    report.coarse_levels = {{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}};
    report.parts = {{}, report};
    return solved;
  }

  static void expect_same(const Solved& found, const Solved& stored) {
    EXPECT_TRUE(bit_equal(found.domain.points, stored.domain.points));
    EXPECT_EQ(found.domain.cells, stored.domain.cells);
    EXPECT_TRUE(bit_equal(found.solution.weights.dense(), stored.solution.weights.dense()));
    EXPECT_EQ(found.mesh_seconds, stored.mesh_seconds);
    const auto& a = found.solution.report;
    const auto& b = stored.solution.report;
    EXPECT_EQ(a.method, b.method);
    EXPECT_EQ(a.iterations, b.iterations);
    EXPECT_EQ(a.objective, b.objective);
    EXPECT_EQ(a.certificate.relative_gap, b.certificate.relative_gap);
    EXPECT_EQ(a.seconds.certify, b.seconds.certify);
    EXPECT_EQ(a.quality.min_weight, b.quality.min_weight);
    ASSERT_EQ(a.coarse_levels.size(), b.coarse_levels.size());
    EXPECT_EQ(a.coarse_levels.back().solve_seconds, b.coarse_levels.back().solve_seconds);
    ASSERT_EQ(a.parts.size(), b.parts.size());
    EXPECT_EQ(a.parts.back().iterations, b.parts.back().iterations);
    EXPECT_EQ(a.parts.back().certificate.lower_bound, b.parts.back().certificate.lower_bound);
  }

  static std::string read(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  // That a file with this content is not used, and why.
  void expect_useless(const std::string& content, const std::string& reason) const {
    std::ofstream(file_, std::ios::binary) << content;
    const auto answer = cache_->find<Dimension::value>(key_);
    EXPECT_FALSE(answer.solved.has_value());
    EXPECT_EQ(answer.complaint.find(file_ + ": not used, because "), 0U) << answer.complaint;
    EXPECT_NE(answer.complaint.find(reason), std::string::npos) << answer.complaint;
  }

  // The content with a checksum as a program would have written it.
  static std::string with_checksum(const std::string& content) {
    std::ostringstream out;
    ByteWriter writer(out);
    writer.bytes(content.data(), content.size() - 8);
    writer(hash_of(content.substr(0, content.size() - 8)));
    return out.str();
  }

  std::unique_ptr<WeightsCache> cache_;
  std::string key_;
  std::string file_;
};

using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(WeightsCacheOf, Dimensions);

TYPED_TEST(WeightsCacheOf, WhatIsStoredComesBackBitByBit) {
  constexpr int kDim = TypeParam::value;
  const auto nothing = this->cache_->template find<kDim>(this->key_);
  EXPECT_FALSE(nothing.solved.has_value());
  EXPECT_EQ(nothing.complaint, "");

  const auto solved = this->make_solved();
  this->cache_->store(this->key_, solved);
  const auto answer = WeightsCache(this->path("cache")).find<kDim>(this->key_);
  EXPECT_EQ(answer.complaint, "");
  ASSERT_TRUE(answer.solved.has_value());
  this->expect_same(*answer.solved, solved);
  EXPECT_EQ(this->names().size(), 1U);
  // The same content again: entries do not depend on when they are written.
  const auto before = this->read(this->file_);
  this->cache_->store(this->key_, solved);
  EXPECT_EQ(this->read(this->file_), before);
}

TYPED_TEST(WeightsCacheOf, EveryFlippedByteIsFound) {
  this->cache_->store(this->key_, this->make_solved());
  const auto good = this->read(this->file_);
  ASSERT_GT(good.size(), 500U);
  for (std::size_t k = 0; k < good.size(); ++k) {
    SCOPED_TRACE("byte " + std::to_string(k));
    auto bad = good;
    bad[k] = static_cast<char>(bad[k] ^ (1 << (k % 8)));
    this->expect_useless(bad, k < 23 ? "no file of weights of this format" : "checksum");
    if (this->HasFailure()) return;
  }
}

TYPED_TEST(WeightsCacheOf, EveryOtherLengthIsFound) {
  this->cache_->store(this->key_, this->make_solved());
  const auto good = this->read(this->file_);
  for (std::size_t size = 0; size < good.size(); ++size) {
    SCOPED_TRACE(size);
    this->expect_useless(good.substr(0, size), "");
    if (this->HasFailure()) return;
  }
  this->expect_useless(good + '\0', "checksum");
  this->expect_useless(good + good, "checksum");
}

TYPED_TEST(WeightsCacheOf, FilesOfOthersAreNotUsed) {
  constexpr int kDim = TypeParam::value;
  this->cache_->store(this->key_, this->make_solved());
  const auto good = this->read(this->file_);
  EXPECT_EQ(this->with_checksum(good), good);

  // The same name, sound files: hashes collide, or someone renamed a file.
  Origin<kDim> other;
  other.options.tolerance = 1e-3;
  this->cache_->store(other.key(), this->make_solved());
  std::filesystem::rename(this->cache_->path_of(other.key()), this->file_);
  EXPECT_NE(this->cache_->template find<kDim>(this->key_).complaint.find("another cage or mesh"),
            std::string::npos);

  // Another version of the library, another format.
  const std::string version = std::string("version ") + FLBC_VERSION;
  auto old = good;
  ++old[old.find(version) + version.size() - 1];
  this->expect_useless(this->with_checksum(old), "another version");
  auto format = good;
  ++format[format.find("format ") + 7];
  this->expect_useless(this->with_checksum(format), "this format");

  // Sizes that cannot be, with a checksum that is right.
  auto sizes = good;
  sizes[good.find(version) - 1] = '\x7f';
  this->expect_useless(this->with_checksum(sizes), "ends early");
  for (std::size_t k = 0; k < 16; ++k) {
    auto rows = good;
    rows[23 + 8 + this->key_.size() + k] = '\x7f';
    this->expect_useless(this->with_checksum(rows), "");
  }
  auto longer = good;
  longer.insert(good.size() - 8, 8, '\0');
  this->expect_useless(this->with_checksum(longer), "a size in it is impossible");
  auto shorter = good;
  shorter.erase(good.size() - 16, 8);
  this->expect_useless(this->with_checksum(shorter), "");
}

TYPED_TEST(WeightsCacheOf, WhatCannotBeReadIsReplaced) {
  constexpr int kDim = TypeParam::value;
  std::filesystem::create_directory(this->file_);
  const auto answer = this->cache_->template find<kDim>(this->key_);
  EXPECT_FALSE(answer.solved.has_value());
  EXPECT_NE(answer.complaint.find(this->file_), std::string::npos);
  this->cache_->store(this->key_, this->make_solved());
  EXPECT_TRUE(this->cache_->template find<kDim>(this->key_).solved.has_value());

  this->expect_useless("damaged", "");
  std::filesystem::permissions(this->file_, std::filesystem::perms::owner_read);
  this->cache_->store(this->key_, this->make_solved());
  EXPECT_TRUE(this->cache_->template find<kDim>(this->key_).solved.has_value());
}

TYPED_TEST(WeightsCacheOf, EverythingThatWeightsDependOnIsInTheKey) {
  constexpr int kDim = TypeParam::value;
  using Change = std::function<void(Origin<kDim>&)>;
  const std::vector<Change> changes{
      [](auto& o) { o.sample.cage.points(0, 0) = std::nextafter(o.sample.cage.points(0, 0), 9); },
      [](auto& o) { o.sample.cage.facets.col(0).reverseInPlace(); },
      [](auto& o) { o.has_domain = true; },
      [](auto& o) {
        o.has_domain = true;
        o.sample.mesh.points(0, 0) = std::nextafter(o.sample.mesh.points(0, 0), 9);
      },
      [](auto& o) {
        o.has_domain = true;
        o.sample.mesh.cells.col(0).reverseInPlace();
      },
      [](auto& o) { o.vertices = 5; },
      [](auto& o) { o.embedded.setZero(kDim, 1); },
      [](auto& o) { o.embedded.setZero(kDim, 2); },
      [](auto& o) { o.embedded.setOnes(kDim, 1); },
      [](auto& o) { o.options.coarse_to_fine = CoarseToFine::kOff; },
      [](auto& o) { o.options.coarse_levels.coarsest = 7; },
      [](auto& o) { o.options.coarse_levels.factor = 7; },
      [](auto& o) { o.options.coarse_levels.looseness = 7; },
      [](auto& o) { o.can_mesh = false; },
      [](auto& o) { o.options.method = Method::kGradient; },
      [](auto& o) { o.options.phi = DistanceScheme::kLinear; },
      [](auto& o) { o.options.precision = Precision::kDouble; },
      [](auto& o) { o.options.recovery = Recovery::kBreadthFirst; },
      [](auto& o) { o.options.non_negative = NonNegative::kOff; },
      [](auto& o) { o.options.linear_solver = LinearSolver::kMultigrid; },
      [](auto& o) { o.options.tolerance = 1e-3; },
      [](auto& o) { o.options.tolerance = std::nextafter(1e-3, 1); },
      [](auto& o) { o.options.max_iterations = 7; },
      [](auto& o) { o.options.gap = 1e-5; },
      [](auto& o) { o.options.penalty = 8; },
      [](auto& o) { o.penalty = 8; },
      [](auto& o) { o.options.relaxation = 1.5; },
      [](auto& o) { o.options.check_interval = 3; },
      [](auto& o) { o.options.certify = true; },
  };
  std::vector<std::string> keys{Origin<kDim>().key()};
  for (const auto& change : changes) {
    Origin<kDim> origin;
    change(origin);
    const auto key = origin.key();
    for (std::size_t k = 0; k < keys.size(); ++k) {
      EXPECT_NE(key, keys[k]) << "change " << keys.size() << " looks like " << k;
    }
    keys.push_back(key);
  }
  // What does not change the weights, and what an option would be anyway, finds the same file.
  Origin<kDim> same;
  same.options.threads = 3;
  same.options.method = Method::kValue;
  same.options.tolerance = 1e-7;
  same.options.gap = 1e-3;
  EXPECT_EQ(same.key(), keys.front());
}

TEST(WeightsCacheFolder, IsMadeOrNamed) {
  const ScratchFolder scratch;
  const auto& folder = scratch.path();
  const auto below = (folder / "a" / "b").string();
  WeightsCache cache(below);
  EXPECT_TRUE(std::filesystem::is_directory(below));
  const auto file = (folder / "file").string();
  std::ofstream(file) << "not a folder";
  expect_error<IoError>([&] { WeightsCache cache_below(file + "/cache"); }, {file + "/cache"});
  expect_error<IoError>([&] { WeightsCache cache_of_file(file); }, {file});
}

// Published values (the reference vectors of the hash's authors).
TEST(WeightsCacheHash, IsFnv1a) {
  EXPECT_EQ(hash_of(""), 0xcbf29ce484222325U);
  EXPECT_EQ(hash_of("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(hash_of("foobar"), 0x85944171f73967e8U);
}

}  // namespace
}  // namespace flbc::testing
