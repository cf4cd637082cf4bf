// The guided packer: see docs/algorithms/guided.md.
#pragma once

#include <span>

#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// Another way to pack, for a first packing to be better than. `area`: of all charts.
using FirstPacker = Result<Packing> (*)(std::span<const Chart> charts, const PackOptions& options,
                                        double area);

/// pack() for Method::guided, its options and charts checked.
Result<Packing> pack_guided(std::span<const Chart> charts, const PackOptions& options,
                            FirstPacker first);

}  // namespace wrapatlas
