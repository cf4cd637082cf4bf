#include "io_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

#include "io/file.h"
#include "wrapatlas/geometry.h"

namespace wrapatlas::bench {
namespace {

constexpr int kPatch = Sheet::kPatch;

Vec3 position_at(int x, int y) {
  return {0.01 * x, 0.01 * y, 0.2 * std::sin(0.13 * x) * std::cos(0.07 * y)};
}

/// Patches stand in a row of cells, a little apart.
Vec2 texcoord_at(const Sheet& sheet, int column, int row, int x, int y) {
  const double cell = 1.0 / std::max(sheet.columns, sheet.rows);
  return {(column + 0.05 + 0.9 * x / kPatch) * cell, (row + 0.05 + 0.9 * y / kPatch) * cell};
}

template <typename Visit>
void for_each_patch(const Sheet& sheet, Visit visit) {
  for (int row = 0; row < sheet.rows; ++row) {
    for (int column = 0; column < sheet.columns; ++column) visit(column, row);
  }
}

/// Calls visit(x, y) for the three corners of each triangle of a patch, in order.
template <typename Visit>
void for_each_corner(Visit visit) {
  constexpr std::array<std::array<int, 2>, 6> kCorners{
      {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}};
  for (int y = 0; y < kPatch; ++y) {
    for (int x = 0; x < kPatch; ++x) {
      for (const auto& [dx, dy] : kCorners) visit(x + dx, y + dy);
    }
  }
}

template <typename T>
void append_bytes(std::string& out, T value) {
  std::array<char, sizeof(T)> bytes{};
  std::copy_n(reinterpret_cast<const char*>(&value), sizeof(T), bytes.begin());
  out.append(bytes.data(), bytes.size());
}

}  // namespace

Sheet sheet_of(int triangles) {
  const double patches = triangles / (2.0 * kPatch * kPatch);
  Sheet sheet;
  sheet.columns = std::max(1, static_cast<int>(std::lround(std::sqrt(2 * patches))));
  sheet.rows = std::max(1, static_cast<int>(std::lround(patches / sheet.columns)));
  return sheet;
}

Status write_sheet_obj(const Sheet& sheet, const std::filesystem::path& path) {
  std::string out = "# wrapatlas_bench\n";
  const auto add = std::back_inserter(out);
  const int width = sheet.columns * kPatch + 1;
  for (int y = 0; y <= sheet.rows * kPatch; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vec3 p = position_at(x, y);
      fmt::format_to(add, "v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
    }
  }
  for_each_patch(sheet, [&](int column, int row) {
    for (int y = 0; y <= kPatch; ++y) {
      for (int x = 0; x <= kPatch; ++x) {
        const Vec2 uv = texcoord_at(sheet, column, row, x, y);
        fmt::format_to(add, "vt {:.6f} {:.6f}\n", uv.x, uv.y);
      }
    }
  });
  int first_uv = 1, corner = 0;
  for_each_patch(sheet, [&](int column, int row) {
    for_each_corner([&](int x, int y) {
      const int v = (row * kPatch + y) * width + column * kPatch + x + 1;
      const int vt = first_uv + y * (kPatch + 1) + x;
      fmt::format_to(add, "{}{}/{}{}", corner == 0 ? "f " : " ", v, vt, corner == 2 ? "\n" : "");
      corner = (corner + 1) % 3;
    });
    first_uv += (kPatch + 1) * (kPatch + 1);
  });
  return write_file(path, out);
}

Status write_sheet_glb(const Sheet& sheet, const std::filesystem::path& path) {
  std::string binary;
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  for_each_patch(sheet, [&](int column, int row) {
    for (int y = 0; y <= kPatch; ++y) {
      for (int x = 0; x <= kPatch; ++x) {
        Vec3 p = position_at(column * kPatch + x, row * kPatch + y);
        for (double* value : {&p.x, &p.y, &p.z}) {
          append_bytes(binary, static_cast<float>(*value));
          *value = static_cast<float>(*value);
        }
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    }
  });
  for_each_patch(sheet, [&](int column, int row) {
    for (int y = 0; y <= kPatch; ++y) {
      for (int x = 0; x <= kPatch; ++x) {
        const Vec2 uv = texcoord_at(sheet, column, row, x, y);
        append_bytes(binary, static_cast<float>(uv.x));
        append_bytes(binary, static_cast<float>(uv.y));
      }
    }
  });
  std::uint32_t first = 0;
  for_each_patch(sheet, [&](int, int) {
    for_each_corner([&](int x, int y) {
      append_bytes(binary, first + static_cast<std::uint32_t>(y * (kPatch + 1) + x));
    });
    first += (kPatch + 1) * (kPatch + 1);
  });

  const std::size_t vertices = sheet.texcoords(), indices = 3 * sheet.triangles();
  std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{0},"type":"VEC3",)"
      R"("min":[{6},{7},{8}],"max":[{9},{10},{11}]}},)"
      R"({{"bufferView":1,"componentType":5126,"count":{0},"type":"VEC2"}},)"
      R"({{"bufferView":2,"componentType":5125,"count":{1},"type":"SCALAR"}}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":{2}}},)"
      R"({{"buffer":0,"byteOffset":{2},"byteLength":{3}}},)"
      R"({{"buffer":0,"byteOffset":{4},"byteLength":{5}}}],)"
      R"("buffers":[{{"byteLength":{12}}}]}})",
      vertices, indices, 12 * vertices, 8 * vertices, 20 * vertices, 4 * indices, low.x, low.y,
      low.z, high.x, high.y, high.z, binary.size());
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string out;
  const auto append_size = [&](std::size_t size) {
    append_bytes(out, static_cast<std::uint32_t>(size));
  };
  out += "glTF";
  append_size(2);
  append_size(12 + 8 + json.size() + 8 + binary.size());
  append_size(json.size());
  out += "JSON" + json;
  append_size(binary.size());
  out += std::string("BIN\0", 4) + binary;
  return write_file(path, out);
}

}  // namespace wrapatlas::bench
