#include "transfer_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common.h"
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

/// Packs at the size asked for, or at the smallest of whole fours at which no texel is lost.
Result<Packing> pack_texels(const TransferArguments& a, const ChartSet& charts,
                            const std::string& label) {
  PackOptions options = a.pack.options;
  ProgressLine line(!a.pack.quiet);
  options.progress = [&](const Progress& progress) {
    line.show(fmt::format("{}packing {:3.0f} %", label, 100 * progress.fraction));
    return !interrupted();
  };
  if (a.size_given) return pack(charts.charts, options);
  const double asked = options.time;
  options.time = 0;
  double side = std::sqrt(charts.total_area() / 0.75), least = 1;
  constexpr double kMost = 16384;
  constexpr int kRounds = 4, kMostRounds = 9;
  for (int round = 1;; ++round) {
    side = 4 * std::ceil(std::max(side, least) / 4);
    if (side > kMost) {
      return Error{ErrorKind::no_packing, "",
                   fmt::format("to lose no texel the atlas would have {:.0f} a side", side),
                   "give --resolution; where textures repeat often, they had better stay"};
    }
    options.width = options.height = static_cast<int>(side);
    options.time = round < kRounds ? 0 : asked;
    auto packing = pack(charts.charts, options);
    if (!packing && packing.error().kind == ErrorKind::no_packing) {
      least = 2 * side;  // the padding alone needs more
      round = 0;
      continue;
    }
    if (!packing || packing->interrupted) return packing;
    if ((round >= kRounds && packing->scale >= 1) || round == kMostRounds) return packing;
    // Towards the end it only grows.
    side *= round < kRounds ? 1.002 / packing->scale : std::max(1.002 / packing->scale, 1.002);
  }
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
