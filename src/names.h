// The names of the options' values, as the command, its reports and Python write them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "wrapatlas/bake.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/unwrap.h"
#include "wrapatlas/validate.h"

namespace wrapatlas {

/// A value and how the command writes it.
template <typename E>
struct Named {
  const char* name;
  E value;
};
inline constexpr Named<Wrap> kWraps[] = {
    {"uv", Wrap::uv}, {"u", Wrap::u}, {"v", Wrap::v}, {"none", Wrap::none}};
inline constexpr Named<Method> kMethods[] = {{"guided", Method::guided},
                                             {"modulo", Method::modulo},
                                             {"swg03", Method::swg03},
                                             {"zsgs04", Method::zsgs04},
                                             {"lprm02", Method::lprm02}};
inline constexpr Named<Coverage> kCoverages[] = {{"conservative", Coverage::conservative},
                                                 {"center", Coverage::center}};
inline constexpr Named<RotationBase> kRotationBases[] = {{"input", RotationBase::input},
                                                         {"box", RotationBase::box}};
inline constexpr Named<Stacked> kStacked[] = {{"separate", Stacked::separate},
                                              {"keep", Stacked::keep}};
inline constexpr Named<StretchMeasure> kStretches[] = {{"l2", StretchMeasure::l2},
                                                       {"linf", StretchMeasure::linf}};
inline constexpr Named<FlattenMethod> kFlattenMethods[] = {{"labf", FlattenMethod::labf},
                                                           {"lscm", FlattenMethod::lscm}};
inline constexpr Named<BakedMap> kBakedMaps[] = {{"tangent", BakedMap::tangent_normals},
                                                 {"object", BakedMap::object_normals},
                                                 {"position", BakedMap::positions},
                                                 {"occlusion", BakedMap::occlusion},
                                                 {"color", BakedMap::color}};
inline constexpr Named<Violation> kViolations[] = {{"overlap", Violation::overlap},
                                                   {"gap", Violation::gap},
                                                   {"self_overlap", Violation::self_overlap},
                                                   {"bounds", Violation::bounds},
                                                   {"margin", Violation::margin},
                                                   {"missing_face", Violation::missing_face},
                                                   {"not_similar", Violation::not_similar},
                                                   {"mirrored", Violation::mirrored},
                                                   {"scale", Violation::scale}};

template <typename E, std::size_t N>
const char* name_of(const Named<E> (&table)[N], E value) {
  for (const Named<E>& row : table) {
    if (row.value == value) return row.name;
  }
  return "";
}
template <typename E, std::size_t N>
std::optional<E> value_of(const Named<E> (&table)[N], std::string_view name) {
  for (const Named<E>& row : table) {
    if (row.name == name) return row.value;
  }
  return std::nullopt;
}

}  // namespace wrapatlas
