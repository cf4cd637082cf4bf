// The header of a PLY file, and its body as a sequence of numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_words.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

enum class PlyEncoding { text, little, big };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline bool ply_is_float(PlyType type) { return type >= PlyType::float32; }
std::size_t ply_bytes(PlyType type);
std::string_view ply_name(PlyType type);
/// The smallest and the largest number of an integer type.
double ply_min(PlyType type);
double ply_max(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list
  std::string_view line;                ///< its line of the header, without line end
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  std::string_view line;

  /// Index of the property of this name, or -1.
  [[nodiscard]] int find(std::string_view property) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  std::size_t body = 0;       ///< offset of the first byte after the header
  std::size_t body_line = 1;  ///< number of its line
  std::string_view line_end;

  /// Index of the element of this name, or -1.
  [[nodiscard]] int find(std::string_view element) const;
};

/// The views in the header point into `bytes`. All element counts fit the bytes of the body.
Result<PlyHeader> read_ply_header(std::string_view bytes, std::string_view name);

/// Walks the body, number after number, in either encoding.
class PlyCursor {
 public:
  PlyCursor(std::string_view bytes, const PlyHeader& header);

  /// Reads a number. False at the end of the body, or if the text there is no number.
  bool read(PlyType type, double& value);
  /// Reads the length of a list, which fits the bytes that are left.
  bool read_length(const PlyProperty& list, std::size_t& length);
  /// Skips a whole property; `raw` is what it is written with, white space around it not included.
  bool skip(const PlyProperty& property, std::string_view& raw);

  /// Skips a whole element.
  bool skip(const PlyElement& element);
  /// Skips `count` numbers of a list whose length has been read.
  bool skip(PlyType type, std::size_t count);

  /// Offset in the file of what comes next; in text, of the white space before it.
  [[nodiscard]] std::size_t here() const { return is_text() ? start_ + words_.position() : at_; }
  void go_to(std::size_t offset);
  /// Line of the file, if it is text.
  [[nodiscard]] std::size_t line() const { return words_.line(); }

 private:
  [[nodiscard]] bool is_text() const { return encoding_ == PlyEncoding::text; }

  std::string_view bytes_;
  PlyEncoding encoding_;
  std::size_t at_;     // binary: of the next byte
  std::size_t start_;  // text: where words_ begin
  TextWords words_;
};

/// Appends a number as `type`, rounded and clamped if that is an integer type. In text, numbers of
/// both float types have all the digits of a double.
void append_ply(std::string& out, PlyEncoding encoding, PlyType type, double value);

}  // namespace wrapatlas
