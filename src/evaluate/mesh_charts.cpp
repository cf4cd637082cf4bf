#include "evaluate/mesh_charts.h"

#include <fmt/format.h>

#include <cmath>

#include "io/file.h"
#include "wrapatlas/model.h"

namespace wrapatlas {
namespace {

/// FNV-1a, 64 bits.
std::uint64_t hash_of(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

bool has_uvs(const Mesh& mesh) {
  return std::any_of(mesh.corner_texcoord.begin(), mesh.corner_texcoord.end(),
                     [](std::uint32_t t) { return t != kNone; });
}

Error at_file(const std::filesystem::path& path, Error error) {
  error.where = path.string() + (error.where.empty() ? "" : ": " + error.where);
  return error;
}

/// Cuts and flattens the mesh and writes it to `path`, its numbers beside it.
Status make_charts(const InputMesh& input, Model& model, const Setting& setting,
                   const std::filesystem::path& path, const std::filesystem::path& facts_path,
                   const std::function<bool()>& stop) {
  UnwrapOptions options = setting.unwrap;
  options.threads = 1;
  options.progress = [&stop](const UnwrapProgress&) { return !stop(); };
  const auto unwrapping = unwrap(model.mesh, options);
  if (!unwrapping) return at_file(input.path, unwrapping.error());
  MeshFacts facts;
  facts.id = input.id;
  facts.group = input.group;
  facts.file = input.path.string();
  facts.faces = model.mesh.face_count();
  facts.charts = unwrapping->charts.size();
  facts.unwrapped = true;
  double area = 0, length = 0;
  for (const UnwrappedChart& chart : unwrapping->charts) {
    facts.l2 = std::max(facts.l2, chart.distortion.l2);
    facts.linf = std::max(facts.linf, chart.distortion.linf);
    area += chart.area;
    length += chart.border_length;
  }
  facts.border = area > 0 ? length / 2 / std::sqrt(area) : 0;
  facts.unwrap_seconds = unwrapping->surface_seconds + unwrapping->segment_seconds;
  facts.charts_file = path.filename().string();
  model.v_points_down = false;  // a new file, whose UVs are as they were made
  model.source.reset();
  OutputTransaction outputs;
  if (const Status ok = save_model(model, keep_texcoords(unwrapping->mesh), path); !ok) return ok;
  if (const Status ok = write_file(facts_path, facts_json(facts).dump(1)); !ok) return ok;
  return outputs.commit();
}

Result<MeshFacts> read_facts(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return text.error();
  try {
    return facts_from(Json::parse(*text));
  } catch (const Json::exception&) {
    return Error{ErrorKind::input, path.string(), "not what bench keeps there", "delete it"};
  }
}

}  // namespace

Result<MeshCharts> load_mesh_charts(const InputMesh& input, const Setting& setting,
                                    const std::filesystem::path& cache,
                                    const std::function<bool()>& stop) {
  const auto bytes = read_file(input.path);
  if (!bytes) return bytes.error();
  auto model = load_model(input.path);
  if (!model) return model.error();
  MeshCharts result;
  if (setting.unwrap_all || !has_uvs(model->mesh)) {
    const std::uint64_t key = hash_of(unwrap_key(setting), hash_of(*bytes));
    const auto path = cache / fmt::format("{}-{:016x}.obj", input.id, key);
    auto facts_path = path;
    facts_path.replace_extension(".json");
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored) || !std::filesystem::exists(facts_path, ignored)) {
      const Status ok = make_charts(input, *model, setting, path, facts_path, stop);
      if (!ok) return ok.error();
    }
    auto facts = read_facts(facts_path);
    if (!facts) return facts.error();
    result.facts = std::move(*facts);
    model = load_model(path);
    if (!model) return model.error();
  } else {
    result.facts.faces = model->mesh.face_count();
  }
  result.facts.id = input.id;
  result.facts.group = input.group;
  result.facts.file = input.path.string();
  result.mesh = std::move(model->mesh);
  auto charts = build_charts(result.mesh);
  if (!charts) return at_file(input.path, charts.error());
  result.charts = std::move(*charts);
  result.facts.charts = result.charts.charts.size();
  return result;
}

Result<ChartSet> load_charts(const MeshFacts& facts, const std::filesystem::path& cache) {
  const auto model = load_model(facts.charts_file.empty() ? std::filesystem::path(facts.file)
                                                          : cache / facts.charts_file);
  if (!model) return model.error();
  return build_charts(model->mesh);
}

}  // namespace wrapatlas
