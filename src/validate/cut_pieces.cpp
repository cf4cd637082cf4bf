#include "validate/cut_pieces.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace wrapatlas::validate {
namespace {

/// UVs on both sides of a cut are the same number, but a text file may round them.
constexpr double kSameUv = 1e-6;

using Shift = std::array<std::int32_t, 2>;

struct Edge {
  std::uint32_t low, high;  ///< welded positions
  std::uint32_t piece;
  Vec2 at_low, at_high;  ///< UVs
  [[nodiscard]] auto ends() const { return std::tie(low, high); }
};

bool equal(double a, double b) { return std::abs(a - b) <= kSameUv; }

bool on_border(const Edge& edge) {
  for (const double side : {0.0, 1.0}) {
    if (equal(edge.at_low.x, side) && equal(edge.at_high.x, side)) return true;
    if (equal(edge.at_low.y, side) && equal(edge.at_high.y, side)) return true;
  }
  return false;
}

std::vector<Edge> edges_on_border(const Mesh& mesh, const FaceCharts& pieces) {
  const std::vector<std::uint32_t> welded = weld_positions(mesh.positions);
  std::vector<Edge> edges;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    if (pieces.of_face[face] == kNone) continue;
    const std::uint32_t begin = mesh.face_begin[face], size = mesh.face_size(face);
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = begin + i, b = begin + (i + 1) % size;
      Edge edge{welded[mesh.corner_position[a]], welded[mesh.corner_position[b]],
                pieces.of_face[face], mesh.texcoords[mesh.corner_texcoord[a]],
                mesh.texcoords[mesh.corner_texcoord[b]]};
      if (edge.low == edge.high || !on_border(edge)) continue;
      if (edge.low > edge.high) {
        std::swap(edge.low, edge.high);
        std::swap(edge.at_low, edge.at_high);
      }
      edges.push_back(edge);
    }
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Edge& a, const Edge& b) { return a.ends() < b.ends(); });
  return edges;
}

/// The whole periods by which b has to move to lie on a; {0, 0} if none do that.
Shift shift_onto(const Edge& a, const Edge& b) {
  const Vec2 way = a.at_low - b.at_low, other = a.at_high - b.at_high;
  const Vec2 whole{std::round(way.x), std::round(way.y)};
  const auto is_whole = [&](Vec2 d) { return equal(d.x, whole.x) && equal(d.y, whole.y); };
  const bool one_step = std::abs(whole.x) + std::abs(whole.y) == 1;
  if (!one_step || !is_whole(way) || !is_whole(other)) return {};
  return {static_cast<std::int32_t>(whole.x), static_cast<std::int32_t>(whole.y)};
}

struct Link {
  std::uint32_t from, to;
  Shift shift;  ///< of `to`, once `from` stays where it is
};

std::vector<Link> find_links(const std::vector<Edge>& edges) {
  std::vector<Link> links;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const Edge &a = edges[i - 1], &b = edges[i];
    if (a.ends() != b.ends() || a.piece == b.piece) continue;
    const Shift shift = shift_onto(a, b);
    if (shift == Shift{}) continue;
    links.push_back({a.piece, b.piece, shift});
    links.push_back({b.piece, a.piece, {-shift[0], -shift[1]}});
  }
  std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
    return std::tie(a.from, a.to, a.shift) < std::tie(b.from, b.to, b.shift);
  });
  return links;
}

}  // namespace

CutCharts join_cut_pieces(const Mesh& mesh, const FaceCharts& pieces) {
  const std::vector<Link> links = find_links(edges_on_border(mesh, pieces));
  std::vector<std::uint32_t> chart(pieces.count, kNone), open;
  std::vector<Shift> shift(pieces.count);
  CutCharts cut;
  for (std::uint32_t first = 0; first < pieces.count; ++first) {
    if (chart[first] != kNone) continue;
    chart[first] = cut.charts.count++;
    open.assign(1, first);
    while (!open.empty()) {
      const std::uint32_t piece = open.back();
      open.pop_back();
      const auto from = [](const Link& link, std::uint32_t p) { return link.from < p; };
      auto link = std::lower_bound(links.begin(), links.end(), piece, from);
      for (; link != links.end() && link->from == piece; ++link) {
        if (chart[link->to] != kNone) continue;
        chart[link->to] = chart[first];
        shift[link->to] = {shift[piece][0] + link->shift[0], shift[piece][1] + link->shift[1]};
        open.push_back(link->to);
      }
    }
  }
  cut.charts.of_face.assign(mesh.face_count(), kNone);
  cut.face_shift.assign(mesh.face_count(), {});
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t piece = pieces.of_face[face];
    if (piece == kNone) continue;
    cut.charts.of_face[face] = chart[piece];
    cut.face_shift[face] = shift[piece];
  }
  return cut;
}

}  // namespace wrapatlas::validate
