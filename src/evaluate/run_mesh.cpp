#include "evaluate/run_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "wrapatlas/atlas.h"
#include "wrapatlas/model.h"
#include "wrapatlas/validate.h"

namespace wrapatlas {
namespace {

class MeshRuns {
 public:
  MeshRuns(const MeshCharts& mesh, const Setting& setting, const std::function<bool()>& stop)
      : mesh_(mesh), setting_(setting), stop_(stop) {}

  Result<std::vector<Run>> all() {
    for (const Contender& contender : setting_.contenders) {
      const Status ok =
          contender.method == Method::guided ? run_guided(contender) : run_shapes(contender);
      if (!ok) return ok.error();
    }
    return std::move(runs_);
  }

 private:
  [[nodiscard]] PackOptions options_of(const Contender& contender) const {
    PackOptions options = setting_.pack;
    options.method = contender.method;
    options.wrap = contender.wrap;
    options.time = contender.time;
    options.threads = 1;
    options.progress = [this](const Progress&) { return !stop_(); };
    return options;
  }

  /// Each shape is a run of its own.
  Status run_shapes(const Contender& contender) {
    PackOptions options = options_of(contender);
    options.aspect = setting_.all_shapes ? Aspect::search : Aspect::fixed;
    auto packings = pack_each_shape(mesh_.charts.charts, options);
    if (!packings) return failed(contender, packings.error(), false);
    std::size_t densest = 0;
    for (std::size_t i = 0; i < packings->size(); ++i) {
      if ((*packings)[i].interrupted) return interrupted();
      if ((*packings)[i].efficiency > (*packings)[densest].efficiency) densest = i;
    }
    for (std::size_t i = 0; i < packings->size(); ++i) {
      Packing& packing = (*packings)[i];
      const double seconds = packing.raster_seconds + packing.place_seconds;
      add(contender, std::move(packing), seconds, false, i == 0 || i == densest);
    }
    return Done{};
  }

  /// Its shapes share one search: the given size, and a search that looks for the best one.
  Status run_guided(const Contender& contender) {
    for (const bool search : {false, true}) {
      if (search && !setting_.all_shapes) break;
      PackOptions options = options_of(contender);
      options.aspect = search ? Aspect::search : Aspect::fixed;
      options.coverage =
          Coverage::conservative;  // its promise is exact, also in the paper's setting
      const auto start = std::chrono::steady_clock::now();
      auto packing = pack(mesh_.charts.charts, options);
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      if (!packing) {
        if (const Status ok = failed(contender, packing.error(), search); !ok) return ok;
        continue;
      }
      if (packing->interrupted) return interrupted();
      add(contender, std::move(*packing), seconds.count(), search, true);
    }
    return Done{};
  }

  static Error interrupted() { return {ErrorKind::interrupted, "", "stopped", ""}; }

  /// A row that says what went wrong; an error only if it was the user who ended it.
  Status failed(const Contender& contender, const Error& error, bool searched_shape) {
    if (error.kind == ErrorKind::interrupted) return error;
    Run run;
    run.contender = contender.name;
    run.searched_shape = searched_shape;
    run.packing.width = setting_.pack.width;
    run.packing.height = setting_.pack.height;
    run.error = error.message();
    runs_.push_back(std::move(run));
    return Done{};
  }

  void add(const Contender& contender, Packing packing, double seconds, bool searched_shape,
           bool keep_placements) {
    Run run;
    run.contender = contender.name;
    run.searched_shape = searched_shape;
    run.seconds = seconds;
    if (packing.placements.empty()) {
      run.error = fmt::format("no scale was found at which {} charts fit", mesh_.facts.charts);
    } else {
      const bool may_overlap =
          setting_.pack.coverage == Coverage::center && contender.method != Method::guided;
      check(packing, may_overlap, run);
    }
    if (!keep_placements) packing.placements.clear();
    run.packing = std::move(packing);
    runs_.push_back(std::move(run));
  }

  /// Coverage by cell centres lets charts overlap by part of a cell: that is counted, not an error.
  void check(const Packing& packing, bool may_overlap, Run& run) const {
    AtlasMesh atlas = export_continuous(mesh_.mesh, mesh_.charts, packing);
    round_texcoords_to_float(atlas);
    CheckOptions options;
    options.width = packing.width;
    options.height = packing.height;
    options.wrap = packing.wrap;
    options.padding = setting_.pack.padding;
    options.margin = setting_.pack.margin < 0 ? options.padding / 2 : setting_.pack.margin;
    options.threads = 1;
    options.max_findings = 10'000;
    const auto report = check_atlas(apply_atlas(mesh_.mesh, atlas), &mesh_.mesh, options);
    if (!report) {
      run.error = report.error().message();
      return;
    }
    run.violations = report->violations;
    for (const Finding& finding : report->findings) {
      const bool overlap =
          finding.kind == Violation::overlap || finding.kind == Violation::self_overlap;
      if (overlap) run.deepest = std::max(run.deepest, finding.amount);
      const bool known = overlap || finding.kind == Violation::gap ||
                         finding.kind == Violation::bounds || finding.kind == Violation::margin;
      if (run.error.empty() && !(may_overlap && known)) run.error = "check: " + finding.text;
    }
  }

  const MeshCharts& mesh_;
  const Setting& setting_;
  const std::function<bool()>& stop_;
  std::vector<Run> runs_;
};

}  // namespace

Result<std::vector<Run>> run_contenders(const MeshCharts& mesh, const Setting& setting,
                                        const std::function<bool()>& stop) {
  return MeshRuns(mesh, setting, stop).all();
}

}  // namespace wrapatlas
