// Pictures of the same charts by several packers, side by side.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "evaluate/statistics.h"

namespace wrapatlas {

/// A mesh worth a look, and why.
struct Exhibit {
  const MeshResult* mesh = nullptr;
  Shapes shapes = Shapes::square;
  std::string why;
};

/// The paper's Figures 1 and 9 to 12, as near as the meshes allow: the one with the most charts,
/// and of kinds it shows (table, fish, airplane), or else of all, the one in the middle by
/// efficiency; both in the square and on the best shape. `last`: the contender that is judged by.
std::vector<Exhibit> typical_exhibits(std::span<const MeshResult> meshes, const std::string& last,
                                      bool all_shapes);

/// Where `last` is lowest, and where another is ahead of it the most.
std::vector<Exhibit> worst_exhibits(std::span<const MeshResult> meshes,
                                    std::span<const std::string> contenders,
                                    const std::string& last);

/// HTML, pictures within it. `cache`: the folder of charts. Errors: input, output.
Result<std::string> gallery_html(std::span<const Exhibit> exhibits,
                                 std::span<const std::string> contenders,
                                 const std::filesystem::path& cache);

}  // namespace wrapatlas
