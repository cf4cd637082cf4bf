// The guided packer: see docs/algorithms/guided.md.
#pragma once

#include <optional>
#include <span>

#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// Every move looks at all charts and at the whole domain: with more of them pack() uses modulo.
inline constexpr std::size_t kMostGuidedCharts = 200;

/// pack() for Method::guided, its options checked. Nothing if none was found.
std::optional<Packing> pack_guided(std::span<const Chart> charts, const PackOptions& options);

}  // namespace wrapatlas
