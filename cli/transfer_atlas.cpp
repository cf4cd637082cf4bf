#include "transfer_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

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

/// Sides of a square atlas, whole fours, closed in on the least at which no texel is lost by what a
/// packing says of its scale at each.
class SideSearch {
 public:
  explicit SideSearch(double first) { go_to(first); }

  [[nodiscard]] int side() const { return side_; }

  /// Not even the padding had room.
  void had_no_room() {
    too_small_ = side_;
    go_to(2.0 * side_);
  }
  /// After a packing made in a hurry, by which no side is ruled out.
  void guess(double scale) {
    if (scale >= 1) enough_ = enough_ == 0 ? side_ : std::min(enough_, side_);
    go_to(side_ * kMargin / scale);
  }
  void below_what_is_enough() {
    if (enough_ != 0 && side_ >= enough_) go_to((1 - kStep) * enough_);
  }
  /// Goes to the next side. False: none that is much smaller than the best would do.
  bool narrow(double scale) {
    (scale >= 1 ? enough_ : too_small_) = side_;
    const double promised = side_ * kMargin / scale;
    const bool is_between = promised > too_small_ && (enough_ == 0 || promised < enough_);
    if (scale >= 1 && promised > side_) return false;
    go_to(is_between ? promised : 0.5 * (too_small_ + enough_));
    return enough_ == 0 || enough_ - side_ > kWorthATry * enough_;
  }

 private:
  static constexpr double kMargin = 1.002;                   ///< packings scatter
  static constexpr double kStep = 0.01, kWorthATry = 0.007;  ///< of the side

  void go_to(double side) {
    side_ = std::max(4 * static_cast<int>(std::ceil(side / 4)), too_small_ + 4);
  }

  int side_ = 0, too_small_ = 0;
  int enough_ = 0;  ///< 0: not known yet
};

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
  constexpr int kMost = 16384, kHasty = 3, kRounds = 9;
  SideSearch search(std::sqrt(charts.total_area() / 0.75));
  std::optional<Packing> best;
  for (int round = 0; round < kRounds; ++round) {
    if (search.side() > kMost) {
      return Error{ErrorKind::no_packing, "",
                   fmt::format("to lose no texel the atlas would have {} a side", search.side()),
                   "give --resolution; where textures repeat often, they had better stay"};
    }
    options.width = options.height = search.side();
    options.time = round < kHasty ? 0 : a.pack.options.time;
    auto packing = pack(charts.charts, options);
    if (!packing && packing.error().kind == ErrorKind::no_packing) {
      search.had_no_room();
      round = -1;
      continue;
    }
    if (!packing || packing->interrupted) return packing;
    const double scale = packing->scale;
    const bool is_better = !best || (scale >= 1 ? best->scale < 1 || packing->width < best->width
                                                : best->scale < scale);
    if (is_better) best = *std::move(packing);
    if (round < kHasty) {
      search.guess(scale);
      if (round + 1 == kHasty) search.below_what_is_enough();
    } else if (!search.narrow(scale)) {
      break;
    }
  }
  return *std::move(best);
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
