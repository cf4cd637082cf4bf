// A program of somebody else's: finds the headers, links both libraries, calls into each.
#include <cstdio>
#include <filesystem>

#include "wrapatlas/mesh.h"
#include "wrapatlas/model.h"

int main() {
  wrapatlas::Mesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  square.face_begin = {0, 4};
  square.corner_position = square.corner_texcoord = {0, 1, 2, 3};
  if (const wrapatlas::Status status = wrapatlas::validate_mesh(square); !status) {
    std::fprintf(stderr, "%s\n", status.error().message().c_str());
    return 1;
  }
  std::puts("the square is a mesh");
  return 0;
}
