#include "validate/findings.h"

#include <fmt/format.h>

namespace wrapatlas::validate {

void Findings::add(Finding finding) {
  ++report_.violations;
  if (report_.findings.size() < most_) report_.findings.push_back(std::move(finding));
}

void Findings::remark(std::size_t number_of_kind, std::string text) {
  if (number_of_kind < most_) report_.remarks.push_back(std::move(text));
}

void Findings::remark_rest(std::size_t number_of_kind, const std::string& what) {
  if (number_of_kind > most_) {
    report_.remarks.push_back(fmt::format("and {} more {}", number_of_kind - most_, what));
  }
}

}  // namespace wrapatlas::validate
