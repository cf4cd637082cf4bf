// The guided packer: see docs/algorithms/guided.md.
#pragma once

#include <span>

#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

/// pack() for Method::guided, its options checked.
Result<Packing> pack_guided(std::span<const Chart> charts, const PackOptions& options);

}  // namespace wrapatlas
