#include "guided/piece.h"

#include <algorithm>
#include <array>

#include "guided/wrapped.h"

namespace wrapatlas {
namespace {

/// Numbers 0 ... count - 1 so that any first few of them lie far apart: the van der Corput order.
std::vector<int> spread_order(int count) {
  int bits = 0;
  while ((1 << bits) < count) ++bits;
  std::vector<int> order;
  order.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < (1 << bits); ++i) {
    int reversed = 0;
    for (int bit = 0; bit < bits; ++bit) reversed |= ((i >> bit) & 1) << (bits - 1 - bit);
    if (reversed < count) order.push_back(reversed);
  }
  return order;
}

/// Adds a run, cut to kLongestRun.
void add_cut(std::vector<PieceRun>& runs, const PieceRun& run) {
  for (int begin = run.begin; begin < run.end; begin += kLongestRun) {
    runs.push_back({run.row, begin, std::min(begin + kLongestRun, run.end)});
  }
}

/// With its runs, row by row.
Piece piece_of(const ChartRaster& raster) {
  Piece piece;
  piece.width = raster.width;
  piece.height = raster.height;
  piece.cells = raster.cells;
  piece.angle = raster.angle;
  piece.offset = raster.offset;
  piece.centre = raster.centre;
  if (raster.width > 0) piece.runs = runs_of(*raster.unturned);  // a new raster is not turned
  return piece;
}

constexpr int kBands = 12;  ///< of rows

/// Moves some long runs that lie far apart to the front, the longest of each band of rows: most
/// often one of them is in the way.
void lead_with_telling_runs(std::vector<PieceRun>& runs) {
  if (runs.empty()) return;
  const auto [first, last] = std::minmax_element(
      runs.begin(), runs.end(), [](const PieceRun& a, const PieceRun& b) { return a.row < b.row; });
  const int first_row = first->row, rows = last->row - first_row + 1;
  std::array<std::size_t, kBands> longest;
  longest.fill(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::size_t& best =
        longest[static_cast<std::size_t>(kBands * (runs[i].row - first_row) / rows)];
    const bool is_first = best == runs.size();
    if (is_first || runs[i].end - runs[i].begin > runs[best].end - runs[best].begin) best = i;
  }
  std::size_t front = 0;
  for (const int band : spread_order(kBands)) {
    const std::size_t at = longest[static_cast<std::size_t>(band)];
    if (at == runs.size()) continue;
    std::swap(runs[front], runs[at]);
    // What stood in front may be another band's.
    std::replace(longest.begin(), longest.end(), front, at);
    ++front;
  }
}

}  // namespace

std::vector<PieceRun> runs_of(const BitLanes& rows) {
  std::vector<PieceRun> runs;
  for (int y = 0; y < rows.lanes; ++y) {
    for_each_run(rows.lane(y), rows.length, [&](int begin, int end) {
      runs.push_back({y, begin, end});
    });
  }
  return runs;
}

std::vector<PieceRun> core_of(const BitLanes& rows) {
  BitLanes core = rows;
  for (int y = rows.lanes - 1; y >= 0; --y) {
    std::uint64_t* lane = core.lane(y);
    for (int word = rows.words - 1; word >= 0; --word) {
      for (int dy = 1; dy < kBlock; ++dy) {
        lane[word] = y >= dy ? lane[word] & rows.lane(y - dy)[word] : 0;
      }
    }
    for (int word = rows.words - 1; word >= 0; --word) {
      const std::uint64_t here = lane[word], before = word > 0 ? lane[word - 1] : 0;
      for (int dx = 1; dx < kBlock; ++dx) {
        lane[word] &= here << dx | before >> (kWordBits - dx);
      }
    }
  }
  std::vector<PieceRun> runs;
  for (const PieceRun& run : runs_of(core)) add_cut(runs, run);
  lead_with_telling_runs(runs);
  if (runs.size() > kBands) runs.resize(kBands);
  return runs;
}

Piece make_bare_piece(const ChartRaster& raster) {
  Piece piece = piece_of(raster);
  lead_with_telling_runs(piece.runs);
  return piece;
}

Piece make_piece(const ChartRaster& raster) {
  Piece piece = piece_of(raster);
  if (raster.width == 0) return piece;
  const BitLanes& rows = *raster.unturned;
  std::vector<std::size_t> row_begin(static_cast<std::size_t>(rows.lanes) + 1, piece.runs.size());
  for (std::size_t i = piece.runs.size(); i-- > 0;) {
    row_begin[static_cast<std::size_t>(piece.runs[i].row)] = i;
  }
  for (std::size_t y = row_begin.size() - 1; y-- > 0;) {
    row_begin[y] = std::min(row_begin[y], row_begin[y + 1]);
  }
  for (const int y : spread_order(rows.lanes)) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = row_begin[row]; i < row_begin[row + 1]; ++i) {
      add_cut(piece.spread, piece.runs[i]);
    }
  }
  lead_with_telling_runs(piece.spread);
  return piece;
}

namespace {

/// Sets bits [begin, end) of a lane, unless one is set already.
bool claim_span(std::uint64_t* lane, int begin, int end) {
  if (next_set(lane, end, begin) < end) return false;
  set_span(lane, begin, end);
  return true;
}

}  // namespace

Domain domain_of(const Frame& frame, Wrap wrap) {
  return {frame.width, frame.height, wraps_u(wrap), wraps_v(wrap)};
}

bool admits(const Domain& domain, const Piece& piece) {
  if (piece.width == 0) return false;
  const bool wide = piece.width > domain.width, high = piece.height > domain.height;
  if (!wide && !high) return true;
  if ((wide && !domain.wraps_x) || (high && !domain.wraps_y)) return false;
  const int longest = kLongestInDomains * std::max(domain.width, domain.height);
  if (std::max(piece.width, piece.height) > longest) return false;
  thread_local BitLanes covered;
  covered.lanes = domain.height;
  covered.length = domain.width;
  covered.words = words_for(domain.width);
  covered.bits.assign(
      static_cast<std::size_t>(covered.lanes) * static_cast<std::size_t>(covered.words), 0);
  for (const PieceRun& run : piece.runs) {
    std::uint64_t* lane = covered.lane(run.row % domain.height);
    bool free = true;
    for_each_part(run.begin, run.end, domain.width,
                  [&](int from, int to) { free = free && claim_span(lane, from, to); });
    if (!free) return false;
  }
  return true;
}

}  // namespace wrapatlas
