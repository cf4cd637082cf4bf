#include "pack/aspects.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

struct Size {
  int width = 0, height = 0;
};

/// 0, 1, -1, 2, -2, ...: a search cut short has tried what is likely to be good.
int outwards(int i) { return i % 2 == 1 ? (i + 1) / 2 : -i / 2; }

double mean_side(const PackOptions& options) {
  return std::sqrt(double(options.width) * options.height);
}

/// Texels that the sides of a shape that is searched for are multiples of. Textures whose sides are
/// whole cells pack best; a cell of whole texels makes both whole.
double unit_of(const PackOptions& options, double cell) {
  const double block = options.block;
  return std::max(block, std::round(cell / block) * block);
}

/// `aspect`: the root of width by height.
Size size_of_aspect(double side, double unit, double root_aspect) {
  const auto texels = [&](double length) {
    return static_cast<int>(std::max(1.0, std::round(length / unit)) * unit);
  };
  return {texels(side * root_aspect), texels(side / root_aspect)};
}

/// Noell & Stricker 2011, section 3: 31 ratios, w = round(n 2^(k/10)), h = round(n 2^(-k/10)), k
/// from -15 to 15, in whole cells.
std::vector<Size> paper_sizes(double side, double unit) {
  std::vector<Size> sizes;
  for (int i = 0; i < 31; ++i) {
    sizes.push_back(size_of_aspect(side, unit, std::exp2(outwards(i) / 10.0)));
  }
  return sizes;
}

/// Sides 2^a x 2^b with a + b as near as can be to the area asked for, |a - b| <= 4.
std::vector<Size> pow2_sizes(double side) {
  const int sum = std::max(0, static_cast<int>(std::lround(2 * std::log2(side))));
  std::vector<Size> sizes;
  for (int i = 0; i < 9; ++i) {
    const int difference = outwards(i);
    const int across = sum + difference;
    if (across % 2 != 0 || across < 0 || sum - difference < 0) continue;
    sizes.push_back({1 << (across / 2), 1 << ((sum - difference) / 2)});
  }
  return sizes;
}

/// Those on which the margin leaves room for a cell; if there is none, all.
std::vector<Size> with_room(const std::vector<Size>& sizes, double cell,
                            const PackOptions& options) {
  const double inset = options.margin < 0 ? 0 : options.margin - options.padding / 2;
  const double least = 2 * inset + cell + (options.block > 1 ? options.block : 0);
  std::vector<Size> kept;
  for (const Size& size : sizes) {
    if (!wraps_u(options.wrap) && size.width < least) continue;
    if (!wraps_v(options.wrap) && size.height < least) continue;
    kept.push_back(size);
  }
  return kept.empty() ? sizes : kept;
}

}  // namespace

Result<std::vector<Frame>> make_frames(const PackOptions& options, double cell) {
  const double side = mean_side(options), unit = unit_of(options, cell);
  std::vector<Size> sizes{{options.width, options.height}};
  if (options.aspect == Aspect::search) sizes = paper_sizes(side, unit);
  if (options.aspect == Aspect::pow2) sizes = pow2_sizes(side);
  if (options.aspect == Aspect::search && cell >= 1) cell = unit;
  std::vector<Frame> frames;
  for (const Size& size : with_room(sizes, cell, options)) {
    auto frame = make_frame(size.width, size.height, cell, options);
    if (!frame) return frame.error();
    frames.push_back(*frame);
  }
  return frames;
}

std::vector<Frame> without_mirrored(const std::vector<Frame>& frames, Wrap wrap,
                                    const std::optional<Packing>& begun) {
  if (wraps_u(wrap) != wraps_v(wrap)) return frames;
  std::vector<Frame> kept;
  for (const Frame& frame : frames) {
    const auto mirrored = std::find_if(kept.begin(), kept.end(), [&](const Frame& other) {
      return other.texture_width == frame.texture_height &&
             other.texture_height == frame.texture_width;
    });
    if (mirrored == kept.end()) {
      kept.push_back(frame);
    } else if (begun && begun->width == frame.texture_width &&
               begun->height == frame.texture_height) {
      *mirrored = frame;
    }
  }
  return kept;
}

Result<Frame> frame_of_aspect(const PackOptions& options, double cell, double aspect) {
  const double unit = unit_of(options, cell);
  const Size size = size_of_aspect(mean_side(options), unit, std::sqrt(aspect));
  return make_frame(size.width, size.height, cell >= 1 ? unit : cell, options);
}

}  // namespace wrapatlas
