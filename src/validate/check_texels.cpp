// The part of the judgement that needs the atlas alone: sides, distances, folds.
#include <fmt/format.h>

#include <algorithm>

#include "validate/checker.h"

namespace wrapatlas::validate {
namespace {

double modulo(double x, double period) { return x - std::floor(x / period) * period; }

}  // namespace

/// Page by page.
void Checker::make_items() {
  rounding_ = rounding_of(atlas_, face_chart_, report_.charts, size_, face_tile_);
  if (!face_tile_.empty()) move_to_first_tile(moved_, face_tile_, options_.v_points_down);
  take_items(items_of(atlas_, face_chart_, size_, rounding_));
  if (face_tile_.empty()) return;
  std::stable_sort(items_.begin(), items_.end(), [this](const Item& a, const Item& b) {
    return face_tile_[a.face] < face_tile_[b.face];
  });
  report_.pages = items_.empty() ? 0 : 1;
  for (std::size_t i = 1; i < items_.size(); ++i) {
    if (face_tile_[items_[i].face] != face_tile_[items_[i - 1].face]) ++report_.pages;
  }
}

/// " on page 2", where there are several.
std::string Checker::on_page(std::uint32_t face) const {
  if (face_tile_.empty()) return "";
  return fmt::format(" on page {}", face_tile_[face].page());
}

void Checker::check_tiles() {
  std::vector<bool> seen(report_.charts, false);
  for (const Item& item : items_) {
    if (face_tile_.empty() || seen[item.chart]) continue;
    seen[item.chart] = true;
    const Tile tile = face_tile_[item.face];
    if (tile.is_page(options_.pages)) continue;
    findings_.add({Violation::bounds, item.chart, kNone, item.face, kNone, 0,
                   fmt::format("chart {} begins at u = {}, v = {} or a little beyond: that is none "
                               "of {} pages (face {})",
                               item.chart, tile.column, tile.row, options_.pages, item.face)});
  }
}

void Checker::check_sides() {
  double area = 0;
  struct Worst {
    double clearance = std::numeric_limits<double>::infinity();
    std::uint32_t face = kNone;
    Vec2 at;
    void meet(double other, const Item& item, Vec2 p) {
      if (other < clearance) *this = {other, item.face, p};
    }
  };
  std::vector<Worst> outside(report_.charts), near(report_.charts);
  const std::array<bool, 2> cut{wraps_u(options_.cut), wraps_v(options_.cut)};
  for (const Item& item : items_) {
    area += std::abs(signed_area2(item.corners[0], item.corners[1], item.corners[2])) / 2;
    for (const Vec2 p : item.corners) {
      const std::array<double, 2> clearance{std::min(p.x, size_.x - p.x),
                                            std::min(p.y, size_.y - p.y)};
      for (std::size_t axis = 0; axis < 2; ++axis) {
        if (wraps_[axis]) continue;
        outside[item.chart].meet(clearance[axis], item, p);
        if (!cut[axis]) near[item.chart].meet(clearance[axis], item, p);
      }
    }
  }
  const auto pages = static_cast<double>(std::max<std::size_t>(1, report_.pages));
  report_.efficiency = area / (pages * size_.x * size_.y);
  for (std::uint32_t i = 0; i < outside.size(); ++i) {
    const double tolerance = kSlack + rounding_[i];
    if (outside[i].clearance < -tolerance) {
      const auto& [clearance, face, at] = outside[i];
      findings_.add(
          {Violation::bounds, i, kNone, face, kNone, -clearance,
           fmt::format("chart {} lies {:.6g} texels outside the atlas at ({:.3f}, {:.3f}){} "
                       "(face {})",
                       i, -clearance, at.x, at.y, on_page(face), face)});
    } else if (near[i].clearance < options_.margin - tolerance) {
      const auto& [clearance, face, at] = near[i];
      findings_.add(
          {Violation::margin, i, kNone, face, kNone, clearance,
           fmt::format("chart {} comes within {:.6g} texels of a side at ({:.3f}, {:.3f}){} "
                       "(face {}); the margin is {:g}",
                       i, clearance, at.x, at.y, on_page(face), face, options_.margin)});
    }
  }
}

/// What `find` says of each page, as if it had looked at all of them at once.
Result<ClosePairs> Checker::find_on_pages(const FindPairs& find) const {
  if (face_tile_.empty()) return find(items_);
  ClosePairs all;
  all.smallest_gap = std::numeric_limits<double>::infinity();
  std::uint32_t begin = 0, end = 0;
  for (; begin < items_.size(); begin = end) {
    const Tile tile = face_tile_[items_[begin].face];
    while (end < items_.size() && face_tile_[items_[end].face] == tile) ++end;
    auto close = find(std::span(items_).subspan(begin, end - begin));
    if (!close) return close.error();
    for (PairRecord& record : close->records) {
      record.item_a += begin;
      record.item_b += begin;
      all.records.push_back(record);
    }
    all.smallest_gap = std::min(all.smallest_gap, close->smallest_gap);
    all.complete = all.complete && close->complete;
  }
  return all;
}

Status Checker::check_distances() {
  const double spacing = std::sqrt(static_cast<double>(std::max<std::size_t>(1, report_.pages)) *
                                   size_.x * size_.y / static_cast<double>(items_.size() + 1));
  const double reach = options_.padding + std::min(1.0, spacing);
  const Vec2 period{wraps_[0] ? size_.x : 0, wraps_[1] ? size_.y : 0};
  auto close = find_on_pages([&](std::span<const Item> items) {
    return find_close_pairs(items, period, {options_.padding, reach, rounding_, options_.threads});
  });
  if (!close) return close.error();
  report_.smallest_gap = std::min(close->smallest_gap, reach);
  report_.gap_reach = reach;
  for (const PairRecord& record : close->records) {
    Finding finding{record.kind,
                    record.chart_a,
                    record.chart_b,
                    items_[record.item_a].face,
                    items_[record.item_b].face,
                    record.amount,
                    {}};
    if (report_.findings.size() < options_.max_findings) finding.text = describe(record);
    findings_.add(std::move(finding));
  }
  if (!close->complete) {
    report_.remarks.emplace_back("there are more pairs of charts in conflict than were counted");
  }
  return Done{};
}

std::string Checker::describe(const PairRecord& record) const {
  const Triangle& a = items_[record.item_a].corners;
  Triangle b = items_[record.item_b].corners;
  for (Vec2& p : b) p = p - Vec2{record.shift_x * size_.x, record.shift_y * size_.y};
  Vec2 at;
  if (record.kind == Violation::gap) {
    const Closest closest = closest_points(a, b);
    at = 0.5 * (closest.on_a + closest.on_b);
  } else {
    at = middle_of_overlap(a, b);
  }
  if (wraps_[0]) at.x = modulo(at.x, size_.x);
  if (wraps_[1]) at.y = modulo(at.y, size_.y);
  const std::uint32_t face_a = items_[record.item_a].face, face_b = items_[record.item_b].face;
  const std::string where = fmt::format("at ({:.3f}, {:.3f}){} (faces {} and {})", at.x, at.y,
                                        on_page(face_a), face_a, face_b);
  const bool across = record.shift_x != 0 || record.shift_y != 0;
  const std::string who =
      record.chart_a != record.chart_b
          ? fmt::format("charts {} and {}", record.chart_a, record.chart_b)
          : fmt::format("chart {} and its own {}", record.chart_a, across ? "image" : "cut piece");
  const char* border = across && record.chart_a != record.chart_b ? " across the border" : "";
  if (record.kind == Violation::gap) {
    return fmt::format("{} are {:.6g} texels apart{} {}; the padding is {:g}", who, record.amount,
                       border, where, options_.padding);
  }
  return fmt::format("{} overlap by {:.6g} texels{} {}", who, record.amount, border, where);
}

Status Checker::remark_folds() {
  auto folds = find_on_pages([this](std::span<const Item> items) {
    return find_folds(items, {0, 0, rounding_, options_.threads});
  });
  if (!folds) return folds.error();
  std::size_t number = 0;
  for (const PairRecord& fold : folds->records) {
    findings_.remark(
        number++,
        fmt::format("chart {} overlaps itself by {:.6g} texels (faces {} and "
                    "{}): a fold that the UVs came with",
                    fold.chart_a, fold.amount, items_[fold.item_a].face, items_[fold.item_b].face));
  }
  findings_.remark_rest(number, "charts overlap themselves");
  if (!folds->complete) {
    report_.remarks.emplace_back(
        "where thousands of triangles crowd in one place, charts were not checked for folds");
  }
  return Done{};
}

}  // namespace wrapatlas::validate
