#include "bake/ray_scene.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bake/triangle_point.h"

namespace wrapatlas {

struct RayScene::Parts {
  const Mesh* mesh = nullptr;
  Vec3 middle;
  double diagonal = 1;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Parts() = default;
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  /// In Embree's units the diagonal is 1.
  [[nodiscard]] Vec3 inside(const Vec3& p) const { return (1 / diagonal) * (p - middle); }
};

namespace {

Error embree_error(const std::string& what) {
  return {ErrorKind::output, "Embree", what, "close other programs, or use a smaller model"};
}

float to_float(double value) { return static_cast<float>(value); }

RTCRay ray_of(const Vec3& origin, const Vec3& direction, double farthest) {
  RTCRay ray{};
  ray.org_x = to_float(origin.x);
  ray.org_y = to_float(origin.y);
  ray.org_z = to_float(origin.z);
  ray.dir_x = to_float(direction.x);
  ray.dir_y = to_float(direction.y);
  ray.dir_z = to_float(direction.z);
  ray.tnear = 0;
  ray.tfar = to_float(farthest);
  ray.mask = 0xffffffffU;
  return ray;
}

/// Has the triangle's normal a part along `facing`? Of none every triangle does.
bool faces(const Mesh& mesh, std::uint32_t triangle, const Vec3& facing) {
  if (facing == Vec3{}) return true;
  const Triangle t = triangle_of(mesh, triangle);
  return dot(cross(t[1] - t[0], t[2] - t[0]), facing) > 0;
}

/// What a ray carries along.
struct RayContext {
  RTCIntersectContext embree;  // first: Embree hands on a pointer to it
  const Mesh* mesh;
  Vec3 facing;
};

void pass_others(const RTCFilterFunctionNArguments* arguments) {
  const auto& context = *reinterpret_cast<const RayContext*>(arguments->context);
  const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
  if (!faces(*context.mesh, triangle, context.facing)) arguments->valid[0] = 0;
}

/// What a query for the nearest point carries along.
struct Search {
  const Mesh* mesh;
  Vec3 facing;
  Vec3 place;
  SurfacePoint best;
  double unit;  ///< the mesh's units in one of Embree's
};

bool look_at_triangle(RTCPointQueryFunctionArguments* arguments) {
  Search& search = *static_cast<Search*>(arguments->userPtr);
  if (!faces(*search.mesh, arguments->primID, search.facing)) return false;
  const std::array<double, 3> weights =
      nearest_weights(triangle_of(*search.mesh, arguments->primID), search.place);
  const Vec3 at = point_at(triangle_of(*search.mesh, arguments->primID), weights);
  const double distance = length(at - search.place);
  const bool is_tie = distance == search.best.distance && arguments->primID < search.best.triangle;
  if (!(distance < search.best.distance) && !is_tie) return false;
  search.best = {arguments->primID, weights, distance};
  // A little more, so that what is as near is found whichever is looked at first.
  arguments->query->radius = to_float(1.000001 * distance / search.unit + 1e-12);
  return true;
}

}  // namespace

RayScene::RayScene(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

double RayScene::diagonal() const { return parts_->diagonal; }

Result<RayScene> RayScene::build(const Mesh& mesh, int threads) {
  auto parts = std::make_unique<Parts>();
  parts->mesh = &mesh;
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const std::uint32_t i : mesh.corner_position) {
    const Vec3& p = mesh.positions[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  parts->middle = 0.5 * (low + high);
  const double diagonal = length(high - low);
  parts->diagonal = diagonal > 0 ? diagonal : 1;

  parts->device = rtcNewDevice(fmt::format("threads={}", std::max(1, threads)).c_str());
  if (parts->device == nullptr) return embree_error("it cannot start");
  parts->scene = rtcNewScene(parts->device);
  rtcSetSceneFlags(
      parts->scene,
      static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  RTCGeometry geometry = rtcNewGeometry(parts->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), std::max<std::size_t>(1, mesh.positions.size())));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.face_count()));
  if (vertices == nullptr || indices == nullptr) {
    rtcReleaseGeometry(geometry);
    return embree_error("out of memory");
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = parts->inside(mesh.positions[i]);
    vertices[3 * i] = to_float(p.x);
    vertices[3 * i + 1] = to_float(p.y);
    vertices[3 * i + 2] = to_float(p.z);
  }
  std::copy(mesh.corner_position.begin(), mesh.corner_position.end(), indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(parts->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(parts->scene);
  if (rtcGetDeviceError(parts->device) != RTC_ERROR_NONE) return embree_error("out of memory");
  return RayScene(std::move(parts));
}

std::optional<SurfacePoint> RayScene::first_hit(const Vec3& origin, const Vec3& direction,
                                                double farthest, const Vec3& facing) const {
  const double unit = parts_->diagonal;
  RTCRayHit found{};
  found.ray = ray_of(parts_->inside(origin), direction, farthest / unit);
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RayContext context{{}, parts_->mesh, facing};
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = pass_others;
  rtcIntersect1(parts_->scene, &context.embree, &found);
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const double u = found.hit.u, v = found.hit.v;
  return SurfacePoint{found.hit.primID, {1 - u - v, u, v}, unit * found.ray.tfar};
}

bool RayScene::is_blocked(const Vec3& origin, const Vec3& direction, double farthest) const {
  const double unit = parts_->diagonal;
  RTCRay ray = ray_of(parts_->inside(origin), direction, farthest / unit);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(parts_->scene, &context, &ray);
  return ray.tfar < 0;
}

std::optional<SurfacePoint> RayScene::nearest_point(const Vec3& place, const Vec3& facing) const {
  constexpr double kFarthest = std::numeric_limits<double>::infinity();
  const double unit = parts_->diagonal;
  const Vec3 at = parts_->inside(place);
  RTCPointQuery query{};
  query.x = to_float(at.x);
  query.y = to_float(at.y);
  query.z = to_float(at.z);
  query.radius = to_float(kFarthest);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Search search{parts_->mesh, facing, place, {kNone, {}, kFarthest}, unit};
  rtcPointQuery(parts_->scene, &query, &context, look_at_triangle, &search);
  if (search.best.triangle == kNone) return std::nullopt;
  return search.best;
}

}  // namespace wrapatlas
