// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/splat_file.h"

#include <sstream>

#include "support/io_files.h"
#include "support/splats.h"

namespace flbc::testing {
namespace {

using Eigen::Matrix3d;

class SplatFileTest : public FolderTest {
 protected:
  std::string file(const std::string& content, const std::string& name = "splats.ply") const {
    return make(name, content);
  }

  static std::string moved(const io::SplatFile& file, const PointList<3>& points,
                           const std::vector<Matrix3d>& jacobians) {
    Eigen::MatrixXd columns(9, points.cols());
    for (Eigen::Index p = 0; p < points.cols(); ++p) {
      columns.col(p) = jacobians[jacobians.size() == 1 ? 0 : p].reshaped();
    }
    std::ostringstream out;
    file.write(out, points, columns);
    return out.str();
  }

  void expect_refused(const std::string& content, const std::string& words) const {
    testing::expect_refused(words, [&] { io::SplatFile(file(content)); });
  }
};

const PointList<3> kPlaces = PointList<3>::Random(3, 50);

TEST_F(SplatFileTest, CovariancesAreMultipliedByTheJacobian) {
  const auto splats = random_splats(kPlaces, 0);
  const io::SplatFile read(file(splats.text()));
  EXPECT_EQ(read.points(), kPlaces.cast<float>().cast<double>());
  std::vector<Matrix3d> jacobians;
  for (Eigen::Index p = 0; p < kPlaces.cols(); ++p) jacobians.push_back(3 * Matrix3d::Random());
  const PointList<3> points = PointList<3>::Random(3, 50);
  const auto result = splats.parse(moved(read, points, jacobians));
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    const Matrix3d expected = jacobians[p] * splats.covariance(p) * jacobians[p].transpose();
    EXPECT_LT((result.covariance(p) - expected).norm(), 2e-6 * expected.norm()) << p;
  }
  EXPECT_EQ(result.values.topRows(3), points.cast<float>());
}

TEST_F(SplatFileTest, FlatSplatsKeepTheirThickness) {
  auto splats = random_splats(kPlaces, 0);
  for (Eigen::Index p = 0; p < kPlaces.cols(); ++p) splats.at("scale_1", p) = -10;
  const Matrix3d turn = Eigen::AngleAxisd(1, Vector<3>(1, 2, 3).normalized()).toRotationMatrix();
  const auto result = splats.parse(moved(io::SplatFile(file(splats.text())), kPlaces, {2 * turn}));
  for (Eigen::Index p = 0; p < kPlaces.cols(); ++p) {
    double least = 1;
    for (const char* name : {"scale_0", "scale_1", "scale_2"}) {
      least = std::min(least, result.get(name, p));
    }
    EXPECT_NEAR(least, -10 + std::log(2), 1e-4);
  }
}

TEST_F(SplatFileTest, ColorsFollowTheCamera) {
  const Matrix3d turn = Eigen::AngleAxisd(2, Vector<3>(1, -2, 3).normalized()).toRotationMatrix();
  const Matrix3d stretch = Vector<3>(1, 2, 0.5).asDiagonal();
  for (const int degree : {1, 2, 3}) {
    SCOPED_TRACE(degree);
    const auto splats = random_splats(kPlaces, degree);
    const io::SplatFile read(file(splats.text()));
    // A stretch before the rotation does not turn the harmonics.
    for (const Matrix3d& j : {turn, Matrix3d(turn * stretch)}) {
      const auto result = splats.parse(moved(read, kPlaces, {j}));
      for (Eigen::Index p = 0; p < kPlaces.cols(); ++p) {
        const Vector<3> d = Vector<3>::Random().normalized();
        const Vector<3> difference = result.color(p, turn * d, degree) - splats.color(p, d, degree);
        EXPECT_LT(difference.norm(), 2e-6) << p;
      }
    }
  }
}

TEST_F(SplatFileTest, AllOtherBytesStay) {
  const auto splats = random_splats(kPlaces, 3);
  const auto text = splats.text() + "bytes at the end";
  const io::SplatFile read(file(text));
  EXPECT_EQ(moved(read, read.points(), {Matrix3d::Identity()}), text);
  const Matrix3d turn = Eigen::AngleAxisd(1, Vector<3>::UnitX()).toRotationMatrix();
  const auto result = moved(read, turn * kPlaces, {turn});
  ASSERT_EQ(result.size(), text.size());
  EXPECT_EQ(result.substr(result.size() - 16), "bytes at the end");
  const auto header = text.find("end_header");
  EXPECT_EQ(result.substr(0, header), text.substr(0, header));
  const auto after = splats.parse(result.substr(0, result.size() - 16));
  for (const char* name : {"nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "id"}) {
    for (Eigen::Index p = 0; p < kPlaces.cols(); ++p) {
      EXPECT_EQ(after.get(name, p), splats.get(name, p)) << name;
    }
  }
}

TEST_F(SplatFileTest, NormalsThatAreNotZeroFollow) {
  auto splats = random_splats(kPlaces, 0);
  splats.values.row(4).setConstant(2);
  Matrix3d shear = Matrix3d::Identity();
  shear(0, 1) = 1;
  const auto result = splats.parse(moved(io::SplatFile(file(splats.text())), kPlaces, {shear}));
  const Vector<3> expected = 2 * (shear.inverse().transpose() * Vector<3>::UnitY()).normalized();
  EXPECT_LT((result.values.block(3, 7, 3, 1).cast<double>() - expected).norm(), 1e-6);
}

TEST_F(SplatFileTest, OtherFilesAreNoSplats) {
  auto splats = random_splats(kPlaces, 1);
  EXPECT_TRUE(io::is_splat_file(file(splats.text())));
  EXPECT_FALSE(io::is_splat_file(file(splats.text(), "splats.obj")));
  EXPECT_FALSE(io::is_splat_file(path("missing.ply")));
  splats.names.back() = "other";
  splats.names[splats.names.size() - 2] = "rot_4";
  EXPECT_FALSE(io::is_splat_file(file(splats.text())));
  expect_refused(splats.text(), "no property \"rot_3\"");
}

TEST_F(SplatFileTest, DamagedFilesAreRefused) {
  const auto splats = random_splats(kPlaces, 1);
  const auto text = splats.text();
  expect_refused(text.substr(0, text.size() - 1), "ends within splat 49 of 50");
  expect_refused(text.substr(0, text.find("end_header")), "header");
  expect_refused(splats.text("ascii"), "must be binary and little-endian");
  expect_refused(splats.text("binary_big_endian"), "must be binary and little-endian");
  auto wrong = splats;
  wrong.at("scale_1", 7) = std::nanf("");
  expect_refused(wrong.text(), "splat 7 has numbers that are not finite");
  wrong = splats;
  for (const char* name : {"rot_0", "rot_1", "rot_2", "rot_3"}) wrong.at(name, 9) = 0;
  expect_refused(wrong.text(), "quaternion of splat 9 is 0");
  wrong = splats;
  wrong.names[10] = "other";
  expect_refused(wrong.text(), "properties f_rest");
  auto typed = text;
  typed.replace(typed.find("float opacity"), 5, "int32");
  expect_refused(typed, "\"opacity\" is not float");
  // And what does not fit.
  const io::SplatFile read(file(text));
  EXPECT_THROW(moved(read, kPlaces.leftCols(3), {Matrix3d::Identity()}), InputError);
  PointList<3> far = kPlaces;
  far(1, 4) = 1e300;
  EXPECT_THROW(moved(read, far, {Matrix3d::Identity()}), InputError);
}

}  // namespace
}  // namespace flbc::testing
