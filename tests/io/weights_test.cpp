// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/weights_io.h"

#include <clocale>
#include <cmath>
#include <limits>
#include <locale>

#include "flbc/io/files.h"
#include "format_test.h"

namespace flbc::io {
namespace {

using flbc::testing::awkward_numbers;
using flbc::testing::bit_equal;
using flbc::testing::expect_error;
using flbc::testing::FormatTest;
using flbc::testing::Malformed;

// 2 control points and 3 points; all numbers differ, so that no transposition goes unnoticed.
WeightMatrix small_weights() {
  WeightMatrix weights(2, 3);
  weights << 1, 2, 3,  //
      4, 5, 6;
  return weights;
}

class WeightsFile : public FormatTest {
 protected:
  void expect_malformed(const std::string& name, const std::vector<Malformed>& cases) const {
    FormatTest::expect_malformed(name, read_weights, cases);
  }
  void expect_small_weights(const std::string& name, const std::vector<std::string>& contents) {
    for (const std::string& bytes : contents) {
      EXPECT_TRUE(bit_equal(read_weights(make(name, bytes)).dense(), small_weights())) << bytes;
    }
  }
  void expect_round_trips(const WeightMatrix& weights) const {
    for (const std::string extension : {"mtx", "npy", "NPY", "csv"}) {
      if (extension == "csv" && weights.size() == 0) continue;  // has no sizes
      const std::string file = path("weights." + extension);
      write_weights(file, weights);
      EXPECT_TRUE(bit_equal(read_weights(file).dense(), weights)) << extension;
    }
  }
};

// 3 control points, as many points as needed.
WeightMatrix awkward_weights() {
  const std::vector<double> numbers = awkward_numbers();
  WeightMatrix weights = WeightMatrix::Zero(3, static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t k = 0; k < numbers.size(); ++k) weights(k % 3, k) = numbers[k];
  return weights;
}

std::string doubles(std::initializer_list<double> values) {
  std::string bytes;
  for (const double value : values) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return bytes;
}

// A header as NumPy would write it.
std::string npy(const std::string& dictionary, char version = 1) {
  std::string header("\x93NUMPY");
  header += {version, '\0', static_cast<char>(dictionary.size()), '\0'};
  if (version > 1) header += {'\0', '\0'};
  return header + dictionary;
}

TEST_F(WeightsFile, RoundTripsAreBitEqual) {
  expect_round_trips(awkward_weights());
  WeightMatrix random(7, 300);
  std::uint64_t state = 1;
  for (double& value : random.reshaped()) {
    do {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const std::uint64_t bits = state ^ (state >> 29);
      std::memcpy(&value, &bits, sizeof value);
    } while (!std::isfinite(value) || value == 0);
  }
  expect_round_trips(random);
  for (const auto& [controls, points] : {std::pair{1, 1}, {1, 5}, {5, 1}, {4, 0}, {0, 4}}) {
    expect_round_trips(WeightMatrix::Constant(controls, points, 0.25));
  }
}

TEST_F(WeightsFile, CsvHasALinePerPoint) {
  write_weights(path("weights.csv"), small_weights());
  EXPECT_EQ(content("weights.csv"), "1,4\n2,5\n3,6\n");
  make("weights.csv", "# by hand\r\n 1, 4\r\n2 ,5,\n3 6");
  EXPECT_EQ(read_weights(path("weights.csv")).dense(), small_weights());
  expect_malformed("weights.csv", {{"", ":1: ", "no numbers"},
                                   {"1,2\n3\n", ":2: ", "expected 2 numbers"},
                                   {"w_0,w_1\n1,2\n", ":1: ", "w_0"},
                                   {"# a,,b\n1,,2\n1,,2\n", ":2: ", "column 2 is empty"},
                                   {"1,2\r\n ,2\r\n", ":2: ", "column 1 is empty"},
                                   {"1,nan\n", ":1: ", "nan"}});
}

TEST_F(WeightsFile, NegativeZeroHasNoEntryInMtx) {
  WeightMatrix weights(2, 1);
  weights << -0.0, 1;
  write_weights(path("weights.mtx"), weights);
  EXPECT_EQ(read_weights(path("weights.mtx")).dense()(0, 0), 0);
  flbc::testing::expect_piece(content("weights.mtx"), "\n1 2 1\n1 2 1\n");
}

TEST_F(WeightsFile, MtxHasPointsAsRows) {
  write_weights(path("weights.mtx"), small_weights());
  const std::string written = content("weights.mtx");
  EXPECT_EQ(written.find("%%MatrixMarket matrix coordinate real general\n"), 0u);
  flbc::testing::expect_piece(written, "\n3 2 6\n");
  flbc::testing::expect_piece(written, "\n3 1 3\n");
  flbc::testing::expect_piece(written, "\n1 2 4\n");
}

TEST_F(WeightsFile, NpyIsWrittenByPointAndAligned) {
  write_weights(path("weights.npy"), small_weights());
  const std::string written = content("weights.npy");
  const std::string numbers = doubles({1, 4, 2, 5, 3, 6});
  ASSERT_GT(written.size(), numbers.size() + 10);
  const std::size_t start = written.size() - numbers.size();
  EXPECT_EQ(written.substr(start), numbers);
  EXPECT_EQ(start % 64, 0u);
  EXPECT_EQ(written.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(static_cast<unsigned char>(written[8]) + 256 * static_cast<unsigned char>(written[9]),
            start - 10);
  EXPECT_EQ(written[start - 1], '\n');
  const std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }";
  EXPECT_EQ(written.substr(10, dictionary.size()), dictionary);
  EXPECT_EQ(written.find_first_not_of(' ', 10 + dictionary.size()), start - 1);
}

TEST_F(WeightsFile, MtxVariants) {
  const std::vector<std::string> variants = {
      "%%MatrixMarket matrix coordinate real general\n% note\n\n3 2 6\n"
      "3 2 6\n1 1 1\n2 1 +2e0\n%\n1 2 4.\n2 2 .5e1\n3 1 30E-1",
      "%%matrixmarket MATRIX Coordinate INTEGER General\r\n3 2 6\r\n"
      "1 1 1\r\n2 1 2\r\n3 1 3\r\n1 2 4\r\n2 2 5\r\n3 2 6\r\n",
  };
  expect_small_weights("w.mtx", variants);
}

TEST_F(WeightsFile, NpyVariants) {
  const std::string by_point = doubles({1, 4, 2, 5, 3, 6});
  const std::string by_control = doubles({1, 2, 3, 4, 5, 6});
  const float floats[] = {1, 4, 2, 5, 3, 6};
  const std::string single(reinterpret_cast<const char*>(floats), sizeof floats);
  const std::vector<std::string> variants = {
      npy("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }\n") + by_point,
      npy("{'descr': '<f8', 'fortran_order': True, 'shape': (3, 2), }   \n") + by_control,
      npy("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 2), }\n") + single,
      npy("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }\n", 2) + by_point,
      npy("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }\n", 3) + by_point,
      npy("{\"shape\":(3L,2L),\"fortran_order\":False,\"descr\":\"<f8\"}") + by_point,
  };
  expect_small_weights("w.npy", variants);
}

TEST_F(WeightsFile, MalformedMtx) {
  const std::string head = "%%MatrixMarket matrix coordinate real general\n";
  expect_malformed(
      "w.mtx",
      {{"", ":1: ", "%%MatrixMarket"},
       {std::string("\0\x01\xff\xfe\0\0garbage", 13), ":1: ", "%%MatrixMarket"},
       {"%%MatrixMarket matrix coordinate pattern general\n", ":1: ", "field \"pattern\""},
       {"%%MatrixMarket matrix coordinate real symmetric\n", ":1: ", "symmetry \"symmetric\""},
       {head + "16666666 0 0\n", ":2: ", "only 0 entries"},
       {head + "3 2 1\n1 0 1\n", ":3: ", "columns are numbered 1 to 2"},
       {head, ":1: ", "the file ends before the size"},
       {head + "3 2 x\n1 1 1\n", ":2: ", "expected an integer, found \"x\""},
       {head + "-3 2 1\n1 1 1\n", ":2: ", "-3 rows are declared"},
       {head + "3 2 1000000000\n1 1 1\n", ":2: ", "too short"},
       {head + "2000000000 2000000000 1\n1 1 1\n", ":2: ", "only 1 entries"},
       {"%%MatrixMarket matrix array real general\n", ":1: ", "format \"array\""},
       {head + "3 2 2\n1 1 1\n% cut off\n", ":4: ", "the file ends after 1 of 2 entries"},
       {head + "3 2 1\n1 1 1\n2 2 1\n", ":4: ", "expected the end of the file"},
       {head + "3 2 1\n4 1 1\n", ":3: ", "rows are numbered 1 to 3"},
       {head + "3 2 2\n1 1 1\n1 1 1\n", ":4: ", "row 1, column 1 occurs twice"},
       {head + "3 2 1\n1 1 1 1\n", ":3: ", "expected the end of the line, found \"1\""},
       {head + "3 2 1\n1 1 0x1p3\n", ":3: ", "expected a number, found \"0x1p3\""},
       {head + "3 2 1\n1 1 1e400\n", ":3: ", "\"1e400\" is too large"},
       {head + "3 2 1\n1 1 nan\n", ":3: ", "expected a finite number, found \"nan\""}});
}

TEST_F(WeightsFile, MalformedNpy) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }";
  const std::string data = doubles({1, 4, 2, 5, 3, 6});
  const auto with = [&](const std::string& dictionary) { return npy(dictionary) + data; };
  expect_malformed(
      "w.npy",
      {{"", ": at byte 0: ", "not a NumPy"},
       {"\x93NUMPY", ": at byte 6: ", "ends inside its header"},
       {npy(head).substr(0, 30), ": at byte 30: ", "ends inside its header"},
       {npy(head, 9), ": at byte 6: ", "version 9"},
       {with("{'descr': '>f8', 'fortran_order': False, 'shape': (3, 2), }"), ": ", "\">f8\""},
       {with("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (3, 2), }"),
        ": at byte 20: ", "structured"},
       {with("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2, 1), }"), ": ",
        "3 dimensions"},
       {with("{'descr': '<f8', 'fortran_order': False, 'shape': (-3, 2), }"),
        ": at byte 61: ", "number of elements"},
       {with("{'descr': '<f8', 'fortran_order': False, 'shape': (9999999999, 2)}"), ": ",
        "not a weight matrix"},
       {with("{'descr': '<f8', 'fortran_order': Maybe, 'shape': (3, 2)}"),
        ": at byte 44: ", "True or False"},
       {with("{'descr': '<f8', 'fortran_order': False}"), ": ", "no 'shape'"},
       {npy(head) + data.substr(0, 45), ": ", "45 bytes of numbers"},
       {npy(head) + data + "!", ": ", "49 bytes of numbers"},
       {npy(head) + doubles({1, 4, 2, infinity, 3, 6}), ": ",
        "number 3 is inf, which is not finite"}});
}

TEST_F(WeightsFile, OtherExtensionsAreRefused) {
  for (const std::string name : {"weights.txt", "weights.mat", "weights", "-"}) {
    const std::string file = name == "-" ? name : path(name);
    expect_error<OptionError>([&] { read_weights(file).dense(); },
                              {file, ".mtx, .npy, .csv or .npz"});
    expect_error<OptionError>([&] { write_weights(file, small_weights()); },
                              {file, ".mtx, .npy, .csv or .npz"});
  }
  EXPECT_TRUE(names().empty());
}

TEST_F(WeightsFile, FilesThatCannotBeOpened) {
  expect_unopenable({"mtx", "npy"}, read_weights,
                    [](const auto& file) { write_weights(file, small_weights()); });
}

TEST_F(WeightsFile, WeightsThatAreNotFiniteAreNotWritten) {
  WeightMatrix weights = small_weights();
  weights(1, 2) = std::numeric_limits<double>::quiet_NaN();
  for (const std::string extension : {"mtx", "npy"}) {
    expect_error<InputError>([&] { write_weights(path("w." + extension), weights); },
                             {"control point 1 at point 2 is not finite"});
  }
  EXPECT_TRUE(names().empty());
}

// What many languages do, without relying on their locales being installed.
struct CommaAndGroups : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\1"; }
};

TEST_F(WeightsFile, NumbersDoNotDependOnTheLocale) {
  const WeightMatrix weights = awkward_weights();
  const std::locale previous = std::locale::global(std::locale({}, new CommaAndGroups));
  const std::string c_locale = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  expect_round_trips(weights);
  std::setlocale(LC_ALL, c_locale.c_str());
  std::locale::global(previous);
}

}  // namespace
}  // namespace flbc::io
