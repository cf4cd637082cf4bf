// The shapes of texture that a packer tries.
#pragma once

#include <vector>

#include "pack/frame.h"

namespace wrapatlas {

/// A grid on every shape that options.aspect asks for, its cells about `cell` texels long, the
/// most square shapes first. Errors: usage.
Result<std::vector<Frame>> make_frames(const PackOptions& options, double cell);

}  // namespace wrapatlas
