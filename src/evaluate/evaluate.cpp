#include "evaluate/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <mutex>
#include <optional>
#include <set>

#include "evaluate/run_mesh.h"
#include "threads/parallel.h"
#include "wrapatlas/model.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// The Princeton Segmentation Benchmark's kinds, by the number of the last mesh of each.
struct PsbKind {
  int last;
  const char* name;
};
constexpr PsbKind kPsbKinds[] = {
    {20, "human"},    {40, "cup"},        {60, "glasses"},     {80, "airplane"},
    {100, "ant"},     {120, "chair"},     {140, "octopus"},    {160, "table"},
    {180, "teddy"},   {200, "hand"},      {220, "plier"},      {240, "fish"},
    {260, "bird"},    {300, "armadillo"}, {320, "bust"},       {340, "mechanical part"},
    {360, "bearing"}, {380, "vase"},      {400, "four-legged"}};

std::string group_of(const fs::path& path) {
  const std::string folder = fs::absolute(path).parent_path().filename().string();
  const std::string stem = path.stem().string();
  int number = 0;
  const auto parsed = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (folder != "psb" || parsed.ec != std::errc() || parsed.ptr != stem.data() + stem.size()) {
    return folder;
  }
  for (const PsbKind& kind : kPsbKinds) {
    if (number <= kind.last) return fmt::format("psb {}", kind.name);
  }
  return folder;
}

/// What a file name can hold on every system.
std::string id_of(const fs::path& path) {
  std::string id =
      fs::absolute(path).parent_path().filename().string() + "-" + path.stem().string();
  for (char& c : id) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!plain && c != '.' && c != '_' && c != '-') c = '_';
  }
  return id;
}

Result<std::vector<fs::path>> files_of(const std::string& text) {
  const fs::path path(text);
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    if (!fs::exists(path, error)) {
      return Error{ErrorKind::input, text, "no such file or folder", "check the path"};
    }
    if (const auto format = format_from_path(path); !format) return format.error();
    return std::vector<fs::path>{path};
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    if (entry.is_regular_file(error) && format_from_path(entry.path())) {
      files.push_back(entry.path());
    }
  }
  if (files.empty()) {
    return Error{ErrorKind::input, text, "a folder without models",
                 "give one with .obj .ply .off .stl .gltf or .glb files"};
  }
  std::sort(files.begin(), files.end());
  return files;
}

class Evaluation {
 public:
  Evaluation(const Setting& setting, const Store& store,
             const std::function<bool(const EvaluateProgress&)>& report)
      : setting_(setting), store_(store), report_(report) {}

  Result<EvaluateOutcome> run(std::span<const InputMesh> meshes, int threads) {
    std::vector<const InputMesh*> pending;
    for (const InputMesh& mesh : meshes) {
      if (!store_.has(mesh.id)) pending.push_back(&mesh);
    }
    outcome_.done_before = meshes.size() - pending.size();
    all_ = pending.size();
    parallel_for(pending.size(), thread_count(threads), [&](std::size_t i) {
      if (!stopped_) measure(*pending[i]);
    });
    if (failure_) return *failure_;
    outcome_.interrupted = stopped_;
    if (const Status ok = store_.write_csv(setting_); !ok) return ok.error();
    return outcome_;
  }

 private:
  void measure(const InputMesh& input) {
    MeshResult result;
    result.facts.id = input.id;
    result.facts.group = input.group;
    result.facts.file = input.path.string();
    const std::function<bool()> stop = [this] { return poll(); };
    try {
      auto charts = load_mesh_charts(input, setting_, store_.charts_folder(), stop);
      if (!charts) {
        if (charts.error().kind == ErrorKind::interrupted) return;
        if (charts.error().kind == ErrorKind::output) return fail(charts.error());
        result.error = charts.error().message();
      } else {
        result.facts = charts->facts;
        auto runs = run_contenders(*charts, setting_, stop);
        if (!runs) return;  // interrupted
        result.runs = std::move(*runs);
      }
    } catch (const std::bad_alloc&) {
      result.runs.clear();
      result.error = "out of memory";
    }
    finish(result);
  }

  void finish(const MeshResult& result) {
    const std::lock_guard lock(mutex_);
    if (const Status ok = store_.put(result); !ok) return set_failure(ok.error());
    ++done_;
    tell(&result);
  }

  void fail(const Error& error) {
    const std::lock_guard lock(mutex_);
    set_failure(error);
  }

  void set_failure(const Error& error) {
    if (!failure_) failure_ = error;
    stopped_ = true;
  }

  bool poll() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock && !stopped_) tell(nullptr);
    return stopped_;
  }

  /// With the lock held.
  void tell(const MeshResult* result) {
    const std::chrono::duration<double> passed = Clock::now() - start_;
    const double each = done_ > 0 ? passed.count() / static_cast<double>(done_) : 0;
    const EvaluateProgress progress{done_, all_, each * static_cast<double>(all_ - done_), result};
    if (report_ && !report_(progress)) stopped_ = true;
  }

  const Setting& setting_;
  const Store& store_;
  const std::function<bool(const EvaluateProgress&)>& report_;
  Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  std::atomic<bool> stopped_{false};
  std::optional<Error> failure_;
  std::size_t done_ = 0, all_ = 0;
  EvaluateOutcome outcome_;
};

}  // namespace

Result<std::vector<InputMesh>> find_meshes(std::span<const std::string> paths) {
  std::vector<InputMesh> meshes;
  std::set<std::string> ids;
  for (const std::string& text : paths) {
    const auto files = files_of(text);
    if (!files) return files.error();
    for (const fs::path& file : *files) {
      const InputMesh mesh{file, id_of(file), group_of(file)};
      if (!ids.insert(mesh.id).second) {
        return Error{ErrorKind::usage, file.string(),
                     "another file has the same name, but for its ending or its folder's parents",
                     "rename one of them"};
      }
      meshes.push_back(mesh);
    }
  }
  return meshes;
}

Result<EvaluateOutcome> evaluate(std::span<const InputMesh> meshes, const Setting& setting,
                                 const Store& store, int threads,
                                 const std::function<bool(const EvaluateProgress&)>& report) {
  return Evaluation(setting, store, report).run(meshes, threads);
}

}  // namespace wrapatlas
