#include "unwrap_report.h"

#include <algorithm>

namespace wrapatlas::cli {

void print_unwrap_notes(const std::string& input, const UnwrapOptions& options,
                        const Unwrapping& unwrapping) {
  const SurfaceReport& surface = unwrapping.surface;
  const auto note = [&](std::uint32_t count, const char* noun, const char* what) {
    if (count > 0) say("{}: note: {} {}\n", input, quantity(count, noun), what);
  };
  note(surface.folded_faces, "face",
       "using a point twice: no part of the surface, each has a chart of its own");
  note(surface.flat_faces, "face", "of no area");
  note(surface.duplicate_faces, "face", "lying on another face of the same points");
  note(surface.turned_faces, "face",
       "wound against the rest of the surface: unwrapped as if turned, the winding stays");
  note(surface.one_sided_edges, "edge", "where the surface has one side only: cut there");
  note(surface.crowded_edges, "edge",
       "of more than two faces: the flattest pairs go on in each other");
  note(surface.shared_points, "point", "where parts of the surface touch: cut there");
  if (options.max_charts > 0 && unwrapping.charts.size() > options.max_charts) {
    const bool apart = unwrapping.charts.size() == surface.components + surface.folded_faces;
    say("{}: note: {} remain, more than --max-charts {}: {}\n", input,
        quantity(unwrapping.charts.size(), "chart"), options.max_charts,
        apart ? "the surface is of so many parts that do not touch"
              : "each union left would be of over 60,000 triangles, overlap itself or be stretched "
                "too far");
  }
}

Worst worst_of(const Unwrapping& unwrapping) {
  Worst worst;
  for (const UnwrappedChart& chart : unwrapping.charts) {
    worst.l2 = std::max(worst.l2, chart.distortion.l2);
    worst.linf = std::max(worst.linf, chart.distortion.linf);
    worst.bad += chart.is_good ? 0 : 1;
  }
  return worst;
}

Json unwrap_json(const UnwrapOptions& options, const Unwrapping& unwrapping) {
  const Worst worst = worst_of(unwrapping);
  const SurfaceReport& surface = unwrapping.surface;
  Json charts = Json::array();
  for (const UnwrappedChart& chart : unwrapping.charts) {
    charts.push_back({{"faces", chart.faces},
                      {"area", chart.area},
                      {"border_length", chart.border_length},
                      {"l2", chart.distortion.l2},
                      {"linf", chart.distortion.linf},
                      {"angle", chart.distortion.angle},
                      {"lscm", chart.used_lscm}});
  }
  return {{"faces", unwrapping.face_chart.size()},
          {"max_stretch", options.max_stretch},
          {"stretch_measure", name_of(kStretches, options.stretch)},
          {"max_extent", options.max_extent},
          {"flatten", name_of(kFlattenMethods, options.flatten.method)},
          {"iterations", options.flatten.iterations},
          {"stretch", {{"l2_max", worst.l2}, {"linf_max", worst.linf}}},
          {"charts_beyond_limits", worst.bad},
          {"degenerate_faces", surface.folded_faces + surface.flat_faces},
          {"repairs",
           {{"folded_faces", surface.folded_faces},
            {"flat_faces", surface.flat_faces},
            {"duplicate_faces", surface.duplicate_faces},
            {"turned_faces", surface.turned_faces},
            {"one_sided_edges", surface.one_sided_edges},
            {"crowded_edges", surface.crowded_edges},
            {"shared_points", surface.shared_points}}},
          {"components", surface.components},
          {"border_edges", surface.border_edges},
          {"unwrapped", charts}};
}

}  // namespace wrapatlas::cli
