// What the results of an evaluation come to: Table 1 of Nöll & Stricker 2011 and what is around it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluate/mesh_result.h"

namespace wrapatlas {

/// What one contender reached on one mesh. An efficiency of 0: nothing.
struct Reached {
  double efficiency = 0;
  double raster_seconds = 0, seconds = 0;  ///< of all that was tried for it
  const Run* run = nullptr;                ///< the packing; null: none
};

/// In the square, and on the best shape that was tried.
enum class Shapes { square, variable };
Reached reached(const MeshResult& mesh, const std::string& contender, Shapes shapes);

struct Summary {
  std::string contender;
  double best_of_paper = 0;  ///< share of meshes on which none of the paper's four is denser
  double best_of_all = 0;    ///< the same of all contenders
  double mean = 0, median = 0, min = 0, max = 0;  ///< efficiency
  double raster_seconds = 0, seconds = 0;         ///< mean
};

/// Packers of the paper's table; others are told apart from them.
bool is_of_paper(const std::string& contender);

/// One for each contender. Meshes without results are left out.
std::vector<Summary> summarize(std::span<const MeshResult> meshes,
                               std::span<const std::string> contenders, Shapes shapes);

/// Mean efficiency by shape: the paper's Figure 8.
struct ShapeMean {
  double aspect = 1;  ///< width by height
  double mean = 0;
};
std::vector<ShapeMean> means_by_shape(std::span<const MeshResult> meshes,
                                      const std::string& contender);

/// A sentence of the paper, and what became of it here.
struct Claim {
  std::string text;      ///< what the paper says
  std::string measured;  ///< what is measured
  bool holds = false;
};
/// Those that can be judged: empty unless the paper's four packers took part.
std::vector<Claim> claims(std::span<const MeshResult> meshes,
                          std::span<const std::string> contenders, bool all_shapes);

}  // namespace wrapatlas
