#include "wrapatlas/atlas.h"

namespace wrapatlas {
namespace {

/// By way of memory: at -O2 g++ 12 takes two doubles side by side that become floats and doubles
/// again for unchanged.
double rounded(double value) {
  const volatile float stored = static_cast<float>(value);
  return stored;
}

}  // namespace

void round_texcoords_to_float(AtlasMesh& atlas) {
  for (Vec2& uv : atlas.texcoords) uv = {rounded(uv.x), rounded(uv.y)};
}

}  // namespace wrapatlas
