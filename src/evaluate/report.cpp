#include "evaluate/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluate/gallery.h"
#include "evaluate/plot.h"
#include "evaluate/report_tables.h"
#include "evaluate/store.h"
#include "io/file.h"

namespace wrapatlas {
namespace {

constexpr const char* kHead = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>wrapatlas: evaluation</title>
<link rel="icon" href="data:,">
<style>
body { font: 16px/1.5 system-ui, sans-serif; color: #1b1e23; margin: 0 auto; max-width: 64rem; padding: 1rem; }
h1 { line-height: 1.2 } h2 { margin-top: 2.5rem; border-bottom: 1px solid #d5d8dd } h3 { margin-bottom: 0 }
.wide { overflow-x: auto } table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums }
td, th { padding: 0.25rem 0.6rem; text-align: right; border-bottom: 1px solid #e7e9ec; white-space: nowrap }
td:first-child, th:first-child { text-align: left } th.block { padding-top: 0.9rem }
.claims td { white-space: normal }
.holds { color: #00664a } .fails { color: #a33c00; font-weight: bold } .note { color: #555 }
.gallery { display: flex; flex-wrap: wrap; gap: 0.8rem }
.gallery figure { margin: 0; flex: 1 1 10rem; max-width: 20rem }
figure img { max-width: 100%; height: auto; display: block } figcaption { font-size: 0.85rem }
svg { max-width: 100%; height: auto }
@media print { body { max-width: none; font-size: 10pt } h2 { break-after: avoid }
  figure, svg, h3 + p + .gallery { break-inside: avoid } }
</style></head><body>
)html";

/// But for the start of the scale search, on which the paper contradicts itself.
bool is_papers_setting(const Json& setting) {
  const Json paper = {{"width", 256},  {"height", 256},        {"padding", 0.0},
                      {"grid", 256},   {"rotations", 16},      {"lambda", 1.1},
                      {"inner", true}, {"coverage", "center"}, {"rotation_base", "input"}};
  return std::all_of(paper.items().begin(), paper.items().end(),
                     [&](const auto& item) { return setting.at(item.key()) == item.value(); });
}

class Report {
 public:
  Report(std::filesystem::path results, std::filesystem::path out, Json setting,
         std::vector<MeshResult> meshes)
      : results_(std::move(results)),
        out_(std::move(out)),
        setting_(std::move(setting)),
        meshes_(std::move(meshes)) {
    for (const Json& contender : setting_.at("contenders")) {
      contenders_.push_back(contender.at("name").get<std::string>());
    }
    all_shapes_ = setting_.at("aspect") == "search";
    const auto modulo = std::find(contenders_.begin(), contenders_.end(), "modulo");
    last_ = modulo != contenders_.end() ? *modulo : contenders_.back();
  }

  Status write() {
    html_ = kHead;
    add_opening();
    add_claims();
    add_tables();
    if (const Status ok = add_plots(); !ok) return ok;
    if (const Status ok = add_galleries(); !ok) return ok;
    add_meshes();
    html_ += "</body></html>\n";
    return save("index.html", html_);
  }

 private:
  Status save(const char* name, const std::string& text) const {
    return write_file(out_ / name, text);
  }

  [[nodiscard]] std::size_t done() const {
    return static_cast<std::size_t>(std::count_if(
        meshes_.begin(), meshes_.end(), [](const MeshResult& mesh) { return mesh.error.empty(); }));
  }

  void add_opening() {
    html_ += fmt::format("<h1>Packing {} meshes by {} packers</h1>\n", done(), contenders_.size());
    std::string setting;
    for (const auto& [name, value] : setting_.items()) {
      if (name == "contenders") continue;
      std::string words = name;
      std::replace(words.begin(), words.end(), '_', ' ');
      setting += fmt::format("{}{} {}", setting.empty() ? "" : ", ", words,
                             value.is_string() ? value.get<std::string>() : value.dump());
    }
    html_ += fmt::format(
        "<p class=\"note\">Setting: {}. Efficiency: exact area of the charts over "
        "that of the atlas. Times are of one thread.</p>\n",
        escaped(setting));
    add_failures();
  }

  void add_failures() {
    std::string failures;
    std::size_t unsafe = 0, checked = 0;
    double deepest = 0;
    for (const MeshResult& mesh : meshes_) {
      if (!mesh.error.empty()) {
        failures += fmt::format("<li>{}</li>\n", escaped(mesh.error));
      }
      for (const Run& run : mesh.runs) {
        ++checked;
        unsafe += run.violations > 0 ? 1 : 0;
        deepest = std::max(deepest, run.deepest);
        if (!run.error.empty()) {
          failures += fmt::format("<li>{}, {} {} × {}: {}</li>\n", escaped(mesh.facts.id),
                                  escaped(run.contender), run.packing.width, run.packing.height,
                                  escaped(run.error));
        }
      }
    }
    if (!failures.empty()) {
      html_ += "<h2>What failed</h2>\n<ul class=\"fails\">\n" + failures + "</ul>\n";
    }
    html_ += fmt::format("<p class=\"note\">Each of the {} packings went through the exact check. ",
                         checked);
    if (unsafe > 0) {
      html_ += fmt::format(
          "In {} of them charts overlap, by {:.2f} texels at most: a grid cell "
          "belongs to a chart here if its centre does, as in the paper, which is not "
          "safe.",
          unsafe, deepest);
    } else {
      html_ += "None breaks a promise.";
    }
    html_ += "</p>\n";
  }

  void add_claims() {
    const std::vector<Claim> all = claims(meshes_, contenders_, all_shapes_);
    if (all.empty() || !is_papers_setting(setting_)) return;
    const auto fails =
        std::count_if(all.begin(), all.end(), [](const Claim& c) { return !c.holds; });
    html_ += fmt::format(
        "<h2>The paper's claims on these charts: {} of {} hold</h2>\n<div "
        "class=\"wide claims\"><table><tr><th>claim of the paper</th><th>here</th>"
        "<th></th></tr>\n",
        all.size() - static_cast<std::size_t>(fails), all.size());
    for (const bool holds : {false, true}) {
      for (const Claim& claim : all) {
        if (claim.holds != holds) continue;
        html_ += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"{}\">{}</td></tr>\n",
                             escaped(claim.text), escaped(claim.measured),
                             holds ? "holds" : "fails", holds ? "holds" : "does not hold");
      }
    }
    html_ += "</table></div>\n";
  }

  void add_tables() {
    const bool beside_paper = is_papers_setting(setting_);
    table_ = paper_table(meshes_, contenders_, all_shapes_, beside_paper);
    html_ += beside_paper ? "<h2>Table 1</h2>\n<p class=\"note\">In brackets: Nöll &amp; Stricker "
                            "2011, on 380 meshes, charts of their own and a processor of its time. "
                          : "<h2>Efficiency and time</h2>\n<p class=\"note\">";
    html_ += "Of equals each counts as best.</p>\n" + as_html(table_);
    groups_ = group_table(meshes_, contenders_);
    html_ += "<h2>By kind of mesh</h2>\n<p class=\"note\">Mean efficiency in the square.</p>\n" +
             as_html(groups_);
  }

  Status add_plot(const char* file, const Plot& plot) {
    const std::string svg = draw_plot(plot);
    html_ += svg;
    return save(file, svg);
  }

  Status add_plots() {
    html_ += "<h2>Plots</h2>\n";
    if (all_shapes_) {
      if (const Status ok = add_plot("figure8.svg", shape_plot()); !ok) return ok;
    }
    if (const Status ok = add_plot("charts.svg", charts_plot()); !ok) return ok;
    if (const Status ok = add_plot("time.svg", time_plot()); !ok) return ok;
    if (const Status ok = save("table1.md", as_markdown(table_)); !ok) return ok;
    return save("kinds.md", as_markdown(groups_));
  }

  [[nodiscard]] Plot shape_plot() const {
    Plot plot;
    plot.title = "Mean efficiency by aspect ratio (the paper's Figure 8)";
    plot.x = {"width : height", true, 1, 1};
    plot.y = {"efficiency"};
    for (const std::string& contender : contenders_) {
      PlotSeries series{contender, {}};
      for (const ShapeMean& mean : means_by_shape(meshes_, contender)) {
        series.points.push_back({mean.aspect, mean.mean});
        plot.x.low = std::min(plot.x.low, mean.aspect);
        plot.x.high = std::max(plot.x.high, mean.aspect);
      }
      if (series.points.size() > 1) plot.series.push_back(std::move(series));
    }
    return plot;
  }

  /// Efficiency in the square of each mesh, over something of it.
  template <typename Value>
  [[nodiscard]] Plot scatter(const char* title, const char* across, Value value) const {
    Plot plot;
    plot.title = title;
    plot.lines = false;
    plot.x = {across, true, 1e300, 0};
    plot.y = {"efficiency"};
    for (const std::string& contender : contenders_) {
      PlotSeries series{contender, {}};
      for (const MeshResult& mesh : meshes_) {
        const Reached best = reached(mesh, contender, Shapes::square);
        const double x = value(mesh, best);
        if (!best.run || !(x > 0)) continue;
        series.points.push_back({x, best.efficiency});
        plot.x.low = std::min(plot.x.low, x);
        plot.x.high = std::max(plot.x.high, x);
      }
      plot.series.push_back(std::move(series));
    }
    if (!(plot.x.low < plot.x.high)) plot.x = {across, true, 1, 10};
    return plot;
  }

  [[nodiscard]] Plot charts_plot() const {
    return scatter(
        "Efficiency in the square by number of charts", "charts",
        [](const MeshResult& mesh, const Reached&) { return double(mesh.facts.charts); });
  }

  [[nodiscard]] Plot time_plot() const {
    return scatter("Efficiency in the square by time", "seconds, one thread",
                   [](const MeshResult&, const Reached& best) { return best.seconds; });
  }

  Status add_galleries() {
    const auto add = [&](const char* title, const std::vector<Exhibit>& exhibits) -> Status {
      const auto gallery = gallery_html(exhibits, contenders_, results_ / "charts");
      if (!gallery) return gallery.error();
      html_ += fmt::format(
          "<h2>{}</h2>\n<p>Hatched: parts of charts that have crossed the border "
          "and come in on the other side.</p>\n{}",
          title, *gallery);
      return Done{};
    };
    const Status ok = add("The same charts by every packer (the paper's Figures 1 and 9 to 12)",
                          typical_exhibits(meshes_, last_, all_shapes_));
    if (!ok) return ok;
    return add("Worst cases", worst_exhibits(meshes_, contenders_, last_));
  }

  void add_meshes() {
    html_ += fmt::format(
        "<h2>Every mesh</h2>\n<details><summary>Efficiency in the square{}"
        "</summary>\n{}</details>\n",
        all_shapes_ ? " / on the best shape" : "",
        as_html(mesh_table(meshes_, contenders_, all_shapes_)));
  }

  std::filesystem::path results_, out_;
  Json setting_;
  std::vector<MeshResult> meshes_;
  std::vector<std::string> contenders_;
  std::string last_;
  bool all_shapes_ = false;
  Table table_, groups_;
  std::string html_;
};

}  // namespace

Status write_report(const std::filesystem::path& results, const std::filesystem::path& out) {
  auto setting = read_setting(results);
  if (!setting) return setting.error();
  auto meshes = read_results(results);
  if (!meshes) return meshes.error();
  if (meshes->empty()) {
    return Error{ErrorKind::input, results.string(), "no mesh is done yet", "run bench first"};
  }
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) {
    return Error{ErrorKind::output, out.string(),
                 fmt::format("cannot make this folder ({})", error.message()), "choose another"};
  }
  OutputTransaction outputs;
  if (const Status ok = Report(results, out, std::move(*setting), std::move(*meshes)).write();
      !ok) {
    return ok;
  }
  return outputs.commit();
}

}  // namespace wrapatlas
