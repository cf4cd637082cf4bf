// Lindstrom & Turk 1998: edges in the order of their cost, to an eighth, each collapsed to the
// point that placement.h says; costs of all edges that the new triangles touch are found anew.
#include "wrapatlas/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "simplify/collapse_mesh.h"
#include "simplify/creases.h"
#include "simplify/edge_queue.h"
#include "simplify/patch_geometry.h"
#include "simplify/placement.h"
#include "simplify/surface_triangles.h"
#include "simplify/uv_wedges.h"

namespace wrapatlas {
namespace {

constexpr std::uint32_t kStepsBetweenReports = 1024;

/// A power of two that brings all coordinates to about 1: exact, and no product overflows.
double scale_of(const std::vector<Vec3>& points) {
  double largest = 0;
  for (const Vec3& p : points) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return largest > 0 ? std::exp2(-std::clamp(std::ilogb(largest), -1022, 1022)) : 1;
}

class Simplifier {
 public:
  Simplifier(const SurfaceTriangles& triangles, const Surface& surface,
             const SimplifyOptions& options)
      : triangles_(triangles),
        surface_(surface),
        options_(options),
        scale_(scale_of(surface.points)),
        mesh_(surface),
        geometry_(mesh_, surface.points, scale_),
        creases_(triangles.mesh, surface, mesh_, options.keep_uv_seams),
        queue_(mesh_.edge_numbers()),
        priced_(mesh_.edge_numbers(), 0),
        changed_(mesh_.vertex_numbers(), 0),
        put_off_(mesh_.vertex_numbers(), 0) {
    if (options.keep_uv_seams) wedges_.emplace(triangles.mesh, surface, mesh_, creases_);
    report_.surface = surface.report;
    report_.dropped_faces = triangles.dropped;
    report_.faces_before = mesh_.face_count();
    report_.fixed_vertices = creases_.fixed_count();
    report_.volume_before = volume();
  }

  /// False: stopped by the caller.
  bool run() {
    const bool enough = mesh_.face_count() <= options_.target_faces;
    for (std::uint32_t e = 0; e < mesh_.edge_numbers() && !enough; ++e) price(e);
    for (std::uint32_t step = 0; mesh_.face_count() > options_.target_faces; ++step) {
      if (step % kStepsBetweenReports == 0 && !go_on()) return false;
      if (queue_.empty()) bring_back_all();
      if (queue_.empty()) break;
      collapse_cheapest();
    }
    report_.faces_after = mesh_.face_count();
    report_.volume_after = volume();
    return true;
  }

  Simplification result() {
    Simplification made;
    made.report = report_;
    std::vector<std::uint32_t> place(mesh_.vertex_numbers(), kNone);
    std::vector<std::uint32_t> texcoord(wedges_ ? wedges_->count() : 0, kNone);
    for (const std::uint32_t f : faces_left()) {
      for (std::uint32_t c = 3 * f; c < 3 * f + 3; ++c) add_corner(c, place, texcoord, made.mesh);
      made.mesh.face_begin.push_back(static_cast<std::uint32_t>(made.mesh.corner_position.size()));
      const std::uint32_t source = surface_.face_source[f];
      made.face_source.push_back(triangles_.source[source]);
      const std::vector<std::uint32_t>& objects = triangles_.mesh.face_object;
      if (!objects.empty()) made.mesh.face_object.push_back(objects[source]);
    }
    return made;
  }

 private:
  /// As they are in the mesh given.
  [[nodiscard]] std::vector<std::uint32_t> faces_left() const {
    std::vector<std::uint32_t> faces;
    faces.reserve(mesh_.face_count());
    for (std::uint32_t f = 0; f < mesh_.face_numbers(); ++f) {
      if (mesh_.has_face(f)) faces.push_back(f);
    }
    const auto source = [&](std::uint32_t f) { return triangles_.source[surface_.face_source[f]]; };
    std::sort(faces.begin(), faces.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(source(a), a) < std::pair(source(b), b);
    });
    return faces;
  }

  [[nodiscard]] double volume() const { return geometry_.volume() / scale_ / scale_ / scale_; }

  [[nodiscard]] bool go_on() const {
    if (!options_.progress) return true;
    const double all = report_.faces_before - options_.target_faces;
    return options_.progress(
        {(report_.faces_before - mesh_.face_count()) / all, mesh_.face_count()});
  }

  [[nodiscard]] EdgePlacement placed(std::uint32_t c) const {
    const bool on_seam = creases_.is_on_seam(mesh_.vertex(c));
    return place(mesh_, geometry_, c,
                 on_seam ? creases_.is_seam() : std::span<const std::uint8_t>());
  }

  [[nodiscard]] bool is_stale(std::uint32_t edge, std::uint32_t c) const {
    const std::uint32_t a = mesh_.vertex(c), b = mesh_.vertex(CollapseMesh::next(c));
    return std::max(changed_[a], changed_[b]) > priced_[edge];
  }

  void put_off(std::uint32_t edge, std::uint32_t c) {
    queue_.remove(edge);
    ++report_.refused;
    for (const std::uint32_t corner : {c, CollapseMesh::next(c)}) {
      std::uint32_t& changes = put_off_[mesh_.vertex(corner)];
      changes = std::max(changes, 1U);
    }
  }

  void price(std::uint32_t edge) {
    const std::uint32_t c = mesh_.corner_of_edge(edge);
    priced_[edge] = collapses_;
    if (creases_.allow(mesh_, c)) {
      queue_.set(edge, placed(c).cost);
    } else {
      queue_.remove(edge);
    }
  }

  /// Or takes its edge out of the queue, until something near it changes; or finds its cost anew.
  void collapse_cheapest() {
    const std::uint32_t edge = queue_.top(), c = mesh_.corner_of_edge(edge);
    if (is_stale(edge, c)) return price(edge);
    const Vec3 point = placed(c).point;
    if (!may_collapse(c, point)) return put_off(edge, c);
    const std::uint32_t kept = mesh_.vertex(c);
    creases_.before_collapse(mesh_, c);
    geometry_.before_collapse(c);
    if (wedges_) wedges_->apply(mesh_, c);
    for (const std::uint32_t gone : mesh_.collapse(c)) {
      if (gone != kNone) queue_.remove(gone);
    }
    geometry_.move(kept, point);
    price_around(kept);
  }

  [[nodiscard]] bool may_collapse(std::uint32_t c, const Vec3& point) {
    return !creases_.closes_chart(mesh_, c) && !geometry_.spoils_triangle(c, point) &&
           mesh_.can_collapse(c) &&
           (!wedges_ || wedges_->prepare(mesh_, geometry_, creases_, c, point));
  }

  /// The edges of the vertex and those across from it at once; others, of which one end's triangles
  /// have changed, when they become the cheapest.
  void price_around(std::uint32_t v) {
    ++collapses_;
    mesh_.each_corner(v, [&](std::uint32_t c) { price(mesh_.edge(CollapseMesh::next(c))); });
    mesh_.each_edge(v, [&](std::uint32_t u, std::uint32_t c) {
      price(mesh_.edge(c));
      changed_[u] = collapses_;
    });
    put_off_[v] = 0;
    mesh_.each_edge(v, [&](std::uint32_t u, std::uint32_t) { bring_back_around(u); });
  }

  /// Edges that were refused, as something near them has changed. Those of a hub once a quarter of
  /// its triangles have.
  void bring_back_around(std::uint32_t v) {
    if (put_off_[v] == 0) return;
    const std::uint32_t changes = put_off_[v]++;
    const Star& star = geometry_.star(v);
    if (star.is_hub() && changes < star.faces / 4) return;
    put_off_[v] = 0;
    mesh_.each_edge(v, [&](std::uint32_t, std::uint32_t c) {
      if (!queue_.has(mesh_.edge(c))) price(mesh_.edge(c));
    });
  }

  /// Those that still wait for more changes at a hub.
  void bring_back_all() {
    for (std::uint32_t e = 0; e < mesh_.edge_numbers(); ++e) {
      const std::uint32_t c = mesh_.corner_of_edge(e);
      if (c == kNone) continue;
      const auto waits = [&](std::uint32_t corner) { return put_off_[mesh_.vertex(corner)] > 1; };
      if (waits(c) || waits(CollapseMesh::next(c))) price(e);
    }
    for (std::uint32_t& changes : put_off_) changes = std::min(changes, 1U);
  }

  void add_corner(std::uint32_t c, std::vector<std::uint32_t>& place,
                  std::vector<std::uint32_t>& texcoord, Mesh& mesh) const {
    const std::uint32_t v = creases_.first_at_point(mesh_.vertex(c));
    if (place[v] == kNone) {
      place[v] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(1 / scale_ * geometry_.position(v));
    }
    mesh.corner_position.push_back(place[v]);
    const std::uint32_t wedge = wedges_ ? wedges_->wedge(c) : kNone;
    if (wedge == kNone) {
      mesh.corner_texcoord.push_back(kNone);
      return;
    }
    if (texcoord[wedge] == kNone) {
      texcoord[wedge] = static_cast<std::uint32_t>(mesh.texcoords.size());
      mesh.texcoords.push_back(wedges_->uv(wedge));
    }
    mesh.corner_texcoord.push_back(texcoord[wedge]);
  }

  const SurfaceTriangles& triangles_;
  const Surface& surface_;
  const SimplifyOptions& options_;
  double scale_;
  CollapseMesh mesh_;
  PatchGeometry geometry_;
  Creases creases_;
  EdgeQueue queue_;
  std::optional<UvWedges> wedges_;
  std::uint32_t collapses_ = 0;
  std::vector<std::uint32_t> priced_;   ///< per edge: after so many collapses
  std::vector<std::uint32_t> changed_;  ///< per vertex: its triangles, by that collapse
  std::vector<std::uint32_t> put_off_;  ///< per vertex: 0, or an edge was; 1 + changes since
  SimplifyReport report_;
};

}  // namespace

Result<Simplification> simplify(const Mesh& mesh, const SimplifyOptions& options) {
  const SurfaceTriangles triangles = surface_triangles(mesh);
  if (triangles.source.empty()) {
    return Error{ErrorKind::input, "", "no face has three points", "export the mesh again"};
  }
  const Result<Surface> surface = build_surface(triangles.mesh);
  if (!surface) return surface.error();
  Simplifier simplifier(triangles, *surface, options);
  if (!simplifier.run()) return Error{ErrorKind::interrupted, "", "stopped before the end", ""};
  return simplifier.result();
}

}  // namespace wrapatlas
