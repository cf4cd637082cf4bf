// What wrapatlas bake is told, and what it leaves behind.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common.h"
#include "options.h"
#include "output_paths.h"
#include "wrapatlas/bake.h"

namespace wrapatlas::cli {

struct BakeArguments {
  std::string low, high, output, color, json;
  BakedMap map = BakedMap::tangent_normals;
  std::vector<std::string> also;  ///< "KIND=FILE"
  Resolution resolution;
  std::optional<double> hard_edges, high_hard_edges;  ///< degrees
  int bits = 8, texcoord = 0, high_texcoord = 0;
  bool mips = false, no_fit = false, quiet = false;
  BakeOptions options;
  std::vector<BakedMap> maps;
  std::vector<OutputPath> outputs;  ///< of the maps, in their order
};

/// "map.png" -> "map.3.png"
std::string level_path(const std::string& path, std::size_t level);

/// Writes one of the maps, and its smaller levels if they are asked for. Levels are made of light,
/// and colours written as sRGB.
Status save_map(const BakeArguments& arguments, std::size_t number, Texture& texture);

Json report_of(const BakeArguments& arguments, const BakeResult& result, double seconds,
               double baking);

void summarize(const BakeArguments& arguments, const BakeResult& result, double seconds);

}  // namespace wrapatlas::cli
