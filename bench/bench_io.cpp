// load_model and save_model on a million triangles, beside the least a reader can do: get the bytes
// and make numbers of them. Every measurement has a process of its own.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "atlas/uncut_atlas.h"
#include "commands.h"
#include "io/file.h"
#include "io_files.h"
#include "own_process.h"
#include "report.h"
#include "wrapatlas/model.h"

namespace wrapatlas::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kTargetTime = 3, kTargetMemory = 6;

double fail(const Error& error) {
  fmt::print(stderr, "{}\n", error.message());
  return -1;
}

/// All numbers of a text, one after the other.
std::vector<float> parse_floats(const std::string& text) {
  std::vector<float> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    float value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error == std::errc()) numbers.push_back(value);
    at = stop == at ? at + 1 : stop;
  }
  return numbers;
}

double read_and_parse(const fs::path& path, const Sheet&) {
  const Stopwatch stopwatch;
  const auto bytes = read_file(path);
  if (!bytes) return fail(bytes.error());
  keep(parse_floats(*bytes));
  return stopwatch.seconds();
}

/// The least a GLB reader does: the file's bytes, and its floats out of them. They are floats
/// already, so there is nothing to parse; a Mesh takes more (doubles, indices, two of them a
/// corner), which this leaves out. Saving is held against the same baseline, without a write.
double read_and_copy(const fs::path& path, const Sheet& sheet) {
  const Stopwatch stopwatch;
  const auto bytes = read_file(path);
  if (!bytes) return fail(bytes.error());
  std::vector<float> floats(5 * sheet.texcoords());
  const std::size_t indices = 4 * 3 * sheet.triangles();
  std::memcpy(floats.data(), bytes->data() + bytes->size() - indices - 4 * floats.size(),
              4 * floats.size());
  keep(floats);
  return stopwatch.seconds();
}

double load(const fs::path& path, const Sheet& sheet) {
  const Stopwatch stopwatch;
  const auto model = load_model(path);
  if (!model) return fail(model.error());
  const double seconds = stopwatch.seconds();
  return model->mesh.face_count() == sheet.triangles() ? seconds : -1;
}

/// The UVs of the file at half their size: as many as there were, all with other digits.
AtlasMesh smaller(const Mesh& mesh) {
  AtlasMesh atlas = uncut_atlas(mesh);
  for (const Vec2 uv : mesh.texcoords) atlas.texcoords.push_back(0.5137 * uv);
  atlas.corner_texcoord = mesh.corner_texcoord;
  return atlas;
}

fs::path output_beside(const fs::path& path) {
  return path.parent_path() / ("out" + path.extension().string());
}

double save(const fs::path& path, const Sheet&) {
  const auto model = load_model(path);
  if (!model) return fail(model.error());
  const AtlasMesh atlas = smaller(model->mesh);
  const Stopwatch stopwatch;
  const Status saved = save_model(*model, atlas, output_beside(path));
  return saved ? stopwatch.seconds() : fail(saved.error());
}

/// The bytes that `save` wrote, once more: what the disk takes.
double write_alone(const fs::path& path, const Sheet&) {
  const auto bytes = read_file(output_beside(path));
  if (!bytes) return fail(bytes.error());
  const Stopwatch stopwatch;
  const Status written = write_file(output_beside(path), *bytes);
  return written ? stopwatch.seconds() : fail(written.error());
}

/// Median time and largest peak; nothing if a run failed.
std::optional<JobResult> measure(int runs, double (*job)(const fs::path&, const Sheet&),
                                 const fs::path& path, const Sheet& sheet) {
  std::vector<double> seconds;
  double peak = 0;
  for (int run = 0; run < runs; ++run) {
    const auto result = in_own_process([&] { return job(path, sheet); });
    if (!result) return std::nullopt;
    seconds.push_back(result->seconds);
    peak = std::max(peak, result->peak_bytes);
  }
  return JobResult{median(seconds), peak};
}

struct Case {
  const char* name;
  fs::path path;
  double array_bytes;
  double (*baseline)(const fs::path&, const Sheet&);
  const char* baseline_name;
};

bool run_case(const Case& what, const Sheet& sheet, int runs) {
  const auto baseline = measure(runs, what.baseline, what.path, sheet);
  const auto loaded = measure(runs, load, what.path, sheet);
  const auto saved = measure(runs, save, what.path, sheet);
  const auto written = measure(runs, write_alone, what.path, sheet);
  if (!baseline || !loaded || !saved || !written) return false;
  constexpr double kMega = 1e6;
  fmt::print("\n{}: {:.1f} MB, arrays {:.1f} MB\n", what.name,
             static_cast<double>(fs::file_size(what.path)) / kMega, what.array_bytes / kMega);
  Table table({"what", "ms", "time / baseline", "target", "met", "peak MB", "peak / arrays",
               "target", "met"});
  const auto add = [&](const char* name, const JobResult& result, bool judged) {
    const double time = result.seconds / baseline->seconds;
    const double memory = result.peak_bytes / what.array_bytes;
    const auto met = [&](bool holds) { return judged ? (holds ? "yes" : "no") : ""; };
    table.add({name, fmt::format("{:.1f}", 1e3 * result.seconds), fmt::format("{:.2f} x", time),
               judged ? fmt::format("<= {:.0f}", kTargetTime) : "", met(time <= kTargetTime),
               fmt::format("{:.1f}", result.peak_bytes / kMega), fmt::format("{:.2f} x", memory),
               judged ? fmt::format("<= {:.0f}", kTargetMemory) : "",
               met(memory <= kTargetMemory)});
  };
  add(what.baseline_name, *baseline, false);
  add("load_model", *loaded, true);
  add("save_model (peak: with the model and its atlas)", *saved, true);
  add("write_file of the result alone, with its fsync", *written, false);
  table.print();
  return true;
}

}  // namespace

int bench_io(const IoBenchOptions& options) {
  const Sheet sheet = sheet_of(options.triangles);
  fmt::print("options: io, {} triangles, {} positions, {} UVs in {} patches, median of {} runs\n",
             sheet.triangles(), sheet.positions(), sheet.texcoords(), sheet.patches(),
             options.runs);
  fmt::print(
      "Arrays: 12 B a position, 8 B a UV, 4 B an index; OBJ: two indices a corner (position, UV);\n"
      "GLB: one, and as many positions as UVs. Peak: the process's VmHWM, program included.\n");

  std::string folder = options.keep;
  if (folder.empty()) {
    folder = (fs::temp_directory_path() / "wrapatlas_bench.XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) {
      fmt::print(stderr, "{}: cannot make this folder\n", folder);
      return 3;
    }
  }
  const fs::path obj = fs::path(folder) / "sheet.obj", glb = fs::path(folder) / "sheet.glb";
  const auto made = in_own_process([&] {
    for (const Status& status : {write_sheet_obj(sheet, obj), write_sheet_glb(sheet, glb)}) {
      if (!status) return fail(status.error());
    }
    return 0.0;
  });
  bool fine = made.has_value();
  if (options.keep.empty()) {
    const auto corners = 3 * static_cast<double>(sheet.triangles());
    const auto points = static_cast<double>(sheet.positions());
    const auto uvs = static_cast<double>(sheet.texcoords());
    fine = fine && run_case({"OBJ", obj, 12 * points + 8 * uvs + 8 * corners, read_and_parse,
                             "baseline: read_file + from_chars"},
                            sheet, options.runs);
    fine = fine && run_case({"GLB", glb, 20 * uvs + 4 * corners, read_and_copy,
                             "baseline: read_file + copied floats"},
                            sheet, options.runs);
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  return fine ? 0 : 1;
}

}  // namespace wrapatlas::bench
