#include "evaluate/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace wrapatlas {
namespace {

constexpr double kTie = 1e-9;  // efficiencies closer than this are equal
constexpr std::array kPaper{"lprm02", "swg03", "zsgs04", "modulo"};

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

const Summary* find(std::span<const Summary> table, const char* contender) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Summary& row) { return row.contender == contender; });
  return found == table.end() ? nullptr : &*found;
}

/// How far a contender's mean over the shapes falls from its highest to its lowest.
double spread(std::span<const ShapeMean> means) {
  const auto [low, high] =
      std::minmax_element(means.begin(), means.end(),
                          [](const ShapeMean& a, const ShapeMean& b) { return a.mean < b.mean; });
  return low == means.end() || high->mean == 0 ? 0 : 1 - low->mean / high->mean;
}

std::string percent_text(double share) { return fmt::format("{:.1f} %", 100 * share); }

Claim best_claim(std::span<const Summary> table, const char* where, double paper) {
  Claim claim;
  claim.text = fmt::format("modulo packs densest on {} % of the meshes ({})", paper, where);
  const double share = find(table, "modulo")->best_of_paper;
  claim.measured = percent_text(share);
  claim.holds = share >= 0.9;
  return claim;
}

Claim order_claim(std::span<const Summary> table, const char* where, const char* paper) {
  Claim claim;
  claim.text = fmt::format(
      "mean efficiency: lprm02 below swg03 and zsgs04, both below modulo ({}: {})", where, paper);
  const double a = find(table, "lprm02")->mean, b = find(table, "swg03")->mean;
  const double c = find(table, "zsgs04")->mean, d = find(table, "modulo")->mean;
  claim.measured = fmt::format("{:.3f}, {:.3f}, {:.3f}, {:.3f}", a, b, c, d);
  claim.holds = a < std::min(b, c) && std::max(b, c) < d;
  return claim;
}

}  // namespace

Reached reached(const MeshResult& mesh, const std::string& contender, Shapes shapes) {
  const auto is_search = [&](const Run& run) {
    return run.contender == contender && run.searched_shape;
  };
  // A search for the shape stands for itself; without one, all shapes tried are one.
  const bool has_search = std::any_of(mesh.runs.begin(), mesh.runs.end(), is_search);
  Reached result;
  for (const Run& run : mesh.runs) {
    if (run.contender != contender) continue;
    if (shapes == Shapes::square ? !run.is_square() : run.searched_shape != has_search) continue;
    result.raster_seconds += run.packing.raster_seconds;
    result.seconds += run.seconds;
    if (run.error.empty() && run.packing.efficiency > result.efficiency) {
      result.efficiency = run.packing.efficiency;
      result.run = &run;
    }
  }
  return result;
}

bool is_of_paper(const std::string& contender) {
  return std::find(kPaper.begin(), kPaper.end(), contender) != kPaper.end();
}

std::vector<Summary> summarize(std::span<const MeshResult> meshes,
                               std::span<const std::string> contenders, Shapes shapes) {
  std::vector<Summary> table;
  std::vector<std::vector<Reached>> all;  // per contender, per mesh
  for (const std::string& contender : contenders) {
    all.emplace_back();
    for (const MeshResult& mesh : meshes) {
      if (mesh.error.empty()) all.back().push_back(reached(mesh, contender, shapes));
    }
  }
  const std::size_t count = all.empty() ? 0 : all.front().size();
  std::vector<double> best(count, 0), best_of_paper(count, 0);
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    for (std::size_t m = 0; m < count; ++m) {
      best[m] = std::max(best[m], all[c][m].efficiency);
      if (is_of_paper(contenders[c])) {
        best_of_paper[m] = std::max(best_of_paper[m], all[c][m].efficiency);
      }
    }
  }
  for (std::size_t c = 0; c < contenders.size() && count > 0; ++c) {
    Summary row;
    row.contender = contenders[c];
    row.min = 1;
    std::vector<double> values;
    for (std::size_t m = 0; m < count; ++m) {
      const Reached& r = all[c][m];
      values.push_back(r.efficiency);
      row.best_of_all += r.efficiency >= best[m] - kTie ? 1 : 0;
      row.best_of_paper += r.efficiency >= best_of_paper[m] - kTie ? 1 : 0;
      row.mean += r.efficiency;
      row.min = std::min(row.min, r.efficiency);
      row.max = std::max(row.max, r.efficiency);
      row.raster_seconds += r.raster_seconds;
      row.seconds += r.seconds;
    }
    row.median = median_of(std::move(values));
    for (double* sum :
         {&row.best_of_all, &row.best_of_paper, &row.mean, &row.raster_seconds, &row.seconds}) {
      *sum /= static_cast<double>(count);
    }
    table.push_back(row);
  }
  return table;
}

std::vector<ShapeMean> means_by_shape(std::span<const MeshResult> meshes,
                                      const std::string& contender) {
  struct Sum {
    double efficiency = 0;
    std::size_t count = 0;
  };
  std::map<double, Sum> by_aspect;
  for (const MeshResult& mesh : meshes) {
    for (const Run& run : mesh.runs) {
      if (run.contender != contender || run.searched_shape) continue;
      Sum& sum = by_aspect[double(run.packing.width) / run.packing.height];
      if (run.error.empty()) sum.efficiency += run.packing.efficiency;
      ++sum.count;
    }
  }
  std::vector<ShapeMean> means;
  for (const auto& [aspect, sum] : by_aspect) {
    means.push_back({aspect, sum.efficiency / static_cast<double>(sum.count)});
  }
  return means;
}

std::vector<Claim> claims(std::span<const MeshResult> meshes,
                          std::span<const std::string> contenders, bool all_shapes) {
  const std::vector<Summary> square = summarize(meshes, contenders, Shapes::square);
  for (const char* name : kPaper) {
    if (!find(square, name)) return {};
  }
  std::vector<Claim> result{best_claim(square, "square", 93.9),
                            order_claim(square, "square", "0.40, 0.48, 0.48, 0.57")};
  if (!all_shapes) return result;
  const std::vector<Summary> variable = summarize(meshes, contenders, Shapes::variable);
  result.push_back(best_claim(variable, "variable aspect ratio", 98.7));
  result.push_back(order_claim(variable, "variable aspect ratio", "0.45, 0.54, 0.53, 0.63"));
  Claim shape;
  shape.text =
      "modulo depends less on the aspect ratio than the others (Figure 8): fall of the mean from "
      "the best ratio to the worst";
  double least_of_others = 1;
  for (const char* name : kPaper) {
    const double fall = spread(means_by_shape(meshes, name));
    shape.measured +=
        fmt::format("{}{} {}", shape.measured.empty() ? "" : ", ", name, percent_text(fall));
    if (std::string(name) != "modulo")
      least_of_others = std::min(least_of_others, fall);
    else
      shape.holds = fall < least_of_others;
  }
  result.push_back(shape);
  Claim raster;
  raster.text = "most of modulo's time is spent rasterising (variable aspect ratio: 65 %)";
  const Summary& ours = *find(variable, "modulo");
  const double share = ours.seconds > 0 ? ours.raster_seconds / ours.seconds : 0;
  raster.measured = percent_text(share);
  raster.holds = share > 0.5;
  result.push_back(raster);
  return result;
}

}  // namespace wrapatlas
