// One mesh packed by every contender, each packing checked.
#pragma once

#include <functional>

#include "evaluate/mesh_charts.h"

namespace wrapatlas {

/// Runs all contenders of the setting over the charts, on the caller's thread. Of a run that fails
/// the row says why. Placements are kept of the square, or else the one size, and of the densest
/// shape of each contender. Error: interrupted, if `stop` said so.
Result<std::vector<Run>> run_contenders(const MeshCharts& mesh, const Setting& setting,
                                        const std::function<bool()>& stop);

}  // namespace wrapatlas
