// The options of pack and unwrap, as Python sets them.
#pragma once

#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/unwrap.h"

namespace wrapatlas::python {

struct PackSettings {
  PackOptions options;
  double density = 0;  ///< texels per unit of surface; 0: the largest scale that fits
  Stacked stacked = Stacked::separate;
  bool cut = false;   ///< faces at the border of the atlas
  bool check = true;  ///< the result exactly, before it is handed out
};

struct UnwrapSettings {
  UnwrapOptions options;
  bool split_materials = false;
};

}  // namespace wrapatlas::python
