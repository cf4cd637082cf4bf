// What an evaluation measures: packers, and the setting that is common to all of them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "wrapatlas/pack.h"
#include "wrapatlas/unwrap.h"

namespace wrapatlas {

using Json = nlohmann::ordered_json;

/// A packer that takes part.
struct Contender {
  std::string name;  ///< in tables: the method's, for guided with its seconds
  Method method = Method::modulo;
  Wrap wrap = Wrap::none;
  double time = 0;  ///< guided: seconds
};

struct Setting {
  std::vector<Contender> contenders;
  PackOptions pack;         ///< of all; method, wrap and time are the contender's
  bool all_shapes = false;  ///< the 31 aspect ratios beside the size of `pack`
  UnwrapOptions unwrap;     ///< of meshes without UVs
  bool unwrap_all = false;  ///< of those with UVs too
};

/// All of it that a result depends on: two settings are one if this is equal.
Json setting_json(const Setting& setting);

/// The part of it by which charts are made.
std::string unwrap_key(const Setting& setting);

}  // namespace wrapatlas
