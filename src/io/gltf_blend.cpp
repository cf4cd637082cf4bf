#include "io/gltf_blend.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace wrapatlas {
namespace {

enum class Rule { sum, position, unit, unit_with_sign, nearest };

/// Identifiers are not numbers to compute with, whatever their type.
Rule rule_for(const GltfAccessor& accessor, const std::string& semantic, bool is_target) {
  const bool is_float = accessor.component == GltfComponent::f32;
  if (accessor.matrix && !is_float) return Rule::nearest;
  if (is_target) return Rule::sum;
  if (semantic == "POSITION") return Rule::position;
  if (semantic == "NORMAL" && accessor.components == 3) return Rule::unit;
  if (semantic == "TANGENT" && accessor.components == 4) return Rule::unit_with_sign;
  if (semantic.starts_with("TEXCOORD_") || semantic.starts_with("COLOR_")) return Rule::sum;
  if (semantic.starts_with("_FEATURE_ID") || semantic == "_BATCHID") return Rule::nearest;
  return is_float || accessor.normalized ? Rule::sum : Rule::nearest;
}

void normalize(std::array<double, 16>& values) {
  const double size =
      std::sqrt(values[0] * values[0] + values[1] * values[1] + values[2] * values[2]);
  if (!(size > 0)) return;
  for (std::size_t c = 0; c < 3; ++c) values[c] /= size;
}

void copy_element(const GltfAccessor& accessor, const GltfAccessor& format, std::size_t i,
                  char* out) {
  const char* element = accessor.element(i);
  if (format.component == accessor.component) {
    std::memcpy(out, element, accessor.element_size);
    return;
  }
  for (std::size_t c = 0; c < accessor.components; ++c) {
    format.store(out, c, accessor.value(element, c));
  }
}

void blend_element(const GltfAccessor& accessor, const GltfAccessor& format, Rule rule,
                   const GltfBlend& blend, char* out) {
  if (rule == Rule::nearest) {
    const auto heaviest = std::max_element(blend.weights.begin(), blend.weights.end());
    copy_element(accessor, format, blend.vertices[heaviest - blend.weights.begin()], out);
    return;
  }
  std::array<double, 16> values{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (blend.weights[k] == 0) continue;
    const char* element = accessor.element(blend.vertices[k]);
    for (std::size_t c = 0; c < accessor.components; ++c) {
      values[c] += blend.weights[k] * accessor.value(element, c);
    }
  }
  if (rule == Rule::position) values = {blend.position.x, blend.position.y, blend.position.z};
  if (rule == Rule::unit || rule == Rule::unit_with_sign) normalize(values);
  if (rule == Rule::unit_with_sign) {
    values[3] = accessor.value(accessor.element(blend.vertices[0]), 3);
  }
  for (std::size_t c = 0; c < accessor.components; ++c) format.store(out, c, values[c]);
}

struct Influence {
  double joint = 0, weight = 0;
};

std::vector<Influence> merged_influences(const std::vector<GltfSkinSet>& sets,
                                         const GltfBlend& blend) {
  std::vector<Influence> merged;
  for (std::size_t k = 0; k < 3; ++k) {
    if (blend.weights[k] == 0) continue;
    for (const GltfSkinSet& set : sets) {
      const char* joints = set.joints->element(blend.vertices[k]);
      const char* weights = set.weights->element(blend.vertices[k]);
      for (std::size_t c = 0; c < 4; ++c) {
        const double weight = blend.weights[k] * set.weights->value(weights, c);
        if (weight > 0) merged.push_back({set.joints->value(joints, c), weight});
      }
    }
  }
  std::stable_sort(merged.begin(), merged.end(),
                   [](const Influence& a, const Influence& b) { return a.joint < b.joint; });
  std::size_t count = 0;
  for (const Influence& influence : merged) {
    if (count != 0 && merged[count - 1].joint == influence.joint) {
      merged[count - 1].weight += influence.weight;
    } else {
      merged[count++] = influence;
    }
  }
  merged.resize(count);
  std::stable_sort(merged.begin(), merged.end(),
                   [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  merged.resize(std::min(merged.size(), 4 * sets.size()));
  double total = 0;
  for (const Influence& influence : merged) total += influence.weight;
  for (Influence& influence : merged) influence.weight /= total;
  return merged;
}

/// Integers must add up to exactly one: what rounding took or gave, the heaviest pays.
void round_weights(const GltfAccessor& accessor, std::vector<Influence>& influences) {
  if (accessor.component == GltfComponent::f32 || influences.empty()) return;
  const double one = component_one(accessor.component);
  double rest = 1;
  for (Influence& influence : influences) {
    influence.weight = std::nearbyint(influence.weight * one) / one;
    rest -= influence.weight;
  }
  influences.front().weight += rest;
  while (!influences.empty() && influences.back().weight == 0) influences.pop_back();
}

}  // namespace

std::size_t padded_stride(const GltfAccessor& accessor) {
  return (accessor.element_size + 3) / 4 * 4;
}

GltfAccessor extended_format(const GltfAccessor& accessor, const std::string& semantic,
                             const GltfExtraVertices& extra) {
  GltfAccessor format = accessor;
  format.count = format.sparse_count = 0;
  format.data = nullptr;
  const bool exact = semantic == "POSITION" || semantic.starts_with("TEXCOORD_");
  if (!exact || extra.blends.empty() || accessor.matrix) return format;
  format.component = GltfComponent::f32;
  format.normalized = false;
  format.element_size = accessor.components * component_size(format.component);
  return format;
}

std::string extended_attribute(const GltfAccessor& accessor, const GltfAccessor& format,
                               const std::string& semantic, bool is_target,
                               const GltfExtraVertices& extra) {
  const std::size_t stride = padded_stride(format);
  std::string bytes((accessor.count + extra.vertices.size()) * stride, '\0');
  char* out = bytes.data();
  for (std::size_t i = 0; i < accessor.count; ++i, out += stride) {
    copy_element(accessor, format, i, out);
  }
  const Rule rule = rule_for(accessor, semantic, is_target);
  for (const GltfExtraVertex& vertex : extra.vertices) {
    if (vertex.source != kNone) {
      copy_element(accessor, format, vertex.source, out);
    } else {
      blend_element(accessor, format, rule, extra.blends[vertex.blend], out);
    }
    out += stride;
  }
  return bytes;
}

void blend_skin(const std::vector<GltfSkinSet>& sets, const GltfExtraVertices& extra) {
  for (std::size_t i = 0; i < extra.vertices.size(); ++i) {
    if (extra.vertices[i].source != kNone) continue;
    std::vector<Influence> influences =
        merged_influences(sets, extra.blends[extra.vertices[i].blend]);
    if (influences.empty()) continue;  // not skinned here: the sum of nothing is right already
    round_weights(*sets.front().weights, influences);
    influences.resize(4 * sets.size());
    for (std::size_t s = 0; s < sets.size(); ++s) {
      const std::size_t vertex = sets[s].joints->count + i;
      char* joints = sets[s].joints_bytes->data() + vertex * padded_stride(*sets[s].joints);
      char* weights = sets[s].weights_bytes->data() + vertex * padded_stride(*sets[s].weights);
      for (std::size_t c = 0; c < 4; ++c) {
        sets[s].joints->store(joints, c, influences[4 * s + c].joint);
        sets[s].weights->store(weights, c, influences[4 * s + c].weight);
      }
    }
  }
}

}  // namespace wrapatlas
