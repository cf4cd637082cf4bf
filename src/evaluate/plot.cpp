#include "evaluate/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wrapatlas {
namespace {

constexpr double kLeft = 62, kRight = 620, kTop = 56, kBottom = 376, kWidth = 790, kHeight = 426;

class Scale {
 public:
  Scale(const PlotAxis& axis, double begin, double end) : axis_(axis), begin_(begin), end_(end) {}

  [[nodiscard]] double at(double value) const {
    const double low = place(axis_.low), high = place(axis_.high);
    const double share = high > low ? (place(value) - low) / (high - low) : 0.5;
    return begin_ + std::clamp(share, 0.0, 1.0) * (end_ - begin_);
  }

  /// About six round numbers; of a logarithmic axis 1, 2 and 5 times powers of ten, or those alone.
  [[nodiscard]] std::vector<double> ticks() const {
    std::vector<double> values;
    if (axis_.logarithmic) {
      const bool is_long = axis_.high / axis_.low > 1000;
      for (double power = std::floor(std::log10(axis_.low)); power <= std::log10(axis_.high);
           ++power) {
        for (const double step : {1.0, 2.0, 5.0}) {
          const double value = step * std::pow(10, power);
          const bool within = value >= axis_.low * (1 - 1e-9) && value <= axis_.high * (1 + 1e-9);
          if (within && (step == 1 || !is_long)) values.push_back(value);
        }
      }
      return values;
    }
    const double rough = (axis_.high - axis_.low) / 6;
    const double unit = std::pow(10, std::floor(std::log10(rough)));
    const double step = unit * (rough / unit > 5 ? 10 : rough / unit > 2 ? 5 : 2);
    for (double i = std::ceil(axis_.low / step - 1e-9); i * step <= axis_.high + 1e-9; ++i) {
      values.push_back(i * step + 0.0);  // no minus before a zero
    }
    return values;
  }

 private:
  [[nodiscard]] double place(double value) const {
    return axis_.logarithmic ? std::log(std::max(value, axis_.low * 1e-3)) : value;
  }

  const PlotAxis& axis_;
  double begin_, end_;
};

std::string text_at(double x, double y, const char* anchor, const std::string& text,
                    const char* more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     anchor, more, escaped(text));
}

std::string grid(const Scale& x, const Scale& y) {
  std::string svg;
  for (const double tick : y.ticks()) {
    svg +=
        fmt::format("<path d=\"M{} {:.1f}H{}\" stroke=\"#d5d8dd\"/>\n", kLeft, y.at(tick), kRight);
    svg += text_at(kLeft - 7, y.at(tick) + 4, "end", fmt::format("{:g}", tick));
  }
  for (const double tick : x.ticks()) {
    svg +=
        fmt::format("<path d=\"M{:.1f} {}V{}\" stroke=\"#e7e9ec\"/>\n", x.at(tick), kTop, kBottom);
    svg += text_at(x.at(tick), kBottom + 18, "middle", fmt::format("{:g}", tick));
  }
  return svg;
}

}  // namespace

const char* series_color(std::size_t i) {
  // Okabe & Ito's colours that are dark enough for lines on white.
  constexpr std::array kColors{"#0072b2", "#d55e00", "#009e73", "#a1569b",
                               "#b58900", "#333333", "#3aa0d8", "#8a3b12"};
  return kColors[i % kColors.size()];
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string draw_plot(const Plot& plot) {
  const Scale x(plot.x, kLeft, kRight), y(plot.y, kBottom, kTop);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n<title>{2}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      kWidth, kHeight, escaped(plot.title));
  svg += text_at(kLeft, 22, "start", plot.title, " font-weight=\"bold\" font-size=\"14\"");
  svg += grid(x, y);
  svg += fmt::format("<path d=\"M{} {}V{}H{}\" fill=\"none\" stroke=\"#222\"/>\n", kLeft, kTop,
                     kBottom, kRight);
  svg += text_at((kLeft + kRight) / 2, kBottom + 38, "middle", plot.x.name);
  svg += text_at(kLeft, kTop - 10, "start", plot.y.name, " fill=\"#555\"");
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    const char* color = series_color(i);
    std::string path;
    for (const Vec2 p : series.points) {
      const double px = x.at(p.x), py = y.at(p.y);
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px, py);
      svg += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" fill-opacity=\"{}\"/>\n", px,
          py, plot.lines ? "2.5" : "2.8", color, plot.lines ? "1" : "0.55");
    }
    if (plot.lines && !path.empty()) {
      svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path,
                         color);
    }
    const double row = kTop + 12 + 20 * static_cast<double>(i);
    svg += fmt::format("<circle cx=\"{}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\"/>\n", kRight + 18,
                       row - 4, color);
    svg += text_at(kRight + 30, row, "start", series.name);
  }
  return svg + "</svg>\n";
}

}  // namespace wrapatlas
