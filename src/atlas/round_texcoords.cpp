#include "wrapatlas/atlas.h"

namespace wrapatlas {

void round_texcoords_to_float(AtlasMesh& atlas) {
  for (Vec2& uv : atlas.texcoords) {
    uv = {static_cast<double>(static_cast<float>(uv.x)),
          static_cast<double>(static_cast<float>(uv.y))};
  }
}

}  // namespace wrapatlas
