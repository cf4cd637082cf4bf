#include "io/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

constexpr std::size_t kDeepest = 200;       // destructors and dump() recurse
constexpr std::size_t kMostMembers = 4096;  // ordered_json looks members up one by one
constexpr const char* kDirectories[] = {"buffers",  "bufferViews", "accessors", "meshes",
                                        "textures", "samplers",    "materials"};

std::size_t line_of(std::string_view text, std::size_t offset) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

Error json_error(std::string_view name, std::size_t line, std::string what) {
  return {ErrorKind::input, fmt::format("{}:{}", name, line), std::move(what),
          "export the model again"};
}

/// Nesting and members are counted before the parser sees the text: what it builds is then safe
/// to destroy and was cheap to make.
Status check_shape(std::string_view text, std::string_view name) {
  std::vector<std::size_t> members{0};
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      members.push_back(0);
      if (members.size() > kDeepest) {
        return json_error(name, line_of(text, i), "its JSON is nested too deeply");
      }
    } else if (c == '}' || c == ']') {
      if (members.size() > 1) members.pop_back();
    } else if (c == ':') {
      if (++members.back() > kMostMembers) {
        return json_error(name, line_of(text, i), "an object in its JSON has too many members");
      }
    }
  }
  return Done{};
}

}  // namespace

Error GltfFile::error(std::string_view place, std::string what, std::string remedy) const {
  return {ErrorKind::input, place.empty() ? name : fmt::format("{}: {}", name, place),
          std::move(what), std::move(remedy)};
}

Result<Json> parse_gltf_json(std::string_view text, std::string_view name) {
  if (Status shape = check_shape(text, name); !shape) return shape.error();
  Json json;
  try {
    json = Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    return json_error(name, line_of(text, error.byte), "it is not valid JSON");
  } catch (const Json::exception&) {  // a number beyond double
    return json_error(name, 1, "its JSON holds a number out of range");
  }
  if (!json.is_object()) return json_error(name, 1, "its JSON is not an object");
  for (const char* directory : kDirectories) {
    const Json* found = find_member(json, directory);
    if (found == nullptr) continue;
    const bool objects =
        found->is_array() &&
        std::all_of(found->begin(), found->end(), [](const Json& j) { return j.is_object(); });
    if (!objects) {
      return Error{ErrorKind::input, std::string(name),
                   fmt::format("\"{}\" is not an array of objects", directory),
                   "export the model again"};
    }
  }
  return json;
}

const Json* find_member(const Json& value, const char* key) {
  if (!value.is_object()) return nullptr;
  const auto found = value.find(key);
  return found == value.end() ? nullptr : &*found;
}

const Json& array_member(const Json& value, const char* key) {
  static const Json empty = Json::array();
  const Json* found = find_member(value, key);
  return found != nullptr && found->is_array() ? *found : empty;
}

std::optional<std::uint64_t> as_integer(const Json& value) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  if (value.is_number_integer()) {  // read: negative; made by our code: any
    const auto number = value.get<std::int64_t>();
    return number < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(number));
  }
  if (!value.is_number_float()) return std::nullopt;
  const double number = value.get<double>();
  if (!(number >= 0 && number <= kExact) || std::floor(number) != number) return std::nullopt;
  return static_cast<std::uint64_t>(number);
}

std::optional<std::uint64_t> integer_member(const Json& value, const char* key,
                                            std::uint64_t otherwise) {
  const Json* found = find_member(value, key);
  return found == nullptr ? std::optional(otherwise) : as_integer(*found);
}

}  // namespace wrapatlas
