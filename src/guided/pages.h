// Several pages, or a given density: see docs/algorithms/pages.md.
#pragma once

#include <span>

#include "guided/piece_library.h"
#include "pack/frame.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// pack() for Method::guided with options.pages or options.density, options and charts checked.
Result<Packing> pack_pages(std::span<const ChartShape> shapes, const PackOptions& options,
                           std::span<const Frame> frames);

}  // namespace wrapatlas
