// A packed mesh: all that Python may ask about it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bind.h"
#include "pack_settings.h"
#include "vertices.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::python {

/// Says how far it has come: stage, share, and the best efficiency or the number of charts. false:
/// stop.
using Tell = std::function<bool(const char*, double, double)>;

struct Packed {
  PyMesh source;
  std::optional<Unwrapping> unwrapping;  ///< of unwrap(); its mesh has the charts
  PackSettings settings;
  ChartSet charts;
  double uv_density = 0;
  Packing packing;
  AtlasMesh atlas;
  Vertices vertices;
  CheckReport report;  ///< empty if settings.check is off

  /// With the UVs that the charts were made from.
  [[nodiscard]] const Mesh& mesh() const { return unwrapping ? unwrapping->mesh : source.mesh(); }
};

/// As Python holds it. No one changes it once it is made.
struct PackedMesh {
  std::shared_ptr<const Packed> data;
  const Packed* operator->() const { return data.get(); }
};

/// Charts, packing, new UVs, their check. Needs no lock of the interpreter.
Result<PackedMesh> make_packed(const PyMesh& mesh, std::optional<Unwrapping> unwrapping,
                               const PackSettings& settings, const Tell& tell);

}  // namespace wrapatlas::python
