// A chart at one angle and the domain it lies in, as the guided packer sees them: runs of cells.
#pragma once

#include <cstdint>
#include <vector>

#include "pack/frame.h"
#include "raster/bits.h"
#include "raster/chart_raster.h"
#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// The cells that charts are placed on; opposite sides are one where an axis wraps.
struct Domain {
  int width = 0, height = 0;
  bool wraps_x = false, wraps_y = false;
};

/// Cells [begin, end) of one row of a piece.
struct PieceRun {
  std::int32_t row = 0, begin = 0, end = 0;
};

/// Longest run in Piece::spread: with the largest weight of a cell this bounds the cost of one run
/// (see field.h).
inline constexpr int kLongestRun = 128;

/// Translations are ruled out in blocks of kBlock x kBlock. The core of a piece are the cells that
/// it covers at all translations of a block, seen from the block's first; so what they cost is less
/// than what the piece costs anywhere in the block.
inline constexpr int kBlock = 4;

/// One chart at one angle and one scale.
struct Piece {
  int width = 0, height = 0;   ///< cells; 0: too long to be made
  std::int64_t cells = 0;      ///< covered
  double angle = 0;            ///< radians
  Vec2 offset;                 ///< chart point p lies at M p + offset, for cell (0,0) at the origin
  Vec2 centre;                 ///< where the chart's centre lies
  std::vector<PieceRun> runs;  ///< row by row
  std::vector<PieceRun> spread;  ///< the same cells, cut to kLongestRun, rows far apart first
  /// Some of the cells that the piece covers wherever in a block it is put (see kBlock), if they
  /// were asked for.
  std::vector<PieceRun> core;
};

/// The runs of rows of cells, row by row.
std::vector<PieceRun> runs_of(const BitLanes& rows);

/// Runs of the core of a piece with these cells, cut to kLongestRun, telling ones first, and no
/// more than are worth asking.
std::vector<PieceRun> core_of(const BitLanes& rows);

Domain domain_of(const Frame& frame, Wrap wrap);

/// The runs of a raster, without core.
Piece make_piece(const ChartRaster& raster);

/// Without spread and core; runs that most often are in the way come first.
Piece make_bare_piece(const ChartRaster& raster);

/// Can the piece lie in the domain at all: inside the sides that do not wrap, and not over itself
/// across those that do? kLongestInDomains bounds how often it may wind around them.
bool admits(const Domain& domain, const Piece& piece);

}  // namespace wrapatlas
