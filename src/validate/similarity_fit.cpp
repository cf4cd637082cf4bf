#include "validate/similarity_fit.h"

#include <algorithm>
#include <span>
#include <tuple>

namespace wrapatlas::validate {
namespace {

/// p -> factor * p + (to - factor * from) in complex numbers; of the conjugates when mirrored.
struct Fit {
  Vec2 factor, from, to;
  bool mirrored = false;
  double spread_from = 0, spread_to = 0;  ///< sums of squared distances from the middle
  double count = 0;

  [[nodiscard]] Vec2 apply(Vec2 p) const {
    Vec2 d = p - from;
    if (mirrored) d.y = -d.y;
    return to + Vec2{factor.x * d.x - factor.y * d.y, factor.x * d.y + factor.y * d.x};
  }
};

struct Match {
  Vec2 uv, texel;
  double doubt;
  bool original;
  std::uint32_t face;
};

struct Piece {
  std::uint32_t chart, piece;
  std::vector<std::uint32_t> faces;
  double weight = 0;
  std::array<std::int32_t, 2> shift{};
};

enum class Use { originals, all_sure };

Fit fit(const std::vector<Match>& matches, bool mirrored, Use use) {
  const auto skip = [use](const Match& m) {
    return use == Use::originals ? !m.original : std::isinf(m.doubt);
  };
  Fit result;
  result.mirrored = mirrored;
  for (const Match& m : matches) {
    if (skip(m)) continue;
    result.from = result.from + m.uv;
    result.to = result.to + m.texel;
    ++result.count;
  }
  if (result.count == 0) return result;
  result.from = (1 / result.count) * result.from;
  result.to = (1 / result.count) * result.to;
  Vec2 sum;
  for (const Match& m : matches) {
    if (skip(m)) continue;
    Vec2 p = m.uv - result.from;
    if (mirrored) p.y = -p.y;
    const Vec2 q = m.texel - result.to;
    sum = sum + Vec2{dot(p, q), cross(p, q)};  // conj(p) * q
    result.spread_from += dot(p, p);
    result.spread_to += dot(q, q);
  }
  if (result.spread_from > 0) result.factor = (1 / result.spread_from) * sum;
  return result;
}

struct Residual {
  double worst = 0;      // beyond what rounding allows
  double originals = 0;  // of corners of the reference, as it is
  std::uint32_t face = kNone;
};

/// The largest distance from where the fit puts a corner, less what rounding may have moved it.
Residual residual(const Fit& fit, const std::vector<Match>& matches, double rounding) {
  Residual result;
  const double scale = length(fit.factor);
  for (const Match& m : matches) {
    if (std::isinf(m.doubt)) continue;
    const double off = length(m.texel - fit.apply(m.uv));
    // A least-squares fit shares errors of size r out; three r are more than it can make of them.
    if (m.original) result.originals = std::max(result.originals, off);
    const double beyond = off - 3 * rounding - m.doubt * scale;
    if (beyond > result.worst || result.face == kNone) {
      result.worst = std::max(beyond, 0.0);
      result.face = m.face;
    }
  }
  return result;
}

class ChartFitter {
 public:
  explicit ChartFitter(const FitInput& input) : in_(input) {}

  ChartFit operator()(std::span<Piece> pieces, double rounding) {
    // The largest piece says where the others would be, which is known up to whole periods.
    const auto largest =
        std::max_element(pieces.begin(), pieces.end(),
                         [](const Piece& a, const Piece& b) { return a.weight < b.weight; });
    std::iter_swap(pieces.begin(), largest);
    // Where even that one has no two corners that are known, no piece tells where another belongs.
    if (!(pieces[0].weight > 0)) pieces = pieces.first(1);
    Fit direct, mirrored;
    for (const bool flip : {false, true}) {
      Fit& found = flip ? mirrored : direct;
      collect(pieces.first(1));
      if (pieces.size() > 1) {
        found = fit(matches_, flip, Use::all_sure);
        for (int round = 0; round < 2; ++round) {
          settle(pieces.subspan(1), found);
          collect(pieces);
          found = fit(matches_, flip, Use::all_sure);
        }
      }
      found = fit(matches_, flip, Use::originals);
    }
    return judge(pieces, direct, mirrored, rounding);
  }

 private:
  void collect(std::span<const Piece> pieces) {
    matches_.clear();
    for (const Piece& piece : pieces) {
      const Vec2 shift{piece.shift[0] * in_.size.x, piece.shift[1] * in_.size.y};
      for (const std::uint32_t face : piece.faces) {
        for (std::uint32_t c = in_.atlas.face_begin[face]; c < in_.atlas.face_begin[face + 1];
             ++c) {
          const FaceMatch::Corner& corner = in_.match.corners[c];
          const Vec2 uv = in_.atlas.texcoords[in_.atlas.corner_texcoord[c]];
          const Vec2 texel = Vec2{uv.x * in_.size.x, uv.y * in_.size.y} + shift;
          matches_.push_back({corner.uv, texel, corner.doubt, corner.original, face});
        }
      }
    }
  }

  void settle(std::span<Piece> pieces, const Fit& known) {
    for (Piece& piece : pieces) {
      piece.shift = {};
      collect(std::span<const Piece>(&piece, 1));
      Vec2 sum;
      double count = 0;
      const bool any_sure = std::any_of(matches_.begin(), matches_.end(),
                                        [](const Match& m) { return !std::isinf(m.doubt); });
      for (const Match& m : matches_) {
        if (any_sure && std::isinf(m.doubt)) continue;
        sum = sum + (known.apply(m.uv) - m.texel);
        ++count;
      }
      const auto periods = [&](double way, double period, bool may) {
        const double whole = std::round(way / count / period);
        return may && std::abs(whole) < 1e6 ? static_cast<std::int32_t>(whole) : 0;
      };
      piece.shift = {periods(sum.x, in_.size.x, in_.may_shift[0]),
                     periods(sum.y, in_.size.y, in_.may_shift[1])};
    }
  }

  ChartFit judge(std::span<Piece> pieces, const Fit& direct, const Fit& mirrored, double rounding) {
    if (pieces.size() > 1) settle(pieces.subspan(1), direct);
    collect(pieces);
    const Residual of_direct = residual(direct, matches_, rounding);
    ChartFit result;
    result.residual = of_direct.worst;
    result.worst_face = of_direct.face;
    result.weight = direct.spread_from;
    result.middle = direct.from;
    result.placed_middle = direct.to;
    result.factor = direct.factor;
    result.untold = !(direct.spread_from > 0) &&
                    std::any_of(matches_.begin(), matches_.end(),
                                [](const Match& m) { return std::isinf(m.doubt); });
    const Fit* chosen = &direct;
    double off = of_direct.originals;
    if (of_direct.worst > in_.tolerance) {
      result.verdict = ChartFit::Verdict::distorted;
      if (pieces.size() > 1) settle(pieces.subspan(1), mirrored);
      collect(pieces);
      const Residual of_mirrored = residual(mirrored, matches_, rounding);
      if (of_mirrored.worst <= in_.tolerance || of_mirrored.worst < 0.1 * of_direct.worst) {
        result.verdict = ChartFit::Verdict::mirrored;
        chosen = &mirrored;
        off = of_mirrored.originals;
      } else if (pieces.size() > 1) {
        settle(pieces.subspan(1), direct);
      }
    }
    result.scale = length(chosen->factor);
    if (chosen->spread_to > 0) {
      result.scale_doubt = (rounding + off) / std::sqrt(chosen->spread_to / chosen->count);
    }
    return result;
  }

  const FitInput& in_;
  std::vector<Match> matches_;
};

/// Half of the weight has a smaller scale, half a larger one: no single chart can pull it away.
void find_common_scale(Fits& fits) {
  for (const bool only_similar : {true, false}) {
    std::vector<const ChartFit*> ordered;
    double total = 0;
    for (const ChartFit& chart : fits.charts) {
      if (only_similar && chart.verdict != ChartFit::Verdict::similar) continue;
      if (!(chart.scale > 0)) continue;
      ordered.push_back(&chart);
      total += chart.weight;
    }
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const ChartFit* a, const ChartFit* b) { return a->scale < b->scale; });
    double below = 0;
    for (const ChartFit* chart : ordered) {
      below += chart->weight;
      if (below < 0.5 * total) continue;
      fits.scale = chart->scale;
      fits.scale_doubt = chart->scale_doubt;
      return;
    }
  }
}

std::vector<Piece> pieces_of(const FitInput& in) {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < in.atlas.face_count(); ++f) {
    if (in.face_chart[f] < in.charts) faces.push_back(f);
  }
  const auto key = [&](std::uint32_t f) {
    return std::tuple(in.face_chart[f], in.face_piece[f], f);
  };
  std::sort(faces.begin(), faces.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<Piece> pieces;
  for (const std::uint32_t f : faces) {
    if (pieces.empty() || pieces.back().chart != in.face_chart[f] ||
        pieces.back().piece != in.face_piece[f]) {
      pieces.push_back({in.face_chart[f], in.face_piece[f], {}, 0, {}});
    }
    pieces.back().faces.push_back(f);
  }
  for (Piece& piece : pieces) {  // by the extent of the corners that a fit can use
    Box2 box;
    for (const std::uint32_t f : piece.faces) {
      for (std::uint32_t c = in.atlas.face_begin[f]; c < in.atlas.face_begin[f + 1]; ++c) {
        const FaceMatch::Corner& corner = in.match.corners[c];
        if (!std::isinf(corner.doubt)) box.add(corner.uv);
      }
    }
    piece.weight = box.empty() ? -1 : length(box.size());
  }
  return pieces;
}

}  // namespace

Fits fit_charts(const FitInput& input) {
  Fits fits;
  fits.charts.resize(input.charts);
  fits.face_shift.assign(input.atlas.face_count(), {0, 0});
  std::vector<Piece> pieces = pieces_of(input);
  ChartFitter fitter(input);
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    const std::uint32_t chart = pieces[begin].chart;
    while (end < pieces.size() && pieces[end].chart == chart) ++end;
    const std::span<Piece> own(pieces.data() + begin, end - begin);
    fits.charts[chart] = fitter(own, input.rounding[chart]);
    for (const Piece& piece : own) {
      for (const std::uint32_t face : piece.faces) fits.face_shift[face] = piece.shift;
    }
  }
  find_common_scale(fits);
  return fits;
}

}  // namespace wrapatlas::validate
