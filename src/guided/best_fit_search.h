// The largest scale at which best fit places all charts.
#pragma once

#include <span>

#include "guided/piece_library.h"
#include "guided/record.h"
#include "pack/frame.h"

namespace wrapatlas {

/// Offers what best fit finds on each of the frames. Stops once the largest scale is known, or, if
/// the record keeps a time, goes on with other orders of the charts.
void search_best_fit(std::span<const ChartShape> shapes, const PackOptions& options,
                     std::span<const Frame> frames, Record& record);

}  // namespace wrapatlas
