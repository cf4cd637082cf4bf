// Options that Python sets by name: each checks its value when it is set.
#pragma once

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>
#include <type_traits>

#include "failures.h"
#include "names.h"

namespace wrapatlas::python {

/// Both ends belong to it.
struct Range {
  double low = 0, high = 0;
  const char* unit = "";  ///< for the error: "texels"
};

/// A finite number in the range, or raises.
double number_from(const char* name, nb::handle value, Range range, bool whole);

/// "repr(value)", for errors.
std::string shown(nb::handle value);

/// A property that is a number. `member`: from the options to a reference to it.
template <typename Options, typename Member>
void add_number(nb::class_<Options>& options, const char* name, Member member, Range range) {
  using T = std::remove_reference_t<decltype(member(std::declval<Options&>()))>;
  options.def_prop_rw(
      name, [member](Options& o) { return member(o); },
      [member, name, range](Options& o, nb::handle value) {
        member(o) = static_cast<T>(number_from(name, value, range, std::is_integral_v<T>));
      },
      nb::for_setter(nb::arg("value").none()));
}

/// A property that is one of the names in a table.
template <typename Options, typename E, std::size_t N, typename Member>
void add_choice(nb::class_<Options>& options, const char* name, const Named<E> (&table)[N],
                Member member) {
  options.def_prop_rw(
      name, [member, &table](Options& o) { return std::string(name_of(table, member(o))); },
      [member, name, &table](Options& o, nb::handle value) {
        std::string text;
        if (nb::try_cast(value, text)) {
          if (const auto found = value_of(table, text)) {
            member(o) = *found;
            return;
          }
        }
        std::string names;
        for (std::size_t i = 0; i < N; ++i) {
          names += (i == 0 ? "" : i + 1 == N ? " or " : ", ") + std::string(table[i].name);
        }
        raise(usage(fmt::format("{}={}", name, shown(value)), "no such choice", "give " + names));
      },
      nb::for_setter(nb::arg("value").none()));
}

}  // namespace wrapatlas::python
