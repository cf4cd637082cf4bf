// The colours of the pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace wrapatlas {

using Rgb = std::array<std::uint8_t, 3>;

inline constexpr Rgb kGround{24, 26, 30};
inline constexpr Rgb kFrame{236, 238, 242};
inline constexpr Rgb kFaintFrame{112, 117, 126};

/// What one chart is drawn with. `hatch_light` and `hatch_dark` are the two stripes of its parts
/// beyond the border.
struct ChartColors {
  Rgb fill, line, text, hatch_light, hatch_dark;
};

/// Colours of chart `number`: neighbours in number differ strongly, in hue and in lightness.
ChartColors chart_colors(std::size_t number);

/// OKLCH (lightness 0-1, chroma, hue in turns) as sRGB; chroma is lowered until it can be shown.
Rgb from_oklch(double lightness, double chroma, double hue_turns);

/// "#1a2b3c"
std::string css(Rgb color);

/// (1 - share) * a + share * b.
Rgb mix(Rgb a, Rgb b, double share);

}  // namespace wrapatlas
