// The options of `wrapatlas pack`: what they are, and what they come to.
#pragma once

#include <optional>
#include <string>

#include "options.h"
#include "output_paths.h"
#include "pack/request.h"
#include "wrapatlas/picture.h"

namespace wrapatlas::cli {

enum class Export { continuous, cut };
inline constexpr Named<Export> kExports[] = {{"continuous", Export::continuous},
                                             {"cut", Export::cut}};

struct PackArguments {
  std::string input, output, aspect, json, image;
  Resolution resolution;
  std::optional<Wrap> wrap;
  std::optional<double> padding, margin;
  std::optional<double> density;  ///< texels per unit of surface
  std::optional<int> pages;
  bool udim = false;
  Export export_mode = Export::continuous;
  Stacked stacked = Stacked::separate;
  int texcoord = 0;
  bool quiet = false, verbose = false, no_inner = false;
  PictureOptions picture;
  bool draws_atlas = false;              ///< the command has a picture of it beside --image
  std::vector<OutputPath> more_outputs;  ///< that the command adds to -o, --image and --json
  std::vector<std::string> notes;        ///< on the options, for the user
  PackOptions options;  ///< complete after resolve_pack_options, but for the density

  /// Texels to sides that do not wrap, as asked or by default.
  [[nodiscard]] double margin_in_force() const { return wrapatlas::margin_in_force(options); }
};

/// For --help.
inline constexpr const char* kPackExitStatus =
    "Exit status: 0 written; 2 usage; 3 unusable input or output; 4 no packing found;\n"
    "130 interrupted: the best packing so far was written, if there was one;\n"
    "1 the result failed its own check, and nothing was written.\n";

/// How charts are tried: angles, grid and what single methods have.
void add_method_options(CLI::App& app, PackOptions& options, bool& no_inner);

/// Those that none of the methods reads.
std::vector<Ignored> options_of_other_methods(std::span<const Method> methods);

/// Those that matter only where charts are packed.
std::vector<Ignored> packing_options(const CLI::App& app, bool are_ignored, const std::string& why,
                                     const std::string& remedy);

/// All that do not depend on where the charts come from.
void add_pack_options(CLI::App& app, PackArguments& arguments, const char* input_help);

/// Fills arguments.options. Refuses what contradicts itself and what would be ignored.
Status resolve_pack_options(const CLI::App& app, PackArguments& arguments);

}  // namespace wrapatlas::cli
