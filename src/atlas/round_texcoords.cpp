#include "wrapatlas/atlas.h"

namespace wrapatlas {

void round_texcoords_to_float(AtlasMesh& atlas) {
  // One axis after the other: g++ 12 takes both roundings of a pair of doubles for no change at all
  // (-O2 or -O3, its basic-block vectorizer).
  for (Vec2& uv : atlas.texcoords) uv.x = static_cast<double>(static_cast<float>(uv.x));
  for (Vec2& uv : atlas.texcoords) uv.y = static_cast<double>(static_cast<float>(uv.y));
}

}  // namespace wrapatlas
