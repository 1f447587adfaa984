#include "reference/reference.h"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "reference/embree_scene.h"
#include "reference/frame_light.h"
#include "reference/hit_filter.h"

namespace sundial {

namespace {

constexpr double kNearestHit = 2e-5;  // of the scene's diagonal
// Rays that leave their receiver's plane more slowly than this, metres a metre, are still within a view
// sample's rounding of it where hits begin to count.
constexpr float kGrazing = 0.01f;

// Which samples travel together. Neighbours of an image in tiles of 4x4 take nearly the same way.
class Packets {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  Packets(std::size_t samples, std::size_t width)
      : samples_(samples), width_(width), tilesAcross_((width + 3) / 4) {}
  std::size_t count() const {
    if (width_ == 0) return (samples_ + kPacketSize - 1) / kPacketSize;
    const std::size_t height = (samples_ + width_ - 1) / width_;
    return tilesAcross_ * ((height + 3) / 4);
  }
  std::size_t sample(std::size_t packet, std::size_t lane) const {
    std::size_t index = packet * kPacketSize + lane;
    if (width_ > 0) {
      const std::size_t x = packet % tilesAcross_ * 4 + lane % 4;
      const std::size_t y = packet / tilesAcross_ * 4 + lane / 4;
      if (x >= width_) return kNone;
      index = y * width_ + x;
    }
    return index < samples_ ? index : kNone;
  }

 private:
  std::size_t samples_, width_, tilesAcross_;
};

std::vector<glm::mat4x3> centredTransforms(const Scene& scene) {
  std::vector<glm::mat4x3> result;
  result.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    glm::dmat4 centreFromMesh = instance.worldFromMesh;
    centreFromMesh[3] -= glm::dvec4(scene.bounds.centre(), 0);
    result.emplace_back(glm::mat4(centreFromMesh));
  }
  return result;
}

}  // namespace

// Two levels: a hierarchy for each mesh, and one over the instances. All lengths that Embree sees are
// relative to the centre of the scene's bounds, where single precision is finest.
struct Reference::Impl {
  explicit Impl(std::shared_ptr<const Scene>);
  EmbreeScene makeScene() const;
  EmbreeScene buildMesh(std::uint32_t index);
  glm::dvec3 abovePlane(const shared::ViewSample&, const glm::dvec3& position) const;
  void tracePacket(const Packets&, std::size_t packet, std::span<const shared::ViewSample>, const FrameLight&,
                   const glm::dvec3& centreFromOrigin, std::span<float> visibility) const;

  std::shared_ptr<const Scene> scene;
  float nearest;  // metres
  std::vector<glm::mat4x3> centreFromMesh;
  HitFilter filter;
  EmbreeDevice device;
  std::vector<EmbreeScene> meshes;
  EmbreeScene instances;
};

Reference::Impl::Impl(std::shared_ptr<const Scene> s)
    : scene(std::move(s)),
      nearest(static_cast<float>(kNearestHit * scene->bounds.diagonal())),
      centreFromMesh(centredTransforms(*scene)),
      filter(*scene, centreFromMesh),
      device(rtcNewDevice(nullptr)),
      meshes(scene->meshes.size()) {
  if (!device) checkEmbree(nullptr, "to start");

  tbb::parallel_for(std::size_t{0}, meshes.size(),
                    [&](std::size_t m) { meshes[m] = buildMesh(static_cast<std::uint32_t>(m)); });

  instances = makeScene();
  for (std::uint32_t i = 0; i < centreFromMesh.size(); ++i) {
    const EmbreeGeometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), meshes[scene->instances[i].mesh].get());
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &centreFromMesh[i]);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(instances.get(), geometry.get(), i);
  }
  rtcCommitScene(instances.get());
  checkEmbree(device.get(), "to build the hierarchy of instances");
}

// Robust: a ray that meets the edge of two triangles hits at least one of them.
EmbreeScene Reference::Impl::makeScene() const {
  EmbreeScene result(rtcNewScene(device.get()));
  if (!result) checkEmbree(device.get(), "to make a scene");
  rtcSetSceneFlags(result.get(), RTC_SCENE_FLAG_ROBUST);
  return result;
}

EmbreeScene Reference::Impl::buildMesh(std::uint32_t index) {
  EmbreeScene result = makeScene();
  const Mesh& mesh = scene->meshes[index];
  if (mesh.triangleCount > 0) {
    const EmbreeGeometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    // Embree may read 16 bytes at each position: a vertex has them.
    static_assert(sizeof(shared::Vertex) == 16);
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               scene->vertices.data(), 0, sizeof(shared::Vertex), scene->vertices.size());
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               scene->indices.data() + std::size_t{3} * mesh.firstTriangle, 0,
                               3 * sizeof(std::uint32_t), mesh.triangleCount);
    filter.attachTo(geometry.get(), index);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(result.get(), geometry.get());
  }
  rtcCommitScene(result.get());
  checkEmbree(device.get(), "to build a mesh's hierarchy");
  return result;
}

// Where a ray starts that all but lies in its receiver's plane. A view sample's position is rounded; a little
// below the plane the ray would meet what adjoins the receiver from behind. So it starts on the plane, found
// in double precision, and above it by what rounding to single precision may take again. `position` and the
// result are relative to the centre of the scene's bounds.
glm::dvec3 Reference::Impl::abovePlane(const shared::ViewSample& sample, const glm::dvec3& position) const {
  if (sample.instance >= scene->instances.size() || sample.triangle >= scene->indices.size() / 3)
    return position;
  const glm::dvec3 corner(scene->vertices[scene->indices[std::size_t{3} * sample.triangle]].position);
  const glm::dvec3 onPlane(scene->instances[sample.instance].worldFromMesh * glm::dvec4(corner, 1));
  const glm::dvec3 normal(sample.wsNormal);
  const double below = glm::dot(normal, onPlane - scene->bounds.centre() - position);
  if (!(std::abs(below) < nearest)) return position;  // not on its triangle
  const double largest = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
  return position + (below + 2 * std::numeric_limits<float>::epsilon() * largest) * normal;
}

void Reference::Impl::tracePacket(const Packets& packets, std::size_t packet,
                                  std::span<const shared::ViewSample> samples, const FrameLight& light,
                                  const glm::dvec3& centreFromOrigin, std::span<float> visibility) const {
  alignas(64) std::array<int, kPacketSize> valid{};
  std::array<std::size_t, kPacketSize> index;
  bool any = false;
  for (unsigned lane = 0; lane < kPacketSize; ++lane) {
    index[lane] = packets.sample(packet, lane);
    if (index[lane] == Packets::kNone) continue;
    visibility[index[lane]] = 0;
    const glm::vec3& position = samples[index[lane]].wsPosition;
    if (!light.facedBy(samples[index[lane]]) || !std::isfinite(position.x + position.y + position.z))
      continue;
    valid[lane] = -1;
    any = true;
  }
  if (!any) return;

  RTCRay16 rays;
  PacketContext context;
  const bool endless = light.kind == LightKind::directional;
  for (unsigned lane = 0; lane < kPacketSize; ++lane) {
    // Rays that are not valid must still be numbers.
    glm::vec3 from{0}, towards{0, 1, 0};
    float tNear = 0, tFar = 0;
    if (valid[lane]) {
      const shared::ViewSample& sample = samples[index[lane]];
      const glm::dvec3 position = glm::dvec3(sample.wsPosition) + centreFromOrigin;
      towards = light.towards(sample);
      const bool grazes = glm::dot(sample.wsNormal, towards) < kGrazing * glm::length(towards);
      from = glm::vec3(grazes ? abovePlane(sample, position) : position);
      // A ray towards a light at a place has the length of its way, so that it ends there at t = 1.
      tNear = endless ? nearest : nearest / glm::length(towards);
      tFar = endless ? std::numeric_limits<float>::infinity() : 1.0f;
      context.receivers[lane] = {sample.instance, sample.triangle, glm::dot(sample.wsNormal, towards)};
    }
    rays.org_x[lane] = from.x;
    rays.org_y[lane] = from.y;
    rays.org_z[lane] = from.z;
    rays.dir_x[lane] = towards.x;
    rays.dir_y[lane] = towards.y;
    rays.dir_z[lane] = towards.z;
    rays.tnear[lane] = tNear;
    rays.tfar[lane] = tFar;
    rays.time[lane] = 0;
    rays.mask[lane] = ~0u;
    rays.id[lane] = lane;
    rays.flags[lane] = 0;
  }

  // Never RTC_INTERSECT_CONTEXT_FLAG_COHERENT: no faster here, and Embree 3.13.5 then goes round in circles
  // on some robust packets (of the rays towards a near spot, for one).
  rtcInitIntersectContext(&context.embree);
  rtcOccluded16(valid.data(), instances.get(), &context.embree, &rays);
  for (unsigned lane = 0; lane < kPacketSize; ++lane)
    if (valid[lane]) visibility[index[lane]] = rays.tfar[lane] < 0 ? 0.0f : 1.0f;  // occluded: -infinity
}

Reference::Reference(std::shared_ptr<const Scene> scene) : impl_(std::make_unique<Impl>(std::move(scene))) {}
Reference::~Reference() = default;

// Packets are fixed by the samples alone, so who traces them doesn't matter.
void Reference::trace(std::span<const shared::ViewSample> samples, const Light& light,
                      const glm::dvec3& origin, std::span<float> visibility, std::uint32_t width) const {
  assert(visibility.size() == samples.size());
  const FrameLight frameLight(light, origin);
  const glm::dvec3 centreFromOrigin = origin - impl_->scene->bounds.centre();
  const Packets packets(samples.size(), width);
  constexpr std::size_t kGrain = 64;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets.count(), kGrain), [&](const auto& range) {
    for (std::size_t packet = range.begin(); packet != range.end(); ++packet)
      impl_->tracePacket(packets, packet, samples, frameLight, centreFromOrigin, visibility);
  });
}

}  // namespace sundial
