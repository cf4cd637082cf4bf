// How exactly the numbers of a file are known, as far as they tell themselves.
#pragma once

namespace wrapatlas::validate {

/// Half a float's last bit, relative to the smallest number that has it.
inline constexpr double kFloatHalfUnit = 1.0 / (1 << 24);

/// Takes numbers one after another, and says whether all of them can be floats: in bits, or as a
/// text (the shortest that tells the float from its neighbours, or nine digits) that was read as a
/// double.
class Stored {
 public:
  /// False from the first number on that can be none. Of a magnitude below 1e30.
  bool as_floats(double value);

  /// By how much a number may differ from what was to be stored, relative to its size: by rounding
  /// to a float, and once more by the digits of the text.
  [[nodiscard]] double float_error() const;

 private:
  bool in_bits_ = true, shortest_ = true, nine_digits_ = true;
};

}  // namespace wrapatlas::validate
