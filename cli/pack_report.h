// What `wrapatlas pack` says about its work: JSON, a summary, notes.
#pragma once

#include <functional>

#include "common.h"
#include "pack_options.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/model.h"
#include "wrapatlas/pack.h"

namespace wrapatlas::cli {

/// What the stages took, and what the check said.
struct PackOutcome {
  double read = 0, charts = 0, pack = 0, validate = 0, write = 0, total = 0;  ///< seconds
  bool valid = true;
  double uv_density = 0;  ///< UV units per unit of surface; 0: unknown
  std::vector<double> page_efficiency;
  std::string command = "pack";
  Json more = Json::object();  ///< what the command has to add to the report
  std::vector<std::pair<std::string, double>> stages;  ///< seconds of work before the packing
  /// Writes what the command has besides model, picture and report; may be empty.
  std::function<Status(const Mesh&, const AtlasMesh&, const ChartSet&, const Packing&)> write_more;
};

/// Per page the areas of its charts over its own.
std::vector<double> page_efficiencies(const ChartSet& charts, const Packing& packing);

Json pack_json(const PackArguments& arguments, const ChartSet& charts, const Packing& packing,
               const PackOutcome& outcome);

void print_pack_summary(const PackArguments& arguments, const ChartSet& charts,
                        const Packing& packing, const PackOutcome& outcome);

/// Notes on the input, before the work begins.
void print_pack_notes(const PackArguments& arguments, const Model& model, const ChartSet& charts);

}  // namespace wrapatlas::cli
