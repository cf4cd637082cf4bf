#include "io/mtl.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "io/number.h"
#include "io/obj_lines.h"

namespace wrapatlas {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

namespace {

bool names_picture(std::string_view keyword) {
  const std::string key = lower(keyword);
  if (key == "map_aat") return false;  // a switch
  return key.starts_with("map_") || key == "bump" || key == "disp" || key == "decal" ||
         key == "norm" || key == "refl";
}

/// The words that follow an option: a fixed number, or up to three numbers.
struct Option {
  std::string_view name;
  int words = 0;
  bool numbers = false;  ///< as many numbers as there are, up to `words`
  bool places = false;   ///< says where the picture lies
};
constexpr std::array<Option, 12> kOptions{{{"-blendu", 1},
                                           {"-blendv", 1},
                                           {"-cc", 1},
                                           {"-clamp", 1, false, true},
                                           {"-mm", 2},
                                           {"-o", 3, true, true},
                                           {"-s", 3, true, true},
                                           {"-t", 3, true},
                                           {"-texres", 1},
                                           {"-bm", 1},
                                           {"-imfchan", 1},
                                           {"-type", 1}}};

const Option* option_named(std::string_view word) {
  const auto* found = std::find_if(kOptions.begin(), kOptions.end(),
                                   [&](const Option& option) { return option.name == word; });
  return found == kOptions.end() ? nullptr : found;
}

/// One statement's words after its keyword.
class Arguments {
 public:
  explicit Arguments(ObjWords words) : words_(words), word_(words_.next()) {}

  /// Calls visit(option, its words) for each, up to the picture's name.
  template <typename Visit>
  void for_each_option(Visit&& visit) {
    while (const Option* option = option_named(word_)) {
      std::vector<std::string_view> values;
      const std::string_view name = word_;
      word_ = words_.next();
      double number = 0;
      while (!word_.empty() && values.size() < static_cast<std::size_t>(option->words) &&
             (!option->numbers || parse_coordinate(word_, number))) {
        values.push_back(word_);
        word_ = words_.next();
      }
      visit(*option, name, values);
    }
  }

  /// All that is left: names may hold blanks.
  std::string_view picture() {
    const std::string_view first = word_;
    std::string_view last = first;
    for (; !word_.empty(); word_ = words_.next()) last = word_;
    return {first.data(), static_cast<std::size_t>(last.data() + last.size() - first.data())};
  }

 private:
  ObjWords words_;
  std::string_view word_;
};

/// `scale` and `offset` act on v from the bottom; places on textures count it from the top.
TransferSource source_of(Vec2 scale, Vec2 offset, bool clamp) {
  TransferSource source;
  source.across = source.down = clamp ? Repeat::clamp : Repeat::repeat;
  source.matrix = {scale.x, 0, offset.x, 0, scale.y, 1 - scale.y - offset.y};
  return source;
}

MtlMap map_of(std::string_view keyword, ObjWords words, std::string_view material) {
  Vec2 scale{1, 1}, offset;
  bool clamp = false;
  Arguments arguments(words);
  arguments.for_each_option(
      [&](const Option& option, std::string_view, const std::vector<std::string_view>& values) {
        Vec2* pair = option.name == "-s" ? &scale : option.name == "-o" ? &offset : nullptr;
        if (pair != nullptr && !values.empty()) parse_coordinate(values[0], pair->x);
        if (pair != nullptr && values.size() > 1) parse_coordinate(values[1], pair->y);
        if (option.name == "-clamp") clamp = !values.empty() && lower(values[0]) == "on";
      });
  MtlMap map;
  map.keyword = keyword;
  map.picture = arguments.picture();
  const char* after = keyword.data() + keyword.size();
  map.options = {after, static_cast<std::size_t>(map.picture.data() - after)};
  map.material = material;
  map.source = source_of(scale, offset, clamp);
  map.follows_uvs = lower(keyword) != "refl";
  return map;
}

/// Options that do not say where the picture lies, each after a blank, and a blank.
std::string kept_options(std::string_view options) {
  std::string kept = " ";
  Arguments arguments{ObjWords(options)};
  arguments.for_each_option([&](const Option& option, std::string_view name,
                                const std::vector<std::string_view>& values) {
    if (option.places) return;
    kept += name;
    for (const std::string_view value : values) (kept += ' ') += value;
    kept += ' ';
  });
  return kept;
}

/// Calls visit(material, keyword, words after it) for each statement of a material.
template <typename Visit>
void for_each_statement(std::string_view bytes, Visit&& visit) {
  std::string_view material;
  bool in_material = false;
  ObjLines lines(bytes);
  for (ObjLine line; lines.next(line);) {
    ObjWords words(line.text);
    const std::string_view keyword = words.next();
    if (keyword == "newmtl") {
      material = Arguments(words).picture();
      in_material = true;
    } else if (in_material) {
      visit(material, keyword, words);
    }
  }
}

}  // namespace

std::vector<MtlMap> read_mtl_maps(std::string_view bytes) {
  std::vector<MtlMap> maps;
  for_each_statement(
      bytes, [&](std::string_view material, std::string_view keyword, const ObjWords& words) {
        if (!names_picture(keyword)) return;
        MtlMap map = map_of(keyword, words, material);
        if (!map.picture.empty()) maps.push_back(map);
      });
  return maps;
}

std::map<std::string_view, std::array<float, 3>> read_mtl_colors(std::string_view bytes) {
  std::map<std::string_view, std::array<float, 3>> colors;
  for_each_statement(bytes,
                     [&](std::string_view material, std::string_view keyword, ObjWords words) {
                       if (lower(keyword) != "kd") return;
                       std::array<float, 3> color{};
                       for (float& value : color) {
                         double number = 0;
                         if (!parse_coordinate(words.next(), number)) return;
                         value = static_cast<float>(std::clamp(number, 0.0, 1.0));
                       }
                       colors[material] = color;
                     });
  for (const MtlMap& map : read_mtl_maps(bytes)) {
    if (lower(map.keyword) == "map_kd") colors.erase(map.material);
  }
  return colors;
}

std::string replace_mtl_pictures(std::string_view bytes,
                                 const std::map<std::size_t, std::string>& pictures,
                                 const std::set<std::size_t>& whole) {
  const std::vector<MtlMap> maps = read_mtl_maps(bytes);
  std::string result;
  const char* copied = bytes.data();
  for (const auto& [number, name] : pictures) {
    const MtlMap& map = maps[number];
    result.append(copied, map.options.data());
    result += whole.count(number) != 0 ? kept_options(map.options) : std::string(map.options);
    result += name;
    copied = map.picture.data() + map.picture.size();
  }
  result.append(copied, bytes.data() + bytes.size());
  return result;
}

}  // namespace wrapatlas
