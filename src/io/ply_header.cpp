#include "io/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/number.h"

namespace wrapatlas {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array<TypeName, 16> kTypeNames{{{"char", PlyType::int8},
                                               {"int8", PlyType::int8},
                                               {"uchar", PlyType::uint8},
                                               {"uint8", PlyType::uint8},
                                               {"short", PlyType::int16},
                                               {"int16", PlyType::int16},
                                               {"ushort", PlyType::uint16},
                                               {"uint16", PlyType::uint16},
                                               {"int", PlyType::int32},
                                               {"int32", PlyType::int32},
                                               {"uint", PlyType::uint32},
                                               {"uint32", PlyType::uint32},
                                               {"float", PlyType::float32},
                                               {"float32", PlyType::float32},
                                               {"double", PlyType::float64},
                                               {"float64", PlyType::float64}}};

bool parse_type(std::string_view name, PlyType& type) {
  for (const TypeName& known : kTypeNames) {
    if (known.name == name) {
      type = known.type;
      return true;
    }
  }
  return false;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  Result<PlyHeader> read() {
    bool has_format = false;
    for (std::size_t number = 1;; ++number) {
      std::string_view line;
      bool fine = take_line(line);
      TextWords words(line);
      const std::string_view keyword = words.next();
      if (number == 1) {
        fine = fine && keyword == "ply" ? true : fail("the file does not begin with 'ply'");
      } else if (!fine) {
        fail("the header does not end with 'end_header'");
      } else if (keyword == "format") {
        fine = has_format = read_format(words.next());
      } else if (keyword == "element") {
        fine = read_element(line, words);
      } else if (keyword == "property") {
        fine = read_property(line, words);
      } else if (keyword == "end_header") {
        header_.body = at_;
        header_.body_line = number + 1;
        fine = has_format ? check_counts() : fail("the header has no line 'format'");
        if (fine) return std::move(header_);
      } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
        fine = fail(fmt::format("'{}' is not a word of a header", keyword.substr(0, 40)));
      }
      if (!fine) {
        return Error{ErrorKind::input, fmt::format("{}:{}", name_, number), what_,
                     "export the mesh again"};
      }
    }
  }

 private:
  bool fail(std::string what) {
    what_ = std::move(what);
    return false;
  }

  bool take_line(std::string_view& line) {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos) return false;
    line = bytes_.substr(at_, end - at_);
    const bool has_return = !line.empty() && line.back() == '\r';
    if (has_return) line.remove_suffix(1);
    if (header_.line_end.empty()) header_.line_end = has_return ? "\r\n" : "\n";
    at_ = end + 1;
    return true;
  }

  bool read_format(std::string_view format) {
    if (format == "ascii") {
      header_.encoding = PlyEncoding::text;
    } else if (format == "binary_little_endian") {
      header_.encoding = PlyEncoding::little;
    } else if (format == "binary_big_endian") {
      header_.encoding = PlyEncoding::big;
    } else {
      return fail(fmt::format("the format '{}' is not known", format.substr(0, 40)));
    }
    return true;
  }

  bool read_element(std::string_view line, TextWords& words) {
    PlyElement element;
    element.name = words.next();
    element.line = line;
    std::int64_t count = 0;
    if (element.name.empty() || !parse_integer(words.next(), count) || count < 0) {
      return fail("an element needs a name and a count");
    }
    element.count = static_cast<std::uint64_t>(count);
    header_.elements.push_back(std::move(element));
    return true;
  }

  bool read_property(std::string_view line, TextWords& words) {
    if (header_.elements.empty()) return fail("a property stands before the first element");
    PlyProperty property;
    property.line = line;
    std::string_view type = words.next();
    property.is_list = type == "list";
    if (property.is_list) {
      const std::string_view count_type = words.next();
      if (!parse_type(count_type, property.count_type) || ply_is_float(property.count_type)) {
        return fail(
            fmt::format("'{}' is no type for the length of a list", count_type.substr(0, 40)));
      }
      type = words.next();
    }
    if (!parse_type(type, property.type)) {
      return fail(fmt::format("the type '{}' is not known", type.substr(0, 40)));
    }
    property.name = words.next();
    if (property.name.empty()) return fail("a property needs a name");
    header_.elements.back().properties.push_back(std::move(property));
    return true;
  }

  // Every record takes some bytes, so that a file cannot claim more records than it has bytes.
  bool check_counts() {
    std::uint64_t left = bytes_.size() - header_.body;
    if (header_.encoding == PlyEncoding::text) ++left;  // the last number needs nothing after it
    for (const PlyElement& element : header_.elements) {
      std::uint64_t least = 0;
      for (const PlyProperty& property : element.properties) {
        const PlyType first = property.is_list ? property.count_type : property.type;
        least += header_.encoding == PlyEncoding::text ? 2 : ply_bytes(first);
      }
      if (least == 0) continue;
      if (element.count > left / least) {
        return fail(fmt::format("there are fewer bytes than {} records of '{}' take", element.count,
                                element.name.substr(0, 40)));
      }
      left -= element.count * least;
    }
    return true;
  }

  std::string_view bytes_, name_;
  std::size_t at_ = 0;
  PlyHeader header_;
  std::string what_;
};

template <typename T>
int find_named(const std::vector<T>& items, std::string_view name) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

std::string_view ply_name(PlyType type) {
  return kTypeNames[2 * static_cast<std::size_t>(type)].name;
}

int PlyElement::find(std::string_view property) const { return find_named(properties, property); }
int PlyHeader::find(std::string_view element) const { return find_named(elements, element); }

Result<PlyHeader> read_ply_header(std::string_view bytes, std::string_view name) {
  return HeaderReader(bytes, name).read();
}

}  // namespace wrapatlas
