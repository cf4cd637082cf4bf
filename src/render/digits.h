// Digits drawn as strokes: the only text of the pictures.
#pragma once

#include <string_view>
#include <vector>

#include "render/coverage.h"

namespace wrapatlas {

/// Width of a number of `count` digits, in its height.
double number_width(std::size_t count);

/// The centre lines of the digits of `number` ('0'-'9' only), `height` pixels high, around
/// `centre`; y points down.
std::vector<Segment> number_lines(std::string_view number, Vec2 centre, double height);

}  // namespace wrapatlas
