#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "io/number.h"
#include "io/ply_header.h"

namespace wrapatlas {
namespace {

template <typename T>
double as_number(std::uint64_t bits) {
  return static_cast<double>(static_cast<T>(bits));
}

double decode(PlyType type, std::uint64_t bits) {
  switch (type) {
    case PlyType::int8:
      return as_number<std::int8_t>(bits);
    case PlyType::uint8:
      return as_number<std::uint8_t>(bits);
    case PlyType::int16:
      return as_number<std::int16_t>(bits);
    case PlyType::uint16:
      return as_number<std::uint16_t>(bits);
    case PlyType::int32:
      return as_number<std::int32_t>(bits);
    case PlyType::uint32:
      return as_number<std::uint32_t>(bits);
    case PlyType::float32:
      return double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
    case PlyType::float64:
      break;
  }
  return std::bit_cast<double>(bits);
}

// To the nearest float, without the undefined overflow of a cast.
float to_float(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::isfinite(value) ? std::clamp(value, -kLargest, kLargest) : value);
}

double to_whole(PlyType type, double value) {
  if (std::isnan(value)) return 0;
  return std::clamp(std::round(value), ply_min(type), ply_max(type));
}

std::uint64_t encode(PlyType type, double value) {
  if (type == PlyType::float64) return std::bit_cast<std::uint64_t>(value);
  if (type == PlyType::float32) return std::bit_cast<std::uint32_t>(to_float(value));
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(to_whole(type, value)));
}

}  // namespace

std::size_t ply_bytes(PlyType type) {
  constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

double ply_min(PlyType type) {
  constexpr std::array<double, 6> kMin{-128, 0, -32768, 0, -2147483648.0, 0};
  return kMin[static_cast<std::size_t>(type)];
}

double ply_max(PlyType type) {
  constexpr std::array<double, 6> kMax{127, 255, 32767, 65535, 2147483647, 4294967295};
  return kMax[static_cast<std::size_t>(type)];
}

PlyCursor::PlyCursor(std::string_view bytes, const PlyHeader& header)
    : bytes_(bytes),
      encoding_(header.encoding),
      at_(header.body),
      start_(header.body),
      words_(bytes.substr(header.body), header.body_line) {}

void PlyCursor::go_to(std::size_t offset) {
  at_ = start_ = offset;
  words_ = TextWords(bytes_.substr(offset));
}

bool PlyCursor::read(PlyType type, double& value) {
  if (is_text()) return parse_number(words_.next(), value);
  const std::size_t size = ply_bytes(type);
  if (bytes_.size() - at_ < size) return false;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t k = encoding_ == PlyEncoding::little ? size - 1 - i : i;
    bits = bits << 8U | static_cast<unsigned char>(bytes_[at_ + k]);
  }
  at_ += size;
  value = decode(type, bits);
  return true;
}

bool PlyCursor::read_length(const PlyProperty& list, std::size_t& length) {
  double value = 0;
  if (!read(list.count_type, value) || !(value >= 0) || value != std::floor(value)) return false;
  const std::size_t left = is_text() ? words_.bytes_left() : bytes_.size() - at_;
  const std::size_t each = is_text() ? 2 : ply_bytes(list.type);
  const std::size_t most = left / each;
  if (value > static_cast<double>(most)) return false;
  length = static_cast<std::size_t>(value);
  return true;
}

bool PlyCursor::skip(PlyType type, std::size_t count) {
  if (!is_text()) {
    if ((bytes_.size() - at_) / ply_bytes(type) < count) return false;
    at_ += count * ply_bytes(type);
    return true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (words_.next().empty()) return false;
  }
  return true;
}

bool PlyCursor::skip(const PlyProperty& property, std::string_view& raw) {
  const std::size_t begin = here();
  std::size_t length = 1;
  if (property.is_list && !read_length(property, length)) return false;
  if (!skip(property.type, length)) return false;
  raw = bytes_.substr(begin, here() - begin);
  const std::size_t word = is_text() ? raw.find_first_not_of(" \t\n\v\f\r") : 0;
  raw.remove_prefix(std::min(word, raw.size()));
  return true;
}

bool PlyCursor::skip(const PlyElement& element) {
  if (element.properties.empty()) return true;
  std::string_view raw;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      if (!skip(property, raw)) return false;
    }
  }
  return true;
}

void append_ply(std::string& out, PlyEncoding encoding, PlyType type, double value) {
  if (encoding == PlyEncoding::text) {
    if (ply_is_float(type)) {
      append_number(out, value);
    } else {
      append_integer(out, static_cast<std::int64_t>(to_whole(type, value)));
    }
    return;
  }
  const std::uint64_t bits = encode(type, value);
  const std::size_t size = ply_bytes(type);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t k = encoding == PlyEncoding::little ? i : size - 1 - i;
    out += static_cast<char>(bits >> (8 * k) & 0xffU);
  }
}

}  // namespace wrapatlas
