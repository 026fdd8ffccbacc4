// SPDX-License-Identifier: BSD-3-Clause
// The table and the page of flbc compare.
#include <omp.h>
#include <sstream>

#include "compare/comparison.h"
#include "draw/canvas.h"
#include "flbc/io/files.h"
#include "front/instantiate.h"
#include "report/properties.h"
#include "text/text_writer.h"

namespace flbc::app {
namespace {

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

std::string row_of(const std::vector<std::string>& cells, const std::string& tag) {
  std::string row = "<tr>";
  for (const auto& text : cells) row += "<" + tag + ">" + text + "</" + tag + ">";
  return row + "</tr>\n";
}

}  // namespace

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
       << "td:first-child{text-align:left}img{max-width:100%}</style>\n<h1>" << title
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
  page << "<p>flbc view draws a page in which the cage can be moved, by the weights_*.npy next to "
          "this page.</p>\n";
  page << "</html>\n";
  return page.str();
}

FLBC_INSTANTIATE_FUNCTION(comparison_text)
FLBC_INSTANTIATE_FUNCTION(comparison_page)

}  // namespace flbc::app
