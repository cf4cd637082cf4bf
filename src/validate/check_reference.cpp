// The part of the judgement that compares an atlas with the mesh that it was made from.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "validate/checker.h"

namespace wrapatlas::validate {
namespace {

constexpr double kScaleTolerance = 1e-5;

struct Outline {
  double area = 0, length = 0;
};

Outline outline_of(const Mesh& mesh, std::size_t face, Vec2 unit) {
  Outline outline;
  const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
  const auto at = [&](std::uint32_t c) {
    const Vec2 d =
        mesh.texcoords[mesh.corner_texcoord[c]] - mesh.texcoords[mesh.corner_texcoord[begin]];
    return Vec2{d.x * unit.x, d.y * unit.y};
  };
  for (std::uint32_t c = begin; c < end; ++c) {
    const Vec2 a = at(c), b = at(c + 1 == end ? begin : c + 1);
    outline.area += 0.5 * cross(a, b);
    outline.length += length(b - a);
  }
  return outline;
}

constexpr double kTogether = 1;            ///< texels: charts that moved as one are no farther off
constexpr std::size_t kMostParties = 256;  ///< of one stack that are told apart

}  // namespace

/// The objects that count are those of the reference: a format may have lost them, or keep other
/// things apart. So the pieces found in the atlas are those of one chart of the reference each.
Status Checker::compare(FaceCharts& pieces) {
  auto match = match_faces(atlas_, *reference_, size_);
  if (!match) return match.error();
  match_ = std::move(*match);
  original_ = connect_faces(*reference_, reference_->face_object);
  std::vector<std::uint32_t> chart_of_face;
  chart_of_face.reserve(atlas_.face_count());
  for (const std::uint32_t source : match_.source) {
    chart_of_face.push_back(original_.of_face[source]);
  }
  pieces = connect_faces(atlas_, chart_of_face);
  const auto lost = [&](std::uint32_t f, std::uint32_t atlas_face, const char* how) {
    findings_.add(
        {Violation::missing_face, original_.of_face[f], kNone, atlas_face, f, 0,
         fmt::format("face {} of the reference (chart {}) {}", f, original_.of_face[f], how)});
  };
  for (const std::uint32_t f : match_.missing) {
    if (original_.of_face[f] != kNone) lost(f, kNone, "is not in the atlas");
  }
  // Faces that only the atlas has UVs for form charts of their own behind those of the reference.
  face_chart_.assign(atlas_.face_count(), kNone);
  std::vector<std::uint32_t> extra(pieces.count, kNone);
  std::uint32_t charts = original_.count, last_lost = kNone;
  for (std::uint32_t f = 0; f < atlas_.face_count(); ++f) {
    const std::uint32_t source = match_.source[f], chart = chart_of_face[f];
    if (pieces.of_face[f] == kNone) {
      if (chart != kNone && source != last_lost) lost(source, f, "has no UVs in the atlas");
      if (chart != kNone) last_lost = source;
    } else if (chart != kNone) {
      face_chart_[f] = chart;
    } else {
      std::uint32_t& number = extra[pieces.of_face[f]];
      if (number == kNone) number = charts++;
      face_chart_[f] = number;
    }
  }
  report_.charts = charts;
  return Done{};
}

void Checker::fit(const std::vector<std::uint32_t>& face_piece) {
  std::array<bool, 2> may_shift = wraps_;
  Box2 all;
  for (const Item& item : items_) {
    for (const Vec2 p : item.corners) all.add(p);
  }
  // An atlas within [0,1] may have been cut at sides that it is now said not to wrap around.
  may_shift[0] = may_shift[0] || (all.min.x >= -kSlack && all.max.x <= size_.x + kSlack);
  may_shift[1] = may_shift[1] || (all.min.y >= -kSlack && all.max.y <= size_.y + kSlack);
  fits_ = fit_charts({atlas_, match_, face_chart_, face_piece, original_.count, size_, may_shift,
                      rounding_, options_.tolerance});
  report_.scale = fits_.scale;
  std::size_t untold = 0;
  for (std::uint32_t i = 0; i < fits_.charts.size(); ++i) {
    const ChartFit& chart = fits_.charts[i];
    if (chart.untold) {
      findings_.remark(untold++, fmt::format("chart {} was cut where its corners cannot be told "
                                             "apart in space: its shape was not compared",
                                             i));
    }
    if (chart.verdict == ChartFit::Verdict::mirrored) {
      findings_.add({Violation::mirrored, i, kNone, chart.worst_face, kNone, chart.residual,
                     fmt::format("chart {} is mirrored", i)});
    } else if (chart.verdict == ChartFit::Verdict::distorted) {
      findings_.add({Violation::not_similar, i, kNone, chart.worst_face, kNone, chart.residual,
                     fmt::format("chart {} is not a turned and scaled copy of the reference: "
                                 "face {} is {:.6g} texels off",
                                 i, chart.worst_face, chart.residual)});
    } else if (chart.scale > 0) {
      const double ratio = chart.scale / fits_.scale;
      if (std::abs(ratio - 1) > kScaleTolerance + 2 * (chart.scale_doubt + fits_.scale_doubt)) {
        findings_.add({Violation::scale, i, kNone, chart.worst_face, kNone, ratio,
                       fmt::format("chart {} has {:.8g} times the common scale", i, ratio)});
      }
    }
  }
  findings_.remark_rest(untold, "charts were not compared");
}

/// In space a missing sliver can drown in the rounding of positions; in the texture it is seen.
void Checker::check_areas_of_faces() {
  struct Run {
    std::uint32_t first, source, chart;
    double lacking, allowed;
  };
  std::vector<Run> runs;
  std::uint32_t end = 0;
  for (std::uint32_t first = 0; first < atlas_.face_count(); first = end) {
    const std::uint32_t source = match_.source[first], chart = original_.of_face[source];
    bool judged = chart != kNone && fits_.charts[chart].verdict == ChartFit::Verdict::similar;
    Outline pieces;
    for (end = first; end < atlas_.face_count() && match_.source[end] == source; ++end) {
      judged = judged && face_chart_[end] == chart;
      if (!judged) continue;
      const Outline piece = outline_of(atlas_, end, size_);
      pieces = {pieces.area + piece.area, pieces.length + piece.length};
    }
    if (!judged) continue;
    const ChartFit& fit = fits_.charts[chart];
    // Positions that do not tell corners apart do not tell the chart's own scale either.
    const bool own = fit.scale > 0;
    const double scale = own ? fit.scale : fits_.scale;
    if (!(scale > 0)) continue;
    const double doubt = own ? fit.scale_doubt : fits_.scale_doubt;
    const Outline whole = outline_of(*reference_, source, {scale, scale});
    const double sign = whole.area < 0 ? -1 : 1;
    runs.push_back(
        {first, source, chart, sign * (whole.area - pieces.area),
         (options_.tolerance + 3 * rounding_[chart]) * std::max(pieces.length, whole.length) +
             2 * doubt * std::abs(whole.area)});
  }
  // A sliver between two faces of a chart may have been counted as one of the other face.
  const auto lacking = [&](std::size_t i, const Run& near, double sign) {
    return i < runs.size() && runs[i].chart == near.chart ? std::max(0.0, sign * runs[i].lacking)
                                                          : 0.0;
  };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    const double sign = run.lacking < 0 ? -1 : 1;
    const double amount =
        std::abs(run.lacking) - lacking(i - 1, run, -sign) - lacking(i + 1, run, -sign);
    if (amount <= run.allowed) continue;
    const Violation kind = sign < 0 ? Violation::self_overlap : Violation::missing_face;
    findings_.add({kind, run.chart, kNone, run.first, run.source, amount,
                   fmt::format("the pieces of face {} of the reference (chart {}) {} {:.6g} square "
                               "texels",
                               run.source, run.chart,
                               sign < 0 ? "cover it more than once, by" : "leave out", amount)});
  }
}

Status Checker::find_stacks_of_reference() {
  const double unit = fits_.scale > 0 ? fits_.scale : 1;
  const std::vector<double> rounding =
      rounding_of(*reference_, original_.of_face, original_.count, {unit, unit});
  const std::vector<Item> items =
      items_of(*reference_, original_.of_face, {unit, unit}, rounding).items;
  auto stacks = find_stacks(items, original_.count, {0, 0, rounding, options_.threads});
  if (!stacks) return stacks.error();
  std::copy(stacks->begin(), stacks->end(), stack_.begin());
  return Done{};
}

/// Per chart the periods that bring it to its stack. Charts of a stack that moved as one, like a
/// party, get shifts that keep them together, wherever the rest of the stack has gone.
std::vector<std::array<double, 2>> Checker::shifts_to_stacks() const {
  std::vector<std::uint32_t> order(original_.count);
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  // The largest first: where others would be is told best by it.
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(stack_[a], -fits_.charts[a].weight, a) <
           std::tuple(stack_[b], -fits_.charts[b].weight, b);
  });
  std::vector<std::array<double, 2>> shifts(report_.charts);
  std::vector<std::uint32_t> parties;  // the first of each
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::uint32_t i = order[k];
    if (k == 0 || stack_[order[k - 1]] != stack_[i]) {
      parties.assign(1, i);
      continue;
    }
    const auto periods_to = [&](std::uint32_t other) {
      const Vec2 way =
          fits_.charts[other].placed(fits_.charts[i].middle) - fits_.charts[i].placed_middle;
      return Vec2{way.x / size_.x, way.y / size_.y};
    };
    const auto moved_with = [&](std::uint32_t other) {
      const Vec2 periods = periods_to(other);
      return std::abs(periods.x - std::round(periods.x)) * size_.x < kTogether &&
             std::abs(periods.y - std::round(periods.y)) * size_.y < kTogether;
    };
    auto party = std::find_if(parties.begin(), parties.end(), moved_with);
    if (party == parties.end()) {
      if (parties.size() < kMostParties) parties.push_back(i);
      party = parties.begin();
    }
    const Vec2 periods = periods_to(*party);
    shifts[i] = {shifts[*party][0] + std::round(periods.x),
                 shifts[*party][1] + std::round(periods.y)};
  }
  return shifts;
}

/// Moves the pieces of cut charts together again, and the charts of a stack onto each other, by
/// whole periods along the axes that wrap: that changes no distance on the torus.
Status Checker::reassemble() {
  stack_.resize(report_.charts);
  for (std::uint32_t i = 0; i < report_.charts; ++i) stack_[i] = i;
  if (options_.stacked_ok && reference_ != nullptr) {
    if (Status status = find_stacks_of_reference(); !status) return status;
  }
  const std::vector<std::array<double, 2>> to_stack = shifts_to_stacks();
  struct Key {
    std::uint32_t stack;
    std::array<std::int32_t, 2> shift;
    std::uint32_t item;
    [[nodiscard]] auto value() const { return std::tie(stack, shift); }
  };
  std::vector<Key> keys;
  keys.reserve(items_.size());
  for (std::uint32_t i = 0; i < items_.size(); ++i) {
    Item& item = items_[i];
    item.stack = stack_[item.chart];
    std::array<std::int32_t, 2> apart = fits_.face_shift[item.face];
    Vec2 move;
    if (wraps_[0]) move.x = (apart[0] + to_stack[item.chart][0]) * size_.x;
    if (wraps_[1]) move.y = (apart[1] + to_stack[item.chart][1]) * size_.y;
    for (Vec2& p : item.corners) p = p + move;
    if (wraps_[0]) apart[0] = 0;
    if (wraps_[1]) apart[1] = 0;
    keys.push_back({stack_[item.chart], apart, i});
  }
  std::sort(keys.begin(), keys.end(),
            [](const Key& a, const Key& b) { return a.value() < b.value(); });
  std::uint32_t group = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0 && keys[i - 1].value() != keys[i].value()) ++group;
    items_[keys[i].item].group = group;
  }
  return Done{};
}

}  // namespace wrapatlas::validate
