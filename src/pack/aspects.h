// The shapes of texture that a packer tries.
#pragma once

#include <optional>
#include <vector>

#include "pack/frame.h"

namespace wrapatlas {

/// A grid on every shape that options.aspect asks for, its cells about `cell` texels long, the
/// most square shapes first. Shapes on which the margin leaves no room are left out, if others have
/// some. Errors: usage.
Result<std::vector<Frame>> make_frames(const PackOptions& options, double cell);

/// Turned by a right angle, charts fill a shape of atlas as well as its mirror image, unless only
/// one of its axes wraps: of such two the second is left out, or the one that `begun`, a packing to
/// go on from, is not on.
std::vector<Frame> without_mirrored(const std::vector<Frame>& frames, Wrap wrap,
                                    const std::optional<Packing>& begun);

/// A grid on the shape nearest to an aspect, width by height, in texels of the area asked for.
/// Errors: usage.
Result<Frame> frame_of_aspect(const PackOptions& options, double cell, double aspect);

}  // namespace wrapatlas
