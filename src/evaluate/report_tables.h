// Tables of the report, in HTML and in Markdown.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "evaluate/statistics.h"

namespace wrapatlas {

/// Cells of the first column are to the left, the others to the right.
struct Table {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> headings;  ///< rows with one cell: titles of what follows
};

std::string as_html(const Table& table);
std::string as_markdown(const Table& table);

/// The rows of the paper's Table 1; its own figures beside ours in brackets if `beside_paper`.
Table paper_table(std::span<const MeshResult> meshes, std::span<const std::string> contenders,
                  bool all_shapes, bool beside_paper);

/// Mean efficiency in the square, a row for each kind of mesh.
Table group_table(std::span<const MeshResult> meshes, std::span<const std::string> contenders);

/// A row for each mesh: charts, stretch, efficiency in the square and on the best shape.
Table mesh_table(std::span<const MeshResult> meshes, std::span<const std::string> contenders,
                 bool all_shapes);

}  // namespace wrapatlas
