// A report in the making: counts every violation, describes the first ones in words.
#pragma once

#include <string>

#include "wrapatlas/validate.h"

namespace wrapatlas::validate {

class Findings {
 public:
  Findings(CheckReport& report, std::size_t most) : report_(report), most_(most) {}

  /// Counts the finding; keeps it, with its text, while there are fewer than the most.
  void add(Finding finding);
  /// At most as many remarks of one kind as findings; `rest` then says how many were left out.
  void remark(std::size_t number_of_kind, std::string text);
  void remark_rest(std::size_t number_of_kind, const std::string& what);

 private:
  CheckReport& report_;
  std::size_t most_;
};

}  // namespace wrapatlas::validate
