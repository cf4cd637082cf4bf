// Material libraries of OBJ files: which pictures they name, and others in their place.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "wrapatlas/transfer.h"

namespace wrapatlas {

/// Keywords count in any case.
std::string lower(std::string_view text);

/// A statement that names a picture: "map_Kd -s 2 2 1 wood.png".
struct MtlMap {
  std::string_view keyword;   ///< all views are parts of the file's bytes: "map_Kd"
  std::string_view options;   ///< from the keyword's end to the picture's name
  std::string_view picture;   ///< the file's name, as it is written
  std::string_view material;  ///< of the newmtl before it
  TransferSource source;      ///< as the options say it is read; its texture is null
  bool follows_uvs = true;    ///< not so: refl, which is looked up by direction
};

/// In the order of the file, without what stands before the first newmtl.
std::vector<MtlMap> read_mtl_maps(std::string_view bytes);

/// Kd of the materials that have no map_Kd: beside one it is often left at any value.
std::map<std::string_view, std::array<float, 3>> read_mtl_colors(std::string_view bytes);

/// The same file with other pictures' names: those of `pictures`, by the number of their map. Of
/// the numbers in `whole` the picture is all that is read: options that move, scale or clamp go.
std::string replace_mtl_pictures(std::string_view bytes,
                                 const std::map<std::size_t, std::string>& pictures,
                                 const std::set<std::size_t>& whole);

}  // namespace wrapatlas
