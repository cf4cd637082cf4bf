#include "render/digits.h"

#include <cmath>
#include <numbers>

namespace wrapatlas {
namespace {

// A digit fills 0.6 x 1, top left at the origin.
constexpr double kDigitWidth = 0.6;
constexpr double kAdvance = 0.86;

using Polyline = std::vector<Vec2>;

/// An elliptic arc, angles in degrees, clockwise on screen from the right.
Polyline arc(Vec2 centre, double radius_x, double radius_y, int from, int to) {
  constexpr int kStep = 15;
  Polyline line;
  for (int degrees = from; degrees < to + kStep; degrees += kStep) {
    const double angle = std::min(degrees, to) * std::numbers::pi / 180;
    line.push_back({centre.x + radius_x * std::cos(angle), centre.y + radius_y * std::sin(angle)});
  }
  return line;
}

Polyline join(Polyline a, const Polyline& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Polyline> digit_lines(char digit) {
  switch (digit) {
    case '0':
      return {arc({0.3, 0.5}, 0.3, 0.5, 0, 360)};
    case '1':
      return {{{0.08, 0.22}, {0.36, 0}, {0.36, 1}}};
    case '2':
      return {join(arc({0.3, 0.29}, 0.29, 0.29, 190, 395), {{0.02, 1}, {0.6, 1}})};
    case '3':
      return {
          join(arc({0.28, 0.24}, 0.26, 0.24, 205, 450), arc({0.28, 0.74}, 0.31, 0.26, 270, 515))};
    case '4':
      return {{{0.44, 1}, {0.44, 0}, {0, 0.7}, {0.6, 0.7}}};
    case '5':
      return {join({{0.54, 0}, {0.1, 0}}, arc({0.28, 0.67}, 0.31, 0.33, 225, 500))};
    case '6':
      return {arc({0.3, 0.68}, 0.3, 0.32, 0, 360), arc({0.62, 0.68}, 0.62, 0.68, 180, 258)};
    case '7':
      return {{{0, 0}, {0.6, 0}, {0.2, 1}}};
    case '8':
      return {arc({0.3, 0.24}, 0.25, 0.24, 0, 360), arc({0.3, 0.74}, 0.3, 0.26, 0, 360)};
    default:
      return {arc({0.3, 0.32}, 0.3, 0.32, 0, 360), arc({-0.02, 0.32}, 0.62, 0.68, 0, 78)};
  }
}

}  // namespace

double number_width(std::size_t count) {
  return static_cast<double>(count - 1) * kAdvance + kDigitWidth;
}

std::vector<Segment> number_lines(std::string_view number, Vec2 centre, double height) {
  std::vector<Segment> lines;
  Vec2 origin = centre - (0.5 * height) * Vec2{number_width(number.size()), 1};
  for (const char digit : number) {
    for (const Polyline& line : digit_lines(digit)) {
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        lines.push_back({origin + height * line[i], origin + height * line[i + 1], 1});
      }
    }
    origin.x += height * kAdvance;
  }
  return lines;
}

}  // namespace wrapatlas
