// Outputs that would be written over each other, or over what is read.
#pragma once

#include <span>
#include <string>

#include "wrapatlas/model.h"

namespace wrapatlas::cli {

/// A file to be written and the option that names it. "" and "-" are no files.
struct OutputPath {
  const char* option;
  std::string path;
};

/// Error: usage, if two outputs are one file.
Status refuse_equal_outputs(std::span<const OutputPath> outputs);

/// Error: usage, if an output is the file that `model` was read from, or one that it refers to.
Status refuse_overwriting(const std::string& input, const Model& model,
                          std::span<const OutputPath> outputs);

}  // namespace wrapatlas::cli
