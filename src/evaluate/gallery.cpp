#include "evaluate/gallery.h"

#include <fmt/format.h>

#include <algorithm>

#include "evaluate/mesh_charts.h"
#include "evaluate/plot.h"
#include "io/gltf_json.h"
#include "wrapatlas/picture.h"

namespace wrapatlas {
namespace {

constexpr std::size_t kWorst = 4;

double square_efficiency(const MeshResult& mesh, const std::string& contender) {
  return reached(mesh, contender, Shapes::square).efficiency;
}

/// Of the meshes given, the one in the middle by efficiency.
const MeshResult* middle_of(std::vector<const MeshResult*> meshes, const std::string& contender) {
  if (meshes.empty()) return nullptr;
  std::stable_sort(meshes.begin(), meshes.end(), [&](const MeshResult* a, const MeshResult* b) {
    return square_efficiency(*a, contender) < square_efficiency(*b, contender);
  });
  return meshes[meshes.size() / 2];
}

std::vector<const MeshResult*> usable(std::span<const MeshResult> meshes) {
  std::vector<const MeshResult*> result;
  for (const MeshResult& mesh : meshes) {
    if (mesh.error.empty() && !mesh.runs.empty()) result.push_back(&mesh);
  }
  return result;
}

Result<std::string> figure_html(const std::string& contender, const Reached& best,
                                std::span<const Chart> charts) {
  if (!best.run || best.run->packing.placements.size() != charts.size()) {
    return fmt::format("<figure><figcaption>{}: no packing</figcaption></figure>\n",
                       escaped(contender));
  }
  const Packing& packing = best.run->packing;
  PictureOptions options;
  options.size = 320;
  options.ids = false;
  const auto png = encode_png(draw_atlas(charts, packing, options));
  if (!png) return png.error();
  return fmt::format(
      "<figure><img alt=\"packed by {0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}: "
      "{2:.1f} %, {3} × {4}</figcaption></figure>\n",
      escaped(contender), base64_encode(*png), 100 * packing.efficiency, packing.width,
      packing.height);
}

}  // namespace

std::vector<Exhibit> typical_exhibits(std::span<const MeshResult> meshes, const std::string& last,
                                      bool all_shapes) {
  const std::vector<const MeshResult*> all = usable(meshes);
  if (all.empty()) return {};
  std::vector<Exhibit> exhibits;
  const MeshResult* most = *std::max_element(
      all.begin(), all.end(),
      [](const MeshResult* a, const MeshResult* b) { return a->facts.charts < b->facts.charts; });
  exhibits.push_back({most, Shapes::square, "the one with the most charts"});
  std::vector<std::string> kinds{"psb table", "psb fish", "psb airplane"};
  const bool has_kinds = std::any_of(all.begin(), all.end(), [&](const MeshResult* mesh) {
    return mesh->facts.group == kinds.front();
  });
  if (!has_kinds) kinds = {""};
  for (const std::string& kind : kinds) {
    std::vector<const MeshResult*> of_kind;
    for (const MeshResult* mesh : all) {
      if (kind.empty() || mesh->facts.group == kind) of_kind.push_back(mesh);
    }
    const MeshResult* middle = middle_of(of_kind, last);
    if (!middle) continue;
    exhibits.push_back({middle, Shapes::square, "in the middle of its kind; square"});
    if (all_shapes) exhibits.push_back({middle, Shapes::variable, "the same; best shape"});
  }
  return exhibits;
}

std::vector<Exhibit> worst_exhibits(std::span<const MeshResult> meshes,
                                    std::span<const std::string> contenders,
                                    const std::string& last) {
  std::vector<const MeshResult*> all = usable(meshes);
  std::stable_sort(all.begin(), all.end(), [&](const MeshResult* a, const MeshResult* b) {
    return square_efficiency(*a, last) < square_efficiency(*b, last);
  });
  std::vector<Exhibit> exhibits;
  for (std::size_t i = 0; i < std::min(kWorst, all.size()); ++i) {
    exhibits.push_back({all[i], Shapes::square, last + " is lowest"});
  }
  const auto lead = [&](const MeshResult* mesh) {
    double most = 0;
    for (const std::string& other : contenders) {
      if (other == last || (is_of_paper(last) && !is_of_paper(other))) continue;
      most = std::max(most, square_efficiency(*mesh, other) - square_efficiency(*mesh, last));
    }
    return most;
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const MeshResult* a, const MeshResult* b) { return lead(a) > lead(b); });
  for (std::size_t i = 0; i < std::min(kWorst, all.size()) && lead(all[i]) > 1e-9; ++i) {
    const auto shown = [&](const Exhibit& exhibit) { return exhibit.mesh == all[i]; };
    if (std::any_of(exhibits.begin(), exhibits.end(), shown)) continue;
    exhibits.push_back(
        {all[i], Shapes::square,
         fmt::format("{} is behind another by {:.1f} points", last, 100 * lead(all[i]))});
  }
  return exhibits;
}

Result<std::string> gallery_html(std::span<const Exhibit> exhibits,
                                 std::span<const std::string> contenders,
                                 const std::filesystem::path& cache) {
  std::string html;
  for (const Exhibit& exhibit : exhibits) {
    const MeshFacts& facts = exhibit.mesh->facts;
    const auto charts = load_charts(facts, cache);
    if (!charts) return charts.error();
    html += fmt::format("<h3>{}: {}, {} {}</h3>\n<p>{}</p>\n<div class=\"gallery\">\n",
                        escaped(facts.id), escaped(facts.group), facts.charts,
                        facts.charts == 1 ? "chart" : "charts", escaped(exhibit.why));
    for (const std::string& contender : contenders) {
      const auto figure =
          figure_html(contender, reached(*exhibit.mesh, contender, exhibit.shapes), charts->charts);
      if (!figure) return figure.error();
      html += *figure;
    }
    html += "</div>\n";
  }
  return html;
}

}  // namespace wrapatlas
