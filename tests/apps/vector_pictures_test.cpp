// SPDX-License-Identifier: BSD-3-Clause
// Vector pictures of the program, as other programs read them.
#include "support/command_line.h"
#include "support/png_image.h"

namespace flbc::testing {
namespace {

using draw::Color;
using draw::Image;

// Blocks of so many pixels become one.
Image averaged(const Image& fine, int scale) {
  Image coarse{fine.width / scale, fine.height / scale, {}};
  const float share = 1.0F / static_cast<float>(scale * scale);
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      Color& sum = coarse.pixels.emplace_back();
      for (int k = 0; k < scale * scale; ++k) {
        const Color part = fine.at(x * scale + k % scale, y * scale + k / scale);
        sum = {sum.r + share * part.r, sum.g + share * part.g, sum.b + share * part.b};
      }
    }
  }
  return coarse;
}

// Whether every element ends, in order.
void expect_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (auto begin = xml.find('<'); begin != std::string::npos; begin = xml.find('<', begin + 1)) {
    const auto end = xml.find('>', begin);
    ASSERT_NE(end, std::string::npos);
    const auto tag = xml.substr(begin + 1, end - begin - 1);
    ASSERT_FALSE(tag.empty());
    ASSERT_EQ(tag.find('<'), std::string::npos);
    if (tag.front() == '?' || tag.back() == '/') continue;
    if (tag.front() == '/') {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(tag.substr(1), open.back());
      open.pop_back();
    } else {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  EXPECT_TRUE(open.empty());
}

class VectorPictures : public CommandLineTest {
 protected:
  // Pictures of one scene in all formats. \return the arguments but for the output
  void draw(const std::string& arguments) const {
    for (const char* extension : {"png", "svg", "pdf"}) {
      expect("draw " + arguments + " --width 400 -o p." + extension);
    }
  }

  std::string output_of(const std::string& command) const {
    EXPECT_EQ(status_of(command + " >text.txt 2>/dev/null"), 0) << command;
    return slurp("text.txt");
  }

  // Programs differ in how they blend lines: compares the sum of differences with the ink there is,
  // and counts channels that differ clearly.
  // \param scale  of the other picture: fine lines are never thinner than its pixels
  void expect_same_picture(const std::string& other, int scale = 1) const {
    const auto a = draw::decode_png(slurp("p.png"));
    const auto b = averaged(draw::decode_png(slurp(other)), scale);
    ASSERT_EQ(a.width, b.width) << other;
    ASSERT_EQ(a.height, b.height) << other;
    double sum = 0, ink = 0;
    int clear = 0;
    for (std::size_t k = 0; k < a.pixels.size(); ++k) {
      const Color p = a.pixels[k], q = b.pixels[k];
      for (const auto& [u, v] : {std::pair(p.r, q.r), {p.g, q.g}, {p.b, q.b}}) {
        sum += static_cast<double>(std::abs(u - v));
        ink += static_cast<double>(1 - u);
        clear += std::abs(u - v) > 0.25F;
      }
    }
    EXPECT_LT(sum, 0.15 * ink) << other;
    EXPECT_LT(clear / (3.0 * static_cast<double>(a.pixels.size())), 0.02) << other;
  }

  void expect_all_formats_agree(const std::string& arguments, const std::string& label) const {
    SCOPED_TRACE(arguments);
    draw(arguments);
    const auto svg = slurp("p.svg"), pdf = slurp("p.pdf");
    expect_well_formed(svg);
    EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    EXPECT_LT(svg.size(), 2000000U);
    EXPECT_LT(pdf.size(), 2000000U);
    for (const std::string name : {"png", "svg", "pdf"}) {
      expect("draw " + arguments + " --width 400 -o again." + name);
      EXPECT_EQ(slurp("again." + name), slurp("p." + name));
    }
    if (has_program("pdftotext")) {
      const auto text = output_of("pdftotext p.pdf -");
      expect_piece(text, label);
    }
    if (has_program("pdftoppm")) {  // a pixel is 0.375 points of 1/72 inch
      output_of("pdftoppm -png -r 768 -singlefile p.pdf of_pdf");
      expect_same_picture("of_pdf.png", 4);
    }
    if (has_program("rsvg-convert")) {
      output_of("rsvg-convert p.svg -o of_svg.png");
      expect_same_picture("of_svg.png");
    }
  }
};

TEST_F(VectorPictures, ShowWhatPngShows) {
  struct Scene {
    std::string name, mesh, control_point, all;  // texts of the pictures, but for the names
  };
  for (const Scene& scene :
       {Scene{"2d/figure", "d.obj", "0.5", "17"}, Scene{"3d/limb", "d.mesh", "0.5", "11"}}) {
    const bool plane = scene.mesh == "d.obj";
    const auto cage = scene.name + "_cage.obj", model = scene.name + "_model.obj";
    const auto solve = "solve " + cage + " --method harmonic --vertices 800 -q -o ";
    expect(solve + "w.npy --save-domain " + scene.mesh);
    expect(solve + "m.npy --model " + model);
    const auto domain = scene.mesh + " --weights w.npy --cage " + cage;
    const auto of_model = model + " --weights m.npy --cage " + cage;
    expect_all_formats_agree(domain + " --control-point 3", scene.control_point);
    expect_all_formats_agree(domain + " --all", scene.all);
    expect_all_formats_agree(of_model + " --pose " + scene.name + "_cage_pose.obj", "Pose");
    if (!plane) expect_all_formats_agree(of_model + " --all", scene.all);
    if (plane) expect("draw " + of_model + " --all -o p.png");
    expect("draw " + of_model + " --control-point 3 -o p.png");
    expect("draw " + of_model + " --control-point 1000 -o none.png", 1, "must be in [0, ");
    expect("draw --weights m.npy -o none.png --cage " + cage, 1, "MODEL is missing");
    const std::string other = plane ? "2d/letter_cage.obj" : "3d/star_cage.obj";
    expect("draw " + of_model + " -o none.png --pose " + other, 2, other);
  }
}

TEST_F(VectorPictures, UnknownFormatsAreNamed) {
  const auto result = expect("draw d.obj --weights w.npy --cage 2d/figure_cage.obj -o p.jpg", 1,
                             ".png, .svg, .pdf");
  expect_piece(result.errors, "'.jpg'");
}

}  // namespace
}  // namespace flbc::testing
