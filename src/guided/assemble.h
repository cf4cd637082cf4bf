// Charts that were cut from one sheet, put together again: joined where their borders match, and
// the whole laid on the atlas it fills.
#pragma once

#include <optional>
#include <span>

#include "guided/effort.h"
#include "guided/layout.h"
#include "pack/frame.h"

namespace wrapatlas {

struct Assembly {
  std::size_t frame = 0;  ///< the one that the charts fill
  Layout layout;
};

/// Where all charts lie if they fit together and fill one of the frames, but for hairlines between
/// them: the layout's scale is that of a full atlas. Nothing if they do not or the effort is spent.
/// `seconds`: of one thread, that finding matches may take; with too few it does not begin.
std::optional<Assembly> assemble(std::span<const ChartShape> shapes, std::span<const Frame> frames,
                                 const PackOptions& options, double seconds, const Effort& effort);

}  // namespace wrapatlas
