#include "check_hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "options.h"

namespace wrapatlas::cli {
namespace {

/// The axes along which UVs leave [0,1] by more than rounding.
Wrap axes_left(const Mesh& mesh) {
  constexpr double kRounding = 1e-5;
  bool u = false, v = false;
  for (const std::uint32_t corner : mesh.corner_texcoord) {
    if (corner == kNone) continue;
    const Vec2 uv = mesh.texcoords[corner];
    u = u || uv.x < -kRounding || uv.x > 1 + kRounding;
    v = v || uv.y < -kRounding || uv.y > 1 + kRounding;
  }
  return wrap_on(u, v);
}

class Hints {
 public:
  Hints(const Mesh& atlas, const Mesh* reference, const CheckOptions& options,
        const CheckReport& report, GivenPromise given)
      : atlas_(atlas), reference_(reference), options_(options), report_(report), given_(given) {}

  std::vector<std::string> find() {
    if (!hint_on_wrap() && !hint_on_pages() && !hint_on_shape()) hint_on_resolution();
    return std::move(hints_);
  }

 private:
  [[nodiscard]] std::size_t violations_with(const CheckOptions& changed) const {
    CheckOptions options = changed;
    options.max_findings = 0;
    const auto report = check_atlas(atlas_, reference_, options);
    return report ? report->violations : report_.violations;
  }
  [[nodiscard]] std::size_t violations_with(Wrap wrap) const {
    CheckOptions options = options_;
    options.wrap = wrap;
    return violations_with(options);
  }

  bool hint_on_wrap() {
    const Wrap left = axes_left(atlas_);
    const Wrap wider =
        wrap_on(wraps_u(options_.wrap) || wraps_u(left), wraps_v(options_.wrap) || wraps_v(left));
    if (wider != options_.wrap) {
      const std::size_t rest = violations_with(wider);
      if (rest >= report_.violations) return false;
      const std::string outcome =
          rest == 0 ? "every promise holds"
                    : fmt::format("{} of {} violations are left", rest, report_.violations);
      hints_.push_back(fmt::format(
          "UVs leave [0,1] along {}; if the atlas wraps there, give --wrap {}: then {}",
          left == Wrap::uv ? "u and v" : name_of(kWraps, left), name_of(kWraps, wider), outcome));
      return rest == 0;
    }
    for (const Wrap narrower : {Wrap::u, Wrap::v, Wrap::none}) {
      const bool within = (wraps_u(options_.wrap) || !wraps_u(narrower)) &&
                          (wraps_v(options_.wrap) || !wraps_v(narrower));
      const bool allowed =
          (wraps_u(narrower) || !wraps_u(left)) && (wraps_v(narrower) || !wraps_v(left));
      if (narrower == options_.wrap || !within || !allowed) continue;
      if (violations_with(narrower) > 0) continue;
      const std::string name = name_of(kWraps, narrower);
      hints_.push_back(fmt::format(
          "if the atlas {}, give --wrap {}: then every promise holds",
          narrower == Wrap::none ? "does not wrap" : "wraps along " + name + " only", name));
      return true;
    }
    return false;
  }

  /// Charts beyond [0,1] may be on other pages.
  bool hint_on_pages() {
    if (options_.pages > 1 || axes_left(atlas_) == Wrap::none) return false;
    CheckOptions options = options_;
    options.pages = kMostPages;
    options.max_findings = 0;
    const auto report = check_atlas(atlas_, reference_, options);
    if (!report || !report->ok() || report->pages < 2) return false;
    options.pages = static_cast<int>(report->pages);
    if (violations_with(options) > 0) options.pages = kMostPages;  // some in between are empty
    hints_.push_back(fmt::format(
        "if the atlas has pages beside each other (UDIM tiles), give --pages {}: then every "
        "promise holds",
        options.pages));
    return true;
  }

  /// Lengths in the reference against those in the atlas: l^2 = (W du)^2 + (H dv)^2, whatever the
  /// rotations, gives W : H by least squares.
  bool hint_on_shape() {
    if (reference_ == nullptr || atlas_.face_begin != reference_->face_begin) return false;
    const auto distorted =
        std::count_if(report_.findings.begin(), report_.findings.end(),
                      [](const Finding& f) { return f.kind == Violation::not_similar; });
    if (distorted == 0) return false;
    double uu = 0, uv = 0, vv = 0, ul = 0, vl = 0;
    for (std::size_t f = 0; f < atlas_.face_count(); ++f) {
      for (std::uint32_t c = atlas_.face_begin[f] + 1; c < atlas_.face_begin[f + 1]; ++c) {
        if (!has_uv(c) || !has_uv(c - 1)) continue;
        const Vec2 now = uv_of(atlas_, c) - uv_of(atlas_, c - 1);
        const Vec2 was = uv_of(*reference_, c) - uv_of(*reference_, c - 1);
        const double x = now.x * now.x, y = now.y * now.y, l = dot(was, was);
        uu += x * x;
        uv += x * y;
        vv += y * y;
        ul += x * l;
        vl += y * l;
      }
    }
    const double ratio = (ul * vv - vl * uv) / (vl * uu - ul * uv);  // W^2 / H^2
    if (!(ratio > 1e-6 && ratio < 1e6)) return false;
    const double side = std::sqrt(static_cast<double>(options_.width) * options_.height);
    CheckOptions options = options_;
    options.width = static_cast<int>(std::lround(side * std::pow(ratio, 0.25)));
    options.height = static_cast<int>(std::lround(side / std::pow(ratio, 0.25)));
    if (options.width == options_.width) return false;
    hints_.push_back(
        fmt::format("the charts are those of an atlas whose sides are as {:.4g} : 1, not {:.4g} : "
                    "1; give its --resolution WxH",
                    std::sqrt(ratio), static_cast<double>(options_.width) / options_.height));
    return true;
  }

  void hint_on_resolution() {
    if (given_.resolution || options_.padding == 0) return;
    double factor = 1;
    for (const Finding& finding : report_.findings) {
      if (finding.kind == Violation::gap)
        factor = std::max(factor, options_.padding / finding.amount);
      if (finding.kind == Violation::margin)
        factor = std::max(factor, options_.margin / finding.amount);
    }
    if (!(factor > 1 && factor * options_.width <= kMostTexels)) return;
    CheckOptions options = options_;
    while (options.width < factor * options_.width) options.width *= 2;
    options.height = options.width;
    const std::string measured = fmt::format(
        "--resolution was not given, so distances were measured at {} texels", options_.width);
    if (violations_with(options) == 0) {
      hints_.push_back(
          fmt::format("{}; with --resolution {} every promise holds", measured, options.width));
    } else {
      hints_.push_back(measured + "; give the one of the atlas");
    }
  }

  [[nodiscard]] bool has_uv(std::uint32_t c) const {
    return atlas_.corner_texcoord[c] != kNone && reference_->corner_texcoord[c] != kNone;
  }
  static Vec2 uv_of(const Mesh& mesh, std::uint32_t c) {
    return mesh.texcoords[mesh.corner_texcoord[c]];
  }

  const Mesh& atlas_;
  const Mesh* reference_;
  const CheckOptions& options_;
  const CheckReport& report_;
  GivenPromise given_;
  std::vector<std::string> hints_;
};

}  // namespace

std::vector<std::string> check_hints(const Mesh& atlas, const Mesh* reference,
                                     const CheckOptions& options, const CheckReport& report,
                                     GivenPromise given) {
  if (report.ok()) return {};
  return Hints(atlas, reference, options, report, given).find();
}

std::vector<std::string> unchecked(bool has_reference, const CheckOptions& options,
                                   GivenPromise given) {
  std::vector<std::string> left;
  if (!has_reference) {
    left.emplace_back(
        "whether faces are missing and charts distorted, mirrored or scaled (give --ref MODEL)");
  }
  if (options.padding == 0 && !given.padding) {
    left.emplace_back("distances between charts (give --padding T and the --resolution)");
  }
  return left;
}

}  // namespace wrapatlas::cli
