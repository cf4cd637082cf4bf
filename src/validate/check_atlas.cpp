#include <fmt/format.h>

#include "validate/checker.h"
#include "validate/cut_pieces.h"

namespace wrapatlas {
namespace validate {
namespace {

constexpr int kLargestAtlas = 1 << 20;

Status check_options(const CheckOptions& o) {
  const auto bad = [](std::string what, std::string remedy) {
    return Error{ErrorKind::usage, "check", std::move(what), std::move(remedy)};
  };
  if (o.width < 1 || o.height < 1 || o.width > kLargestAtlas || o.height > kLargestAtlas) {
    return bad(fmt::format("an atlas of {} x {} texels", o.width, o.height),
               fmt::format("give sides of 1 to {} texels", kLargestAtlas));
  }
  const double side = std::min(o.width, o.height);
  if (!(o.padding >= 0) || !(o.margin >= 0) || !(o.padding < side) || !(o.margin < side)) {
    return bad(fmt::format("padding {} and margin {} for {} x {} texels", o.padding, o.margin,
                           o.width, o.height),
               "give numbers from 0 to less than the shorter side");
  }
  if (!(o.tolerance >= 0 && o.tolerance < 1e30)) {
    return bad(fmt::format("a tolerance of {} texels", o.tolerance), "give a number from 0");
  }
  if (o.pages < 1) return bad(fmt::format("{} pages", o.pages), "give a number from 1");
  return Done{};
}

Error with_prefix(const char* whose, Error error) {
  error.where = error.where.empty() ? whose : fmt::format("{}, {}", whose, error.where);
  return error;
}

}  // namespace

/// Which pages the charts are on; then all of them are judged as if they were on the first.
void Checker::find_tiles(const std::vector<std::uint32_t>& face_group, std::size_t groups) {
  if (options_.pages == 1) return;
  face_tile_ = tiles_of(atlas_, face_group, groups, options_.v_points_down);
}

/// Without a reference: charts are what fits together, also across the border.
void Checker::take_pieces_for_charts(const FaceCharts& own) {
  CutCharts cut = join_cut_pieces(atlas_, own);
  report_.charts = cut.charts.count;
  face_chart_ = std::move(cut.charts.of_face);
  fits_.face_shift = std::move(cut.face_shift);
  if (cut.charts.count < own.count) {
    report_.remarks.push_back(
        fmt::format("{} pieces fit together at the border: they count as {} charts cut there",
                    own.count, cut.charts.count));
  }
  if (options_.stacked_ok) {
    report_.remarks.emplace_back("which charts were stacked cannot be known without a reference");
  }
}

void Checker::take_items(TexelItems found) {
  items_ = std::move(found.items);
  std::size_t number = 0;
  for (const std::uint32_t face : found.crossing_faces) {
    findings_.remark(number++,
                     fmt::format("face {} crosses itself in the texture: it counts as its "
                                 "convex hull",
                                 face));
  }
  findings_.remark_rest(number, "faces cross themselves");
}

Result<CheckReport> Checker::run() {
  report_.faces = atlas_.face_count();
  for (std::size_t f = 0; f < atlas_.face_count(); ++f) {
    if (!has_texcoords(atlas_, f)) ++report_.faces_without_uv;
  }
  FaceCharts pieces;
  if (reference_ == nullptr) {
    pieces = connect_faces(atlas_, atlas_.face_object);
    find_tiles(pieces.of_face, pieces.count);
    take_pieces_for_charts(pieces);
  } else {
    if (Status status = compare(pieces); !status) return status.error();
    find_tiles(face_chart_, report_.charts);
  }
  make_items();
  check_tiles();
  check_sides();
  if (reference_ != nullptr) {
    fit(pieces.of_face);
    check_areas_of_faces();
  }
  if (Status status = reassemble(); !status) return status.error();
  if (Status status = check_distances(); !status) return status.error();
  if (Status status = remark_folds(); !status) return status.error();
  return std::move(report_);
}

}  // namespace validate

Result<CheckReport> check_atlas(const Mesh& atlas, const Mesh* reference,
                                const CheckOptions& options) {
  if (Status status = validate::check_options(options); !status) return status.error();
  if (Status status = validate_mesh(atlas); !status) {
    return validate::with_prefix("atlas", status.error());
  }
  if (reference != nullptr) {
    if (Status status = validate_mesh(*reference); !status) {
      return validate::with_prefix("reference", status.error());
    }
  }
  return validate::Checker(atlas, reference, options).run();
}

}  // namespace wrapatlas
