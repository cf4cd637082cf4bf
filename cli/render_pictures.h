// The pictures that wrapatlas render reads.
#pragma once

#include <string>

#include "wrapatlas/render.h"
#include "wrapatlas/result.h"

namespace wrapatlas::cli {

/// The texture in a file and its mip levels: normals if they are `directions`, else colours. No
/// path, no levels.
Status read_maps(const std::string& path, bool directions, int threads, MipMaps& maps);

/// Compares what both show: over the pixels that show the model in full.
Result<Likeness> likeness_to(const std::string& path, const Rendering& rendering, int threads);

}  // namespace wrapatlas::cli
