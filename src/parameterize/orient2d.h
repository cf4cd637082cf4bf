#pragma once

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// On which side of the line from a to b is c: 1 on the left, -1 on the right, 0 on it. Exact for
/// coordinates that are 0 or of magnitude 1e-140 to 1e150.
int orient2d(Vec2 a, Vec2 b, Vec2 c);

}  // namespace wrapatlas
