// SPDX-License-Identifier: BSD-3-Clause
// The pages of flbc compare.
#include <omp.h>
#include <algorithm>
#include <numeric>
#include <sstream>

#include "compare/comparison.h"
#include "draw/canvas.h"
#include "flbc/io/files.h"
#include "instantiate.h"
#include "report/properties.h"
#include "text/text_writer.h"
#include "view/model_page.h"

namespace flbc::app {
namespace {

// Switches the page in the frame; the next page takes over control points and camera.
constexpr const char* kSwitch = R"(<script>
const frame = document.querySelector("iframe"), menu = document.querySelector("select");
let state = null;
const open = () => { frame.src = `model_${menu.value}.html`; };
menu.addEventListener("change", () => {
  state = null;
  frame.contentWindow.postMessage({ ask: "state" }, "*");
});
window.addEventListener("message", ({ data, source }) => {
  if (source !== frame.contentWindow || !data) return;
  if (data.points) {
    state = data;
    open();
  } else if (state) {
    frame.contentWindow.postMessage(state, "*");
  }
});
</script>
)";

template <int Dim>
TextTable table_of(const Comparison<Dim>& all) {
  std::vector<std::pair<std::string, nlohmann::ordered_json>> properties;
  for (const auto* column : all.succeeded()) properties.emplace_back(column->name, column->facts);
  return property_table(properties);
}

// Where the numbers come from.
template <int Dim>
std::string description(const Comparison<Dim>& all) {
  return std::to_string(all.domain.num_vertices()) + " vertices and " +
         std::to_string(all.domain.num_cells()) + " cells of the mesh, " + "up to " +
         std::to_string(omp_get_max_threads()) + " threads, " +
         (all.pose.cols() > 0 ? "the given pose"
                              : "poses: bent by 45 degrees, stretched by 40%, twisted by 60 "
                                "degrees (3D)");
}

// Those of most influence, with the same sum, for weights that need not reproduce the points.
WeightMatrix largest_weights(WeightMatrix weights) {
  const auto most = std::min<Eigen::Index>(view::kMostInfluences, weights.rows());
  std::vector<Eigen::Index> order(static_cast<std::size_t>(weights.rows()));
  std::iota(order.begin(), order.end(), 0);
  for (auto column : weights.colwise()) {
    std::nth_element(order.begin(), order.begin() + most - 1, order.end(),
                     [&](auto i, auto j) { return column[i] > column[j]; });
    const double sum = column.sum();
    for (std::size_t k = static_cast<std::size_t>(most); k < order.size(); ++k) {
      column[order[k]] = 0;
    }
    column *= sum / column.sum();
  }
  return weights;
}

// A page in which the cage can be moved.
template <int Dim>
std::string viewer_of(const Comparison<Dim>& all, const Column<Dim>& column) {
  const auto& arguments = all.arguments;
  const auto page = all.folder.path_of(column.page_file());
  view::PageContent<Dim> content;
  content.title = column.name;
  content.model_file =
      arguments.model.empty() ? domain_file<Dim>() : path_beside(page, arguments.model);
  content.weights_file = column.weights_file();
  content.cage_file = path_beside(page, arguments.cage);
  content.cage = load_shown_cage<Dim>(arguments.cage);
  content.points = all.points();
  look_from_front(content, arguments.view.up);
  content.surface = all.shape.surface;
  content.weights = column.settings.coordinates == Coordinates::kBiharmonic
                        ? largest_weights(column.rows.dense())
                        : view::limit_influences<Dim>(all.cage.points, all.points(),
                                                      column.rows.dense(), view::kMostInfluences);
  if (all.pose.cols() > 0) content.poses = {{arguments.pose, 1, all.pose}};
  return view::make_page(content);
}

std::string row_of(const std::vector<std::string>& cells, const std::string& tag) {
  std::string row = "<tr>";
  for (const auto& text : cells) row += "<" + tag + ">" + text + "</" + tag + ">";
  return row + "</tr>\n";
}

}  // namespace

template <int Dim>
void write_viewers(Comparison<Dim>& all) {
  for (const auto* column : all.succeeded()) {
    if (column->has_normals()) continue;
    const auto page = viewer_of(all, *column);
    all.folder.add(column->page_file(), "", [&](const std::string& path) {
      io::write_file(path, [&](std::ostream& file) { file << page; });
    });
  }
}

template <int Dim>
std::string comparison_text(const Comparison<Dim>& all) {
  const auto table = table_of(all);
  std::string text =
      to_text(table) + "\n" + description(all) + "\n" + to_text(property_legend(table)) + "\n";
  for (const auto& column : all.columns) {
    if (!column.failure.empty()) text += column.name + " failed: " + column.failure + "\n";
  }
  return text;
}

template <int Dim>
std::string comparison_page(const Comparison<Dim>& all, const std::vector<std::string>& pictures) {
  std::ostringstream page;
  const auto title = "Coordinates of " + io::escaped(all.arguments.cage);
  page << "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n"
       << "<link rel=\"icon\" href=\"data:,\"><title>" << title << "</title>\n"
       << "<style>body{font:15px sans-serif;margin:2em}table{border-collapse:collapse}"
       << "td,th{border:1px solid #999;padding:4px 8px;text-align:right}"
       << "td:first-child{text-align:left}img{max-width:100%}"
       << "iframe{width:100%;height:80vh;border:1px solid #999}</style>\n<h1>" << title
       << "</h1>\n<p>" << description(all) << "</p>\n<table>\n";
  const auto table = table_of(all);
  for (std::size_t k = 0; k < table.size(); ++k) page << row_of(table[k], k == 0 ? "th" : "td");
  page << "</table>\n<ul>\n";
  for (const auto& entry : property_legend(table)) {
    page << "<li><b>" << entry[0] << "</b>: " << entry[1] << "</li>\n";
  }
  page << "</ul>\n";
  for (const auto& column : all.columns) {
    if (column.failure.empty()) continue;
    page << "<p>" << column.name << " failed: " << io::escaped(column.failure) << "</p>\n";
  }
  for (const auto& name : pictures) {
    // A PDF is no image of a page.
    if (all.arguments.pictures == "pdf") continue;
    page << "<p><img src=\"" << name << "\" alt=\"all coordinates next to each other\"></p>\n";
  }
  std::string menu;
  std::string first;
  for (const auto* column : all.succeeded()) {
    if (column->has_normals()) continue;
    menu += "<option>" + column->name + "</option>";
    if (first.empty()) first = column->page_file();
  }
  if (!menu.empty()) {
    page
        << "<p><label>Drag the cage with <select>" << menu
        << "</select> coordinates</label>. The page does not move normals, which Green coordinates "
           "need.</p>\n<iframe src=\""
        << first << "\" title=\"model\"></iframe>\n"
        << kSwitch;
  }
  page << "</html>\n";
  return page.str();
}

FLBC_INSTANTIATE_FUNCTION(write_viewers)
FLBC_INSTANTIATE_FUNCTION(comparison_text)
FLBC_INSTANTIATE_FUNCTION(comparison_page)

}  // namespace flbc::app
