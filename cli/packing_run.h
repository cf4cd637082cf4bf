// From charts to files: what `pack` and `unwrap` have in common.
#pragma once

#include "pack_report.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::cli {

/// The error, with the input's name before the place in it.
Error inside_input(const PackArguments& arguments, Error error);

/// An atlas that we made ourselves fails the check.
Error broken_promise(const std::string& input, const CheckReport& report);

/// What can be known of the outputs before the work begins.
Status check_outputs(const PackArguments& arguments);

/// The model may take its own place; nothing else may.
Status keep_input(const PackArguments& arguments, const Model& model);

/// Packs the charts of `mesh`, checks the result, writes model, picture and report: all of them, or
/// none. `mesh` is the model's own, or that with other UVs, which replace the model's. `start` is
/// when the command began. Returns the exit status.
int pack_mesh(PackArguments& arguments, const Model& model, const Mesh& mesh, double start,
              PackOutcome& outcome);

}  // namespace wrapatlas::cli
