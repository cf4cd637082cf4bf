#include "transfer_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common.h"
#include "pack/side_search.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/model.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::cli {
namespace {

/// The set's faces in new charts, each about as large as its old texels.
Result<Mesh> unwrapped(const TransferArguments& a, const Mesh& texels, bool v_points_down,
                       const std::string& label) {
  ProgressLine line(!a.pack.quiet);
  UnwrapOptions options;
  options.max_extent = default_extent(a.pack.options.wrap);
  options.threads = a.pack.options.threads;
  options.progress = [&](const UnwrapProgress& progress) {
    line.show(fmt::format("{}unwrapping {:3.0f} %", label, 100 * progress.fraction));
    return !interrupted();
  };
  auto made = unwrap(texels, options);
  if (!made) return made.error();
  scale_to_texels(made->mesh, made->face_chart, texels);
  if (v_points_down) {
    for (Vec2& uv : made->mesh.texcoords) uv.y = -uv.y;
  }
  return std::move(made->mesh);
}

/// Packs at the size asked for, or at about the smallest square at which no texel is lost.
Result<Packing> pack_texels(const TransferArguments& a, const ChartSet& charts,
                            const std::string& label) {
  PackOptions options = a.pack.options;
  ProgressLine line(!a.pack.quiet);
  options.progress = [&](const Progress& progress) {
    line.show(fmt::format("{}packing {:3.0f} %", label, 100 * progress.fraction));
    return !interrupted();
  };
  if (a.size_given) return pack(charts.charts, options);
  const double full = std::sqrt(charts.total_area());  // if there were no gaps
  SideSearch search(full / std::sqrt(0.75));
  std::optional<Packing> best;
  bool goes_on = full <= SideSearch::kMost;
  while (goes_on) {
    options.width = options.height = search.side();
    options.time = search.is_quick() ? 0 : a.pack.options.time;
    auto packing = pack(charts.charts, options);
    const bool no_room = !packing && packing.error().kind == ErrorKind::no_packing;
    if (!no_room && (!packing || packing->interrupted)) return packing;
    const double scale = no_room ? 0 : packing->scale;
    goes_on = search.go_on(scale);
    if (scale >= 1 && packing->width == search.enough()) best = *std::move(packing);
  }
  if (best) return *std::move(best);
  return Error{ErrorKind::no_packing, "",
               fmt::format("to lose no texel the atlas would have more than {} a side",
                           std::max(std::floor(full), double{SideSearch::kMost})),
               "give --resolution; where textures repeat often, they had better stay"};
}

Status check_result(const PackArguments& a, const Mesh& before, const AtlasMesh& atlas,
                    const Packing& packing, bool v_points_down) {
  CheckOptions options = promises_of(a.options, packing, false);
  options.stacked_ok = true;
  options.v_points_down = v_points_down;
  const auto report = check_atlas(apply_atlas(before, atlas), &before, options);
  if (!report) return report.error();
  if (report->ok()) return Done{};
  return broken_promise("", *report);
}

}  // namespace

Result<NewAtlas> pack_texture_set(const TransferArguments& a, const TextureSet& set,
                                  bool v_points_down, const std::string& label) {
  const Mesh texels = mesh_in_texels(set);
  Mesh mesh = texels;
  if (a.unwrap) {
    auto cut = unwrapped(a, texels, v_points_down, label);
    if (!cut) return cut.error();
    mesh = *std::move(cut);
  }
  // New charts may lie on each other, each in its own scale; old ones do so on purpose.
  auto charts = build_charts(mesh, a.unwrap ? Stacked::separate : Stacked::keep);
  if (!charts) return charts.error();
  auto packing = pack_texels(a, *charts, label);
  if (!packing) return packing.error();
  if (packing->interrupted) {
    return Error{ErrorKind::interrupted, "", "stopped before the textures were moved",
                 "nothing was written"};
  }
  AtlasMesh atlas = export_continuous(mesh, *charts, *packing, v_points_down);
  round_texcoords_to_float(atlas);
  if (const Status ok = check_result(a.pack, mesh, atlas, *packing, v_points_down); !ok) {
    return ok.error();
  }
  const double thinned = share_thinned(mesh, packing->scale, texels);
  return NewAtlas{*std::move(charts), *std::move(packing), std::move(atlas), thinned, {}};
}

Status fill_textures(const TransferArguments& a, const TextureSet& set, bool v_points_down,
                     const std::string& label, NewAtlas& atlas) {
  ProgressLine line(!a.pack.quiet);
  TransferOptions options;
  options.width = atlas.packing.width;
  options.height = atlas.packing.height;
  options.wrap = atlas.packing.wrap;
  options.v_points_down = v_points_down;
  options.keeps_tangents = set.keeps_tangents;
  options.bleed = a.bleed;
  options.threads = a.pack.options.threads;
  options.progress = [&](double share) {
    line.show(fmt::format("{}moving textures {:3.0f} %", label, 100 * share));
    return !interrupted();
  };
  std::vector<TransferTarget> targets;
  for (const SetTexture& texture : set.textures) targets.push_back(texture.target);
  auto made = transfer(set.mesh, apply_atlas(set.mesh, atlas.atlas), set.group, targets, options);
  if (!made) return made.error();
  atlas.textures = *std::move(made);
  return Done{};
}

}  // namespace wrapatlas::cli
