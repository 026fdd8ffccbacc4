// SPDX-License-Identifier: BSD-3-Clause
// flbc solve --history and flbc plot.
#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "support/command_line.h"

namespace flbc::testing {
namespace {

class PlotCommand : public CommandLineTest {
 protected:
  nlohmann::json solved(const std::string& name, const std::string& cage,
                        const std::string& options) const {
    const auto report = name + ".json";
    expect("solve " + cage + " -q --vertices 400 -o w.npy --report " + report + " " + options);
    return json_in(report);
  }
};

TEST_F(PlotCommand, AHistoryEndsAsTheReportSays) {
  for (const std::string cage : {"2d/letter_cage.obj", "3d/limb_cage.obj"}) {
    for (const std::string method : {"weights", "gradient", "lbc2014"}) {
      SCOPED_TRACE(cage + " " + method);
      const auto report = solved("r", cage, "--history --certify --method " + method);
      const auto& history = report["history"];
      const auto count = history["iterations"].size();
      ASSERT_GT(count, 2U);
      for (const auto& [name, values] : history.items()) EXPECT_EQ(values.size(), count) << name;
      int last = 0;
      double seconds = 0;
      for (std::size_t k = 0; k < count; ++k) {
        EXPECT_GE(history["iterations"][k], last);
        EXPECT_GE(history["seconds"][k], seconds);
        last = history["iterations"][k];
        seconds = history["seconds"][k];
      }
      int coarse = 0;
      for (const auto& level : report["coarse_levels"]) coarse += level["iterations"].get<int>();
      EXPECT_EQ(last, coarse + report["iterations"].get<int>());
      EXPECT_EQ(history["relative_primal_residual"].back(), report["relative_primal_residual"]);
      EXPECT_EQ(history["objective"].back(), report["objective"]);
      EXPECT_GE(history["objective"].back(), report["lower_bound"]);
      EXPECT_EQ(history["estimated_error"].back().is_number(), method != "lbc2014");
      // Where weights are at hand, their objective is near the last one's soon.
      if (method != "gradient") {
        EXPECT_NEAR(history["objective"][count - 2].get<double>(),
                    report["objective"].get<double>(), 0.01 * report["objective"].get<double>());
      }
      // Looking on changes nothing.
      const auto weights = slurp("w.npy");
      EXPECT_FALSE(solved("plain", cage, "--method " + method).contains("history"));
      EXPECT_EQ(slurp("w.npy"), weights);
    }
  }
}

TEST_F(PlotCommand, DrawsSeveralRunsInAllFormats) {
  solved("a", "2d/letter_cage.obj", "--history --certify");
  solved("b", "2d/letter_cage.obj", "--history --method gradient");
  for (const char* extension : {"png", "svg", "pdf"}) {
    const auto output = std::string("plot.") + extension;
    expect("plot a.json b.json --names splitting 'the paper' -o " + output);
    EXPECT_GT(slurp(output).size(), 3000U);
  }
  if (std::system("pdftotext plot.pdf plot.txt 2>/dev/null") != 0)
    GTEST_SKIP() << "needs pdftotext";
  const auto shown = slurp("plot.txt");
  for (const char* text :
       {"splitting", "the paper", "iterations", "seconds", "objective", "residual / threshold",
        "estimated error (mean squared)", "gap to the certified bound"}) {
    EXPECT_NE(shown.find(text), std::string::npos) << text;
  }
}

TEST_F(PlotCommand, RefusesWhatIsNoHistory) {
  solved("plain", "2d/letter_cage.obj", "--method harmonic --history");
  const auto plot = [&](const std::string& report) { return "plot " + report + " -o p.png"; };
  expect(plot("plain.json"), 2, "plain.json: has no history");
  expect(plot("absent.json"), 4, "absent.json");
  expect(plot(file("text.json", "no json")), 2, "text.json: not a report");
  expect(plot(file("list.json", "[1, 2]")), 2, "list.json: has no history");
  const std::string damaged = "{\"history\": {\"iterations\": [1, 2], \"finer_levels\": [0]}}";
  expect(plot(file("bad.json", damaged)), 2, "bad.json: the history is damaged");
  expect("plot plain.json -o p.gif", 1);
}

}  // namespace
}  // namespace flbc::testing
