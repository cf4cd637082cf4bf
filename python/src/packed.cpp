#include "packed.h"

#include <fmt/format.h>

#include "failures.h"
#include "pack/request.h"

namespace wrapatlas::python {
namespace {

Status check(Packed& packed) {
  CheckOptions promises = promises_of(packed.settings.options, packed.packing, packed.settings.cut);
  promises.stacked_ok = packed.settings.stacked == Stacked::keep;
  promises.v_points_down = packed.source.model->v_points_down;
  auto report = check_atlas(apply_atlas(packed.mesh(), packed.atlas), &packed.mesh(), promises);
  if (!report) return report.error();
  packed.report = std::move(*report);
  // The paper's coverage is known to be unsafe; who asks for it gets it, and can read the report.
  if (packed.report.ok() || packed.settings.options.coverage == Coverage::center) return Done{};
  const std::string first =
      packed.report.findings.empty() ? "" : ": " + packed.report.findings.front().text;
  return Error{
      ErrorKind::check, "",
      fmt::format("the finished atlas breaks {} promises{}", packed.report.violations, first),
      "please report this as a bug"};
}

}  // namespace

Result<PackedMesh> make_packed(const PyMesh& mesh, std::optional<Unwrapping> unwrapping,
                               const PackSettings& settings, const Tell& tell) {
  auto packed = std::make_shared<Packed>();
  packed->source = mesh;
  packed->unwrapping = std::move(unwrapping);
  packed->settings = settings;
  PackOptions& options = packed->settings.options;
  auto charts = build_charts(packed->mesh(), settings.stacked);
  if (!charts) return charts.error();
  packed->charts = std::move(*charts);
  if (mesh.has_space) packed->uv_density = uv_density(packed->mesh());
  if (settings.density > 0) {
    if (packed->uv_density == 0) {
      return bad_input("density", "the faces have no area in UV or in space, so there is none",
                       mesh.has_space ? "unwrap the mesh again, or leave it out"
                                      : "pass positions=, or leave it out");
    }
    options.density = settings.density / packed->uv_density;
  }
  options.progress = [&tell](const Progress& progress) {
    return tell("pack", progress.fraction, progress.best_efficiency);
  };
  auto packing = pack(packed->charts.charts, options);
  options.progress = nullptr;
  if (!packing) {
    return in_units_of_surface(packing.error(), packed->uv_density, "density=");
  }
  packed->packing = std::move(*packing);
  tell("pack", 1, packed->packing.efficiency);
  const bool down = mesh.model->v_points_down;
  packed->atlas = settings.cut
                      ? export_cut(packed->mesh(), packed->charts, packed->packing, down)
                      : export_continuous(packed->mesh(), packed->charts, packed->packing, down);
  round_texcoords_to_float(packed->atlas);
  if (settings.check) {
    if (const Status ok = check(*packed); !ok) return ok.error();
  }
  packed->vertices = split_vertices(packed->mesh(), packed->atlas);
  return PackedMesh{std::move(packed)};
}

}  // namespace wrapatlas::python
