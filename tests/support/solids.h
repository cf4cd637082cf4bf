// Meshes without UVs, for tests: closed and open, of any genus, whole and broken.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas::test {

using Face = std::vector<std::uint32_t>;

inline Mesh bare_mesh(std::vector<Vec3> positions, const std::vector<Face>& faces) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  for (const Face& face : faces) {
    mesh.corner_position.insert(mesh.corner_position.end(), face.begin(), face.end());
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
  }
  mesh.corner_texcoord.assign(mesh.corner_position.size(), kNone);
  return mesh;
}

/// A grid of columns x rows quads, each cut in two or whole, at point(i / columns, j / rows). Sides
/// that `joins` are one: [0] left and right, [1] bottom and top.
inline Mesh grid_mesh(std::uint32_t columns, std::uint32_t rows, std::array<bool, 2> joins,
                      bool quads, const std::function<Vec3(double, double)>& point) {
  const std::uint32_t across = joins[0] ? columns : columns + 1;
  const std::uint32_t up = joins[1] ? rows : rows + 1;
  std::vector<Vec3> positions;
  for (std::uint32_t j = 0; j < up; ++j) {
    for (std::uint32_t i = 0; i < across; ++i) {
      positions.push_back(point(double(i) / columns, double(j) / rows));
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return (j % up) * across + i % across; };
  std::vector<Face> faces;
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (quads) {
        faces.push_back({a, b, c, d});
      } else {
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
      }
    }
  }
  return bare_mesh(std::move(positions), faces);
}

inline Mesh sheet(std::uint32_t n, bool quads = false) {
  return grid_mesh(n, n, {false, false}, quads, [](double u, double v) { return Vec3{u, v, 0}; });
}

inline Mesh torus(std::uint32_t n, double thickness = 0.3, bool quads = false) {
  return grid_mesh(2 * n, n, {true, true}, quads, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
    const double r = 1 + thickness * std::cos(b);
    return Vec3{r * std::cos(a), r * std::sin(a), thickness * std::sin(b)};
  });
}

inline Mesh tube(std::uint32_t n, double height, bool quads = false) {
  return grid_mesh(2 * n, n, {true, false}, quads, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return Vec3{std::cos(a), std::sin(a), height * v};
  });
}

/// A sphere of rings with a pole at either end, drawn out to `height` times its width.
inline Mesh ball(std::uint32_t n, double height = 1) {
  const std::uint32_t around = 2 * n;
  std::vector<Vec3> positions{{0, 0, -height}, {0, 0, height}};
  std::vector<Face> faces;
  const auto at = [&](std::uint32_t ring, std::uint32_t i) {
    return 2 + (ring - 1) * around + i % around;
  };
  for (std::uint32_t ring = 1; ring < n; ++ring) {
    const double a = std::numbers::pi * (double(ring) / n - 0.5);
    for (std::uint32_t i = 0; i < around; ++i) {
      const double b = 2 * std::numbers::pi * i / around;
      positions.push_back(
          {std::cos(a) * std::cos(b), std::cos(a) * std::sin(b), height * std::sin(a)});
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    faces.push_back({0, at(1, i + 1), at(1, i)});
    faces.push_back({1, at(n - 1, i), at(n - 1, i + 1)});
    for (std::uint32_t ring = 1; ring + 1 < n; ++ring) {
      faces.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
      faces.push_back({at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
    }
  }
  return bare_mesh(std::move(positions), faces);
}

inline Mesh moebius(std::uint32_t n) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(a / 2);
      positions.push_back({r * std::cos(a), r * std::sin(a), side * std::sin(a / 2)});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool turn = i + 1 == n;
    const std::uint32_t next = (i + 1) % n;
    faces.push_back({2 * i, 2 * i + 1, 2 * next + (turn ? 0U : 1U), 2 * next + (turn ? 1U : 0U)});
  }
  return bare_mesh(std::move(positions), faces);
}

/// Both meshes in one, not joined but where positions agree.
inline Mesh both(Mesh a, const Mesh& b) {
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  const std::uint32_t corners = a.face_begin.back();
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const std::uint32_t p : b.corner_position) a.corner_position.push_back(first + p);
  for (std::size_t f = 1; f < b.face_begin.size(); ++f) {
    a.face_begin.push_back(corners + b.face_begin[f]);
  }
  a.corner_texcoord.assign(a.corner_position.size(), kNone);
  return a;
}

inline Mesh moved(Mesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.positions) p = p + by;
  return mesh;
}

/// Every `step`th face with its corners in the opposite order.
inline Mesh with_turned_faces(Mesh mesh, std::size_t step) {
  for (std::size_t f = 0; f < mesh.face_count(); f += step) {
    std::reverse(mesh.corner_position.begin() + mesh.face_begin[f],
                 mesh.corner_position.begin() + mesh.face_begin[f + 1]);
  }
  return mesh;
}

}  // namespace wrapatlas::test
