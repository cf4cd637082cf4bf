#include "evaluate/mesh_result.h"

#include <fmt/format.h>

#include <algorithm>

#include "names.h"

namespace wrapatlas {
namespace {

Json run_json(const Run& run) {
  const Packing& packing = run.packing;
  Json json = {{"contender", run.contender},
               {"searched_shape", run.searched_shape},
               {"width", packing.width},
               {"height", packing.height},
               {"wrap", name_of(kWraps, packing.wrap)},
               {"grid", {packing.grid_width, packing.grid_height}},
               {"efficiency", packing.efficiency},
               {"raster_efficiency", packing.raster_efficiency},
               {"scale", packing.scale},
               {"packings", packing.packings},
               {"raster_seconds", packing.raster_seconds},
               {"place_seconds", packing.place_seconds},
               {"seconds", run.seconds},
               {"violations", run.violations},
               {"deepest", run.deepest},
               {"error", run.error}};
  if (packing.placements.empty()) return json;
  Json placements = Json::array();
  for (const Placement& p : packing.placements) {
    placements.push_back({p.angle, p.translation.x, p.translation.y});
  }
  json["placements"] = std::move(placements);
  return json;
}

Run run_from(const Json& json) {
  Run run;
  Packing& packing = run.packing;
  run.contender = json.at("contender").get<std::string>();
  run.searched_shape = json.at("searched_shape").get<bool>();
  packing.width = json.at("width").get<int>();
  packing.height = json.at("height").get<int>();
  packing.wrap = value_of(kWraps, json.at("wrap").get<std::string>()).value_or(Wrap::none);
  packing.grid_width = json.at("grid").at(0).get<int>();
  packing.grid_height = json.at("grid").at(1).get<int>();
  packing.efficiency = json.at("efficiency").get<double>();
  packing.raster_efficiency = json.at("raster_efficiency").get<double>();
  packing.scale = json.at("scale").get<double>();
  packing.packings = json.at("packings").get<int>();
  packing.raster_seconds = json.at("raster_seconds").get<double>();
  packing.place_seconds = json.at("place_seconds").get<double>();
  run.seconds = json.at("seconds").get<double>();
  run.violations = json.at("violations").get<std::size_t>();
  run.deepest = json.at("deepest").get<double>();
  run.error = json.at("error").get<std::string>();
  if (!json.contains("placements")) return run;
  for (const Json& p : json.at("placements")) {
    packing.placements.push_back(
        {p.at(0).get<double>(), {p.at(1).get<double>(), p.at(2).get<double>()}, 0});
  }
  return run;
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string shape_name(const Run& run) {
  if (run.searched_shape) return "search";
  return run.is_square() ? "square" : "fixed";
}

}  // namespace

Json facts_json(const MeshFacts& facts) {
  return {{"id", facts.id},
          {"group", facts.group},
          {"file", facts.file},
          {"faces", facts.faces},
          {"charts", facts.charts},
          {"unwrapped", facts.unwrapped},
          {"l2", facts.l2},
          {"linf", facts.linf},
          {"border", facts.border},
          {"unwrap_seconds", facts.unwrap_seconds},
          {"charts_file", facts.charts_file}};
}

MeshFacts facts_from(const Json& json) {
  MeshFacts facts;
  facts.id = json.at("id").get<std::string>();
  facts.group = json.at("group").get<std::string>();
  facts.file = json.at("file").get<std::string>();
  facts.faces = json.at("faces").get<std::size_t>();
  facts.charts = json.at("charts").get<std::size_t>();
  facts.unwrapped = json.at("unwrapped").get<bool>();
  facts.l2 = json.at("l2").get<double>();
  facts.linf = json.at("linf").get<double>();
  facts.border = json.at("border").get<double>();
  facts.unwrap_seconds = json.at("unwrap_seconds").get<double>();
  facts.charts_file = json.at("charts_file").get<std::string>();
  return facts;
}

Json result_json(const MeshResult& result) {
  Json runs = Json::array();
  for (const Run& run : result.runs) runs.push_back(run_json(run));
  return {{"mesh", facts_json(result.facts)}, {"error", result.error}, {"runs", std::move(runs)}};
}

Result<MeshResult> result_from(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    MeshResult result;
    result.facts = facts_from(json.at("mesh"));
    result.error = json.at("error").get<std::string>();
    for (const Json& run : json.at("runs")) result.runs.push_back(run_from(run));
    return result;
  } catch (const Json::exception& error) {
    return Error{ErrorKind::input, "", fmt::format("not a result of bench ({})", error.what()),
                 "delete it, and run bench again"};
  }
}

std::string csv_header() {
  return "mesh,group,file,faces,charts,unwrapped,l2,linf,border,unwrap_seconds,packer,method,wrap,"
         "time,shape,width,height,grid_width,grid_height,padding,rotations,rotation_base,coverage,"
         "scale_start,lambda,inner,all_sides,seed,efficiency,raster_efficiency,scale,packings,"
         "raster_seconds,place_seconds,seconds,violations,deepest_overlap,error\n";
}

std::string csv_rows(const MeshResult& result, const Setting& setting) {
  const MeshFacts& mesh = result.facts;
  const std::string begin =
      fmt::format("{},{},{},{},{},{:d},{:.6g},{:.6g},{:.6g},{:.4g},", csv_text(mesh.id),
                  csv_text(mesh.group), csv_text(mesh.file), mesh.faces, mesh.charts,
                  mesh.unwrapped, mesh.l2, mesh.linf, mesh.border, mesh.unwrap_seconds);
  if (!result.error.empty()) {
    return begin + std::string(27, ',') + csv_text(result.error) + "\n";
  }
  std::string rows;
  const PackOptions& pack = setting.pack;
  for (const Run& run : result.runs) {
    const Packing& p = run.packing;
    const auto contender =
        std::find_if(setting.contenders.begin(), setting.contenders.end(),
                     [&](const Contender& c) { return c.name == run.contender; });
    if (contender == setting.contenders.end()) continue;
    const bool is_guided = contender->method == Method::guided;
    rows += begin;
    rows += fmt::format("{},{},{},{},{},{},{},{},{},", run.contender,
                        name_of(kMethods, contender->method), name_of(kWraps, contender->wrap),
                        is_guided ? fmt::format("{}", contender->time) : "", shape_name(run),
                        p.width, p.height, p.grid_width, p.grid_height);
    rows +=
        fmt::format("{},{},{},{},{},{},{:d},{:d},{},", pack.padding, pack.rotations,
                    name_of(kRotationBases, pack.rotation_base), name_of(kCoverages, pack.coverage),
                    pack.start_upper, pack.lambda, pack.inner, pack.all_sides, pack.seed);
    rows += fmt::format("{:.9g},{:.9g},{:.9g},{},{:.4g},{:.4g},{:.4g},{},{:.4g},{}\n", p.efficiency,
                        p.raster_efficiency, p.scale, p.packings, p.raster_seconds, p.place_seconds,
                        run.seconds, run.violations, run.deepest, csv_text(run.error));
  }
  return rows;
}

}  // namespace wrapatlas
