// The page that shows what an evaluation came to.
#pragma once

#include <filesystem>

#include "wrapatlas/result.h"

namespace wrapatlas {

/// Reads the results that bench keeps in `results` and writes to the folder `out`: index.html,
/// which has all in it and loads nothing, and beside it the tables as Markdown and the plots as SVG
/// files. Errors: input (no results, or none of any mesh; a file they name is gone), output.
Status write_report(const std::filesystem::path& results, const std::filesystem::path& out);

}  // namespace wrapatlas
