// What a user asks for, as options of pack(): the defaults, the shape of the atlas, which method
// reads what. The same for the command and for Python.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wrapatlas/pack.h"

namespace wrapatlas {

/// Texels between charts where none are asked for.
double default_padding(int width, int height);

/// Does the method know any Wrap but `none`?
bool can_wrap(Method method);

/// Options that belong to some methods only, by name without dashes in front.
struct MethodOption {
  const char* option;
  std::vector<Method> methods;
};
const std::vector<MethodOption>& method_options();

/// `text`: square, search, pow2 or W:H, at the area of the options' width and height, in whole
/// blocks. Error: usage; `name` stands before the text in it.
Status set_aspect(PackOptions& options, std::string_view text, std::string_view name);

/// Texels to sides that do not wrap, as asked or by default.
double margin_in_force(const PackOptions& options);

/// A packing error about a density in texels per UV unit, said in texels per unit of surface.
/// `option`: what to write before a density that would fit, as "--density ".
Error in_units_of_surface(Error error, double uv_density, std::string_view option);

}  // namespace wrapatlas
