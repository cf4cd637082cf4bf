// Charts by growth, then split and merged on stretch.
//
// The growth is that of Sander, Wood, Gortler, Snyder & Hoppe, Multi-chart geometry images (SGP
// 2003); splitting and merging until the stretch is within a limit is Nöll & Stricker's (EGSR 2011,
// section 3), of which they give no details. These are ours: a chart that fails is grown anew from
// two seeds of its own; then neighbours become one if their union is good, those first of which one
// has most of its border in common with the other.
#include "segment/segment.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iterator>
#include <mutex>
#include <set>

#include "segment/grow.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

constexpr int kGrowRounds = 6;
constexpr int kSplitRounds = 4;

/// Charts to begin with: few, as those that fail are split. Of one component, by its faces.
std::uint32_t first_charts(std::size_t faces) {
  if (faces < 200) return 1;
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(faces / 8000, 6, 200));
}

class Segmenter {
 public:
  Segmenter(const Surface& surface, const UnwrapOptions& options)
      : surface_(surface), options_(options), shapes_(face_shapes(surface)) {}

  Result<Segmentation> run() {
    owners_.chart.assign(surface_.face_count(), kNone);
    owners_.place.assign(surface_.face_count(), 0);
    grow_components();
    while (!pending_.empty() && !poll()) try_pending();
    merge(options_);
    if (options_.max_charts > 0) merge_beyond();
    if (stopped_) {
      return Error{ErrorKind::interrupted, "", "stopped before all charts were made", ""};
    }
    return Segmentation{in_order(), 1e-9 * double(flatten_nanoseconds_)};
  }

 private:
  using Faces = std::vector<std::uint32_t>;

  /// Says how far it is, one thread at a time and not all the time. True if it has to stop.
  bool poll() {
    if (stopped_ || !options_.progress) return stopped_;
    const std::unique_lock lock(report_mutex_, std::try_to_lock);
    const auto now = std::chrono::steady_clock::now();
    if (!lock || now - last_report_ < std::chrono::milliseconds(50)) return stopped_;
    last_report_ = now;
    const double fraction =
        double(faces_done_) / double(std::max<std::size_t>(1, surface_.face_count()));
    if (!options_.progress({0.9 * fraction, alive_})) stopped_ = true;
    return stopped_;
  }

  [[nodiscard]] std::vector<Faces> components() {
    std::vector<Faces> parts;
    std::vector<bool> reached(surface_.face_count(), false);
    for (std::uint32_t seed = 0; seed < surface_.face_count(); ++seed) {
      if (reached[seed]) continue;
      reached[seed] = true;
      Faces part{seed};
      for (std::size_t i = 0; i < part.size(); ++i) {
        for (std::uint32_t c = surface_.face_begin[part[i]]; c < surface_.face_begin[part[i] + 1];
             ++c) {
          if (surface_.corner_twin[c] == kNone) continue;
          const std::uint32_t other = surface_.corner_face[surface_.corner_twin[c]];
          if (reached[other]) continue;
          reached[other] = true;
          part.push_back(other);
        }
      }
      std::sort(part.begin(), part.end());
      parts.push_back(std::move(part));
    }
    return parts;
  }

  void give(const Faces& faces, std::uint32_t chart) {
    for (const std::uint32_t face : faces) owners_.chart[face] = chart;
  }

  static std::vector<Faces> divided(const Region& region, const Growth& growth) {
    std::vector<Faces> parts(1 + *std::max_element(growth.seed_of.begin(), growth.seed_of.end()));
    for (std::uint32_t i = 0; i < region.size(); ++i) {
      parts[growth.seed_of[i]].push_back(region.faces[i]);
    }
    return parts;
  }

  void grow_components() {
    std::vector<Faces> parts = components();
    for (std::uint32_t i = 0; i < parts.size(); ++i) give(parts[i], i);
    std::vector<std::vector<Faces>> grown(parts.size());
    parallel_for(parts.size(), thread_count(options_.threads), [&](std::size_t i) {
      if (poll()) return;
      const std::uint32_t count = first_charts(parts[i].size());
      if (count == 1) {
        grown[i].push_back(std::move(parts[i]));
        return;
      }
      const Region region =
          make_region(surface_, std::move(parts[i]), owners_, static_cast<std::uint32_t>(i));
      grown[i] = divided(region, grow_charts(surface_, region, shapes_, count, kGrowRounds));
    });
    for (auto& charts : grown) {
      for (Faces& faces : charts) pending_.push_back(std::move(faces));
    }
  }

  /// One wave: what is pending is tried, and split if it fails.
  void try_pending() {
    const std::size_t count = pending_.size();
    const auto first = static_cast<std::uint32_t>(drafts_.size());
    for (std::uint32_t i = 0; i < count; ++i) give(pending_[i], first + i);
    drafts_.resize(first + count);
    std::vector<std::vector<Faces>> parts(count);
    parallel_for(count, thread_count(options_.threads), [&](std::size_t i) {
      if (poll()) return;
      const auto chart = static_cast<std::uint32_t>(first + i);
      const Region region = make_region(surface_, std::move(pending_[i]), owners_, chart);
      Draft draft = try_region(region, {}, options_);
      if (draft.is_good || region.size() == 1) {
        ++alive_;
        faces_done_ += draft.faces.size();
        drafts_[chart] = std::move(draft);
      } else {
        parts[i] = divided(region, grow_charts(surface_, region, shapes_, 2, kSplitRounds));
      }
    });
    pending_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      for (Faces& faces : parts[i]) pending_.push_back(std::move(faces));
    }
  }

  Draft try_region(const Region& region, std::vector<std::uint32_t> seams,
                   const UnwrapOptions& options) {
    Draft draft = make_draft(surface_, region, shapes_, std::move(seams), options);
    flatten_nanoseconds_ += static_cast<std::int64_t>(1e9 * draft.flatten_seconds);
    return draft;
  }

  struct Border {
    std::uint32_t a, b;
    double length;
    double share = 0;  ///< of all that the one with less of it has in common with others
  };

  /// Pairs of neighbours, the largest share first.
  [[nodiscard]] std::vector<Border> borders() const {
    std::vector<Border> borders;
    for (std::uint32_t c = 0; c < surface_.corner_twin.size(); ++c) {
      const std::uint32_t t = surface_.corner_twin[c];
      if (t == kNone || t < c) continue;
      const std::uint32_t a = owners_.chart[surface_.corner_face[c]];
      const std::uint32_t b = owners_.chart[surface_.corner_face[t]];
      if (a == b) continue;
      const double size = length(surface_.points[surface_.corner_vertex[c]] -
                                 surface_.points[surface_.corner_vertex[t]]);
      borders.push_back({std::min(a, b), std::max(a, b), size, 0});
    }
    std::stable_sort(borders.begin(), borders.end(), [](const Border& x, const Border& y) {
      return x.a != y.a ? x.a < y.a : x.b < y.b;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < borders.size(); ++i) {
      if (kept > 0 && borders[kept - 1].a == borders[i].a && borders[kept - 1].b == borders[i].b) {
        borders[kept - 1].length += borders[i].length;
      } else {
        borders[kept++] = borders[i];
      }
    }
    borders.resize(kept);
    std::vector<double> round(drafts_.size(), 0);  // lengths of whole borders
    for (const Border& border : borders) {
      round[border.a] += border.length;
      round[border.b] += border.length;
    }
    for (Border& border : borders) {
      const double least = std::min(round[border.a], round[border.b]);
      border.share = least > 0 ? border.length / least : 0;
    }
    std::stable_sort(borders.begin(), borders.end(),
                     [](const Border& x, const Border& y) { return x.share > y.share; });
    return borders;
  }

  void merge(const UnwrapOptions& options) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> failed;
    while (!poll()) {
      std::vector<Border> wave;
      std::vector<bool> taken(drafts_.size(), false);
      for (const Border& border : borders()) {
        const std::pair pair{border.a, border.b};
        if (taken[border.a] || taken[border.b]) continue;
        if (failed.count(pair) > 0 || hopeless_.count(pair) > 0) continue;
        taken[border.a] = taken[border.b] = true;
        wave.push_back(border);
      }
      if (wave.empty() || enough_merged(options)) return;
      std::vector<Draft> unions(wave.size());
      parallel_for(wave.size(), thread_count(options_.threads), [&](std::size_t i) {
        if (!poll()) unions[i] = joined(wave[i], options);
      });
      if (stopped_) return;
      for (std::size_t i = 0; i < wave.size(); ++i) {
        if (enough_merged(options)) return;
        if (!unions[i].is_good) {
          (unions[i].uv.empty() ? hopeless_ : failed).insert({wave[i].a, wave[i].b});
          stretch_failed_ = stretch_failed_ || is_stretched(unions[i], options);
          continue;
        }
        drafts_[wave[i].a] = {};
        drafts_[wave[i].b] = {};
        give(unions[i].faces, static_cast<std::uint32_t>(drafts_.size()));
        drafts_.push_back(std::move(unions[i]));
        --alive_;
      }
    }
  }

  [[nodiscard]] bool enough_merged(const UnwrapOptions& options) const {
    return options.max_stretch > options_.max_stretch && alive_ <= options_.max_charts;
  }

  Draft joined(const Border& border, const UnwrapOptions& options) {
    Faces faces;
    std::merge(drafts_[border.a].faces.begin(), drafts_[border.a].faces.end(),
               drafts_[border.b].faces.begin(), drafts_[border.b].faces.end(),
               std::back_inserter(faces));
    std::vector<std::uint32_t> seams;
    std::merge(drafts_[border.a].seams.begin(), drafts_[border.a].seams.end(),
               drafts_[border.b].seams.begin(), drafts_[border.b].seams.end(),
               std::back_inserter(seams));
    const Region region = make_region(surface_, std::move(faces), owners_, border.a, border.b);
    return try_region(region, std::move(seams), options);
  }

  /// More stretch, step by step, until there are no more charts than asked for.
  void merge_beyond() {
    UnwrapOptions options = options_;
    constexpr double kFarthest = 1e3;
    while (alive_ > options_.max_charts && stretch_failed_ && options.max_stretch < kFarthest &&
           !stopped_) {
      stretch_failed_ = false;
      options.max_stretch *= 1.25;
      merge(options);
    }
  }

  std::vector<Draft> in_order() {
    std::vector<Draft> charts;
    for (Draft& draft : drafts_) {
      if (!draft.faces.empty()) charts.push_back(std::move(draft));
    }
    std::sort(charts.begin(), charts.end(),
              [](const Draft& a, const Draft& b) { return a.faces.front() < b.faces.front(); });
    return charts;
  }

  const Surface& surface_;
  const UnwrapOptions& options_;
  FaceShapes shapes_;
  FaceOwners owners_;
  std::vector<Faces> pending_;
  std::vector<Draft> drafts_;  // by the number in owners_.chart; without faces: split or merged
  /// Pairs whose union cannot be flattened at all, whatever stretch is allowed.
  std::set<std::pair<std::uint32_t, std::uint32_t>> hopeless_;
  bool stretch_failed_ = false;  // of the last merge: some union was stretched too much
  std::atomic<std::size_t> alive_ = 0, faces_done_ = 0;
  std::atomic<std::int64_t> flatten_nanoseconds_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex report_mutex_;
  std::chrono::steady_clock::time_point last_report_;
};

}  // namespace

Result<Segmentation> segment_surface(const Surface& surface, const UnwrapOptions& options) {
  return Segmenter(surface, options).run();
}

}  // namespace wrapatlas
