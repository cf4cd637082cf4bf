// Words of a text file with their line numbers, for the formats that are lists of words.
#pragma once

#include <cstddef>
#include <string_view>

namespace wrapatlas {

class TextWords {
 public:
  explicit TextWords(std::string_view text, std::size_t line = 1)
      : begin_(text.data()), at_(begin_), end_(begin_ + text.size()), line_(line) {}

  /// The next word; empty at the end of the text.
  std::string_view next() {
    skip_gap(false);
    return take();
  }
  /// The next word of this line; empty if there is none.
  std::string_view next_on_line() {
    skip_gap(true);
    return at_ != end_ && *at_ == '\n' ? std::string_view() : take();
  }
  void skip_line() {
    while (at_ != end_ && *at_ != '\n') ++at_;
  }
  /// From here on, '#' starts a comment.
  void allow_comments() { comments_ = true; }

  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] std::size_t position() const { return static_cast<std::size_t>(at_ - begin_); }
  [[nodiscard]] std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  void skip_gap(bool stop_at_newline) {
    while (at_ != end_) {
      if (comments_ && *at_ == '#') {
        skip_line();
        continue;
      }
      if (*at_ == '\n') {
        if (stop_at_newline) return;
        ++line_;
      } else if (!is_blank(*at_)) {
        return;
      }
      ++at_;
    }
  }
  std::string_view take() {
    const char* begin = at_;
    while (at_ != end_ && !is_blank(*at_) && !(comments_ && *at_ == '#')) ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
  }

  const char* begin_;
  const char* at_;
  const char* end_;
  std::size_t line_;
  bool comments_ = false;
};

}  // namespace wrapatlas
