#include "evaluate/setting.h"

#include <fmt/format.h>

#include "names.h"

namespace wrapatlas {

Json setting_json(const Setting& setting) {
  Json contenders = Json::array();
  for (const Contender& contender : setting.contenders) {
    Json one = {{"name", contender.name},
                {"method", name_of(kMethods, contender.method)},
                {"wrap", name_of(kWraps, contender.wrap)}};
    if (contender.method == Method::guided) one["time"] = contender.time;
    contenders.push_back(one);
  }
  const PackOptions& pack = setting.pack;
  return {{"contenders", contenders},
          {"width", pack.width},
          {"height", pack.height},
          {"aspect", setting.all_shapes ? "search" : "fixed"},
          {"padding", pack.padding},
          {"margin", pack.margin < 0 ? pack.padding / 2 : pack.margin},
          {"rotations", pack.rotations},
          {"rotation_base", name_of(kRotationBases, pack.rotation_base)},
          {"grid", pack.grid},
          {"coverage", name_of(kCoverages, pack.coverage)},
          {"scale_start", pack.start_upper},
          {"lambda", pack.lambda},
          {"inner", pack.inner},
          {"all_sides", pack.all_sides},
          {"seed", pack.seed},
          {"unwrap", unwrap_key(setting)}};
}

std::string unwrap_key(const Setting& setting) {
  return fmt::format("{}, {} stretch {}, {} {}",
                     setting.unwrap_all ? "all meshes" : "meshes without UVs",
                     setting.unwrap.stretch == StretchMeasure::l2 ? "L2" : "L-infinity",
                     setting.unwrap.max_stretch,
                     setting.unwrap.flatten.method == FlattenMethod::labf ? "labf" : "lscm",
                     setting.unwrap.flatten.iterations);
}

}  // namespace wrapatlas
