// The names of the packing options' values, as the command and its reports write them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "wrapatlas/pack.h"

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
