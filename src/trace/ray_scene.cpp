#include "trace/ray_scene.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>

#include "core/error.h"
#include "core/index_range.h"
#include "geometry/bounds.h"
#include "geometry/curved_triangle.h"
#include "geometry/mesh_checks.h"
#include "scene/checks.h"
#include "trace/embree_calls.h"
#include "trace/smooth_patches.h"
#include "trace/traced_triangle.h"

namespace nephroid {
namespace {

// Of the largest coordinate: what placing a point, and tracing a ray to it, may round, some ten steps in all.
constexpr float kRounding = 10 * 0x1p-24f;
// A ray closer along the surface than this cosine is taken to leave it within a hundred times the rounding.
constexpr float kGrazingCosine = 0.01f;

uint8_t rankOf(const Material& material) {
  return material.type == MaterialType::diffuse ? 2 : material.type == MaterialType::mirror ? 1 : 0;
}

struct alignas(64) RayCounter {
  std::atomic<uint64_t> count{0};
};

oneapi::tbb::enumerable_thread_specific<RayCounter>& rayCounters() {
  static oneapi::tbb::enumerable_thread_specific<RayCounter> counters;
  return counters;
}

void countRays(uint64_t rays) {
  thread_local RayCounter& counter = rayCounters().local();
  counter.count.store(counter.count.load(std::memory_order_relaxed) + rays, std::memory_order_relaxed);
}

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

}  // namespace

struct RayScene::Impl {
  struct TracedMesh {
    const Mesh* mesh;
    std::vector<TracedTriangle> triangles;
    SceneHandle scene;
    float volume;  // m3 in the mesh's own space; infinite where it is open
    float extent;  // m, its largest coordinate
  };
  struct TracedObject {
    uint32_t mesh;
    float scale;
    mat3 rotation;
    vec3 translation;
    TracedObject(uint32_t meshIndex, const Placement& placement)
        : mesh(meshIndex),
          scale(placement.scale),
          rotation(glm::mat3_cast(placement.rotation)),
          translation(placement.translation) {}
    vec3 point(vec3 p) const { return rotation * (scale * p) + translation; }
  };

  DeviceHandle device{rtcNewDevice(nullptr)};
  std::vector<TracedMesh> meshes;
  std::vector<TracedObject> objects;
  SceneHandle top;  // instances of the meshes; none for a scene of one mesh in its own space
  std::vector<RTCGeometry> instances;  // owned by `top`
  std::vector<float> roundings;        // m, of the objects
  std::vector<Box> boxes;              // of the meshes
  std::vector<uint8_t> ranks;          // of the objects: which of those that lie in the same place counts
  // What `contacts` were found for; none where they have to be found anew.
  std::vector<std::pair<Placement, uint8_t>> contactsFor;
  Contacts contacts;

  Impl() {
    if (!device) throw RuntimeFailure("Embree could not make a device");
  }

  // Its triangles' patches, and what holds them for Embree.
  TracedMesh traced(const Mesh& mesh, const std::vector<uint32_t>& patches) const {
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), mesh.positions.size()));
    auto* indices = static_cast<uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(uvec3), mesh.triangles.size()));
    if (!vertices || !indices)
      throw RuntimeFailure("out of memory for the acceleration structure of " + mesh.name);
    std::copy(mesh.positions.begin(), mesh.positions.end(), vertices);
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), indices);
    rtcCommitGeometry(geometry);
    SceneHandle scene(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    float extent = 0;
    for (const vec3& position : mesh.positions) extent = std::max(extent, largestCoordinate(position));
    return {&mesh, tracedTriangles(mesh, patches), std::move(scene), volumeOf(mesh), extent};
  }

  void addMesh(const Mesh& mesh) {
    meshes.push_back(traced(mesh, smoothPatches(mesh)));
    boxes.push_back(boundingBox(mesh));
  }

  void reshape(uint32_t index) {
    std::vector<uint32_t> patches;
    for (const TracedTriangle& triangle : meshes[index].triangles) patches.push_back(triangle.patch);
    TracedMesh now = traced(*meshes[index].mesh, patches);
    for (std::size_t i = 0; i < instances.size(); ++i)
      if (objects[i].mesh == index) rtcSetGeometryInstancedScene(instances[i], now.scene.get());
    meshes[index] = std::move(now);
    boxes[index] = boundingBox(*meshes[index].mesh);
    contactsFor.clear();
  }

  void updateContacts(const Scene& scene) {
    ranks.clear();
    std::vector<std::pair<Placement, uint8_t>> now;
    for (const Object& object : scene.objects) {
      const Material& material = scene.materialOf(object);
      ranks.push_back(rankOf(material));
      now.emplace_back(object.placement, uint8_t(2 * ranks.back() + uint8_t(material.thinWalled)));
    }
    if (now == contactsFor) return;
    contacts = findContacts(scene, boxes, roundings);
    contactsFor = std::move(now);
  }

  RTCScene root() const { return top ? top.get() : meshes[0].scene.get(); }

  void addObject(uint32_t mesh, const Placement& placement) {
    objects.emplace_back(mesh, placement);
    const float farthest = largestCoordinate(placement.translation) + placement.scale * meshes[mesh].extent;
    roundings.push_back(kRounding * farthest);
  }

  // Whether the surface of `object` lies where `hit` is; `face` then describes it.
  bool liesAt(uint32_t index, const Hit& hit, vec3 direction, Hit& face) const {
    const TracedObject& object = objects[index];
    const float across = touchingDistance(roundings[hit.object], roundings[index]);
    const float along = across / std::max(std::abs(dot(direction, hit.geometricNormal)), kGrazingCosine);
    const mat3 toObject = glm::transpose(object.rotation);
    const vec3 start = hit.flatPosition - along * direction;
    RTCRayHit query = embreeQuery({toObject * (start - object.translation) / object.scale,
                                   toObject * direction, 0, 2 * along / object.scale});
    embreeIntersect(meshes[object.mesh].scene.get(), query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    query.ray.dir_x = direction.x;
    query.ray.dir_y = direction.y;
    query.ray.dir_z = direction.z;
    query.ray.tfar = hit.distance;
    query.hit.instID[0] = index;
    describe(query, face);
    return std::abs(dot(face.geometricNormal, hit.geometricNormal)) > 0.9f;
  }

  void addTouching(vec3 direction, Hit& hit) const {
    std::array<Hit, kMostTouching + 1> faces{hit};
    std::size_t count = 1;
    for (const uint32_t other : contacts.around(hit.object, hit.triangle))
      if (count < faces.size() && liesAt(other, hit, direction, faces[count])) ++count;
    if (count == 1) return;
    const auto isBefore = [&](const Hit& a, const Hit& b) {
      return ranks[a.object] != ranks[b.object] ? ranks[a.object] > ranks[b.object] : a.object < b.object;
    };
    for (std::size_t sorted = 1; sorted < count; ++sorted)
      for (std::size_t i = sorted; i > 0 && isBefore(faces[i], faces[i - 1]); --i)
        std::swap(faces[i], faces[i - 1]);
    hit = faces[0];
    for (std::size_t i = 1; i < count; ++i)
      hit.touching[i - 1] = {faces[i].object, dot(faces[i].geometricNormal, hit.geometricNormal) < 0};
    hit.touchingCount = uint32_t(count - 1);
  }

  void describeWithTouching(const RTCRayHit& query, Hit& hit) const {
    describe(query, hit);
    if (contacts.areNone()) return;
    addTouching({query.ray.dir_x, query.ray.dir_y, query.ray.dir_z}, hit);
  }

  void describe(const RTCRayHit& query, Hit& hit) const {
    hit.touchingCount = 0;
    hit.object = top ? query.hit.instID[0] : 0;
    const TracedObject& object = objects[hit.object];
    const TracedMesh& traced = meshes[object.mesh];
    const TracedTriangle& triangle = traced.triangles[query.hit.primID];
    hit.distance = query.ray.tfar;
    hit.triangle = query.hit.primID;
    hit.barycentric = {query.hit.u, query.hit.v};
    hit.patch = triangle.patch;
    const vec3 weights(1 - hit.barycentric.x - hit.barycentric.y, hit.barycentric);
    const mat3& positions = triangle.positions;
    const mat3& normals = triangle.normals;
    hit.geometricNormal = object.rotation * triangle.flatNormal;
    // From the triangle rather than along the ray: nearer to the surface when the ray is long.
    const vec3 flat = positions * weights;
    hit.flatPosition = object.point(flat);
    if (!traced.mesh->isCurved) {
      hit.position = hit.flatPosition;
      hit.normal = object.rotation * glm::normalize(normals * weights);
      return;
    }
    // On along the ray to the plane through the curved surface's point, and the smooth normal over there.
    const vec3 direction =
        glm::transpose(object.rotation) * vec3(query.ray.dir_x, query.ray.dir_y, query.ray.dir_z);
    const vec3 rise = curvedOffset(flat, weights, positions, normals);
    const vec3 curved = flat + alongRayToPlane(direction, rise, triangle.flatNormal);
    hit.position = object.point(curved);
    hit.normal = object.rotation * glm::normalize(normals * barycentricOf(curved, positions));
  }
};

RayScene::RayScene(const Mesh& mesh) : impl_(std::make_unique<Impl>()) {
  checkMesh(mesh, "mesh \"" + mesh.name + "\"");
  impl_->addMesh(mesh);
  impl_->addObject(0, {});
}

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<Impl>()) {
  checkScene(scene);
  for (const Mesh& mesh : scene.meshes) impl_->addMesh(mesh);
  impl_->top.reset(rtcNewScene(impl_->device.get()));
  rtcSetSceneFlags(impl_->top.get(), RTC_SCENE_FLAG_ROBUST);
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    RTCGeometry instance = rtcNewGeometry(impl_->device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, impl_->meshes[scene.objects[i].mesh].scene.get());
    rtcAttachGeometryByID(impl_->top.get(), instance, i);
    rtcReleaseGeometry(instance);
    impl_->instances.push_back(instance);
  }
  place(scene);
}

RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

void RayScene::reshape(uint32_t mesh) {
  impl_->reshape(mesh);
}

void RayScene::place(const Scene& scene) {
  impl_->objects.clear();
  impl_->roundings.clear();
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    impl_->addObject(object.mesh, object.placement);
    const mat3 linear = glm::mat3_cast(object.placement.rotation) * object.placement.scale;
    const glm::mat4x3 transform(linear[0], linear[1], linear[2], object.placement.translation);
    rtcSetGeometryTransform(impl_->instances[i], 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &transform[0].x);
    rtcCommitGeometry(impl_->instances[i]);
  }
  rtcCommitScene(impl_->top.get());
  impl_->updateContacts(scene);
}

bool RayScene::intersect(const Ray& ray, Hit& hit) const {
  countRays(1);
  RTCRayHit query = embreeQuery(ray);
  embreeIntersect(impl_->root(), query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  impl_->describeWithTouching(query, hit);
  return true;
}

bool RayScene::occluded(const Ray& ray) const {
  countRays(1);
  RTCRay query = embreeRay(ray);
  embreeOccluded(impl_->root(), query);
  return query.tfar < 0;
}

void RayScene::occluded(vec3 origin, std::span<const vec3> directions, float nearDistance,
                        std::span<uint8_t> isOccluded) const {
  constexpr std::size_t kWidth = 8;
  countRays(directions.size());
  for (std::size_t first = 0; first < directions.size(); first += kWidth) {
    const std::size_t count = std::min(kWidth, directions.size() - first);
    alignas(32) int valid[kWidth] = {};
    RTCRay8 rays{};
    for (std::size_t i = 0; i < count; ++i) {
      valid[i] = -1;
      setRay(rays, i, {origin, directions[first + i], nearDistance});
    }
    embreeOccluded(impl_->root(), valid, rays);
    for (std::size_t i = 0; i < count; ++i) isOccluded[first + i] = rays.tfar[i] < 0;
  }
}

void RayScene::intersect(std::span<const Ray> rays, std::span<Hit> hits, bool areAlike) const {
  constexpr std::size_t kWidth = 8;
  countRays(rays.size());
  for (std::size_t first = 0; first < rays.size(); first += kWidth) {
    const std::size_t count = std::min(kWidth, rays.size() - first);
    alignas(32) int valid[kWidth] = {};
    RTCRayHit8 packet{};
    for (std::size_t i = 0; i < kWidth; ++i) {
      valid[i] = i < count ? -1 : 0;
      setRay(packet.ray, i, rays[first + std::min(i, count - 1)]);
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    embreeIntersect(impl_->root(), valid, packet, areAlike);
    for (std::size_t i = 0; i < count; ++i) {
      hits[first + i].object = kNone;
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      RTCRayHit query{};
      query.ray.dir_x = packet.ray.dir_x[i];
      query.ray.dir_y = packet.ray.dir_y[i];
      query.ray.dir_z = packet.ray.dir_z[i];
      query.ray.tfar = packet.ray.tfar[i];
      query.hit.u = packet.hit.u[i];
      query.hit.v = packet.hit.v[i];
      query.hit.primID = packet.hit.primID[i];
      query.hit.instID[0] = packet.hit.instID[0][i];
      impl_->describeWithTouching(query, hits[first + i]);
    }
  }
}

void RayScene::occluded(std::span<const Ray> rays, std::span<uint8_t> isOccluded) const {
  constexpr std::size_t kWidth = 8;
  countRays(rays.size());
  for (std::size_t first = 0; first < rays.size(); first += kWidth) {
    const std::size_t count = std::min(kWidth, rays.size() - first);
    alignas(32) int valid[kWidth] = {};
    RTCRay8 packet{};
    for (std::size_t i = 0; i < kWidth; ++i) {
      valid[i] = i < count ? -1 : 0;
      setRay(packet, i, rays[first + std::min(i, count - 1)]);
    }
    embreeOccluded(impl_->root(), valid, packet);
    for (std::size_t i = 0; i < count; ++i) isOccluded[first + i] = packet.tfar[i] < 0;
  }
}

float RayScene::rounding(uint32_t object) const {
  return impl_->roundings[object];
}

const Box& RayScene::box(uint32_t mesh) const {
  return impl_->boxes[mesh];
}

float RayScene::largestRounding() const {
  return impl_->roundings.empty() ? 0 : *std::max_element(impl_->roundings.begin(), impl_->roundings.end());
}

float RayScene::clearance(uint32_t object, vec3 geometricNormal, vec3 direction) const {
  return rounding(object) / std::max(std::abs(dot(geometricNormal, direction)), kGrazingCosine);
}

void RayScene::addTouching(vec3 direction, Hit& hit) const {
  if (!impl_->contacts.areNone()) impl_->addTouching(direction, hit);
}

const Contacts& RayScene::contacts() const {
  return impl_->contacts;
}

Ray RayScene::fromMeter(vec3 place, vec3 direction, float cosine, float distance) const {
  const float near = 2 * largestRounding() / std::max(cosine, kGrazingCosine);
  return {place, direction, near, beforeLamp(distance)};
}

uint32_t RayScene::patchOf(uint32_t mesh, uint32_t triangle) const {
  return impl_->meshes[mesh].triangles[triangle].patch;
}

bool RayScene::isClosed(uint32_t object) const {
  return impl_->meshes[impl_->objects[object].mesh].mesh->isClosed;
}

float RayScene::enclosedVolume(uint32_t object) const {
  const Impl::TracedObject& traced = impl_->objects[object];
  return impl_->meshes[traced.mesh].volume * traced.scale * traced.scale * traced.scale;
}

Ray RayScene::leaving(const Hit& hit, vec3 direction) const {
  const float near = clearance(hit.object, hit.geometricNormal, direction);
  const vec3 step = alongRayToPlane(direction, hit.flatPosition - hit.position, hit.geometricNormal);
  if (step == vec3(0)) return {hit.flatPosition, direction, near};
  // Beyond the triangle's edge its plane is outside the mesh, by less than this step.
  return {hit.position + step, direction, near + length(step)};
}

Ray RayScene::leavingTriangle(const Hit& hit, vec3 direction) const {
  const Impl::TracedObject& object = impl_->objects[hit.object];
  const Impl::TracedMesh& traced = impl_->meshes[object.mesh];
  Ray ray = leaving(hit, direction);
  if (!traced.mesh->isCurved) return ray;
  const mat3& positions = traced.triangles[hit.triangle].positions;
  const mat3 corners(object.point(positions[0]), object.point(positions[1]), object.point(positions[2]));
  const vec3 weights = glm::max(barycentricOf(ray.origin, corners), vec3(0));
  ray.origin = corners * (weights / (weights.x + weights.y + weights.z));
  return ray;
}

std::size_t RayScene::replay(std::span<const Ray> rays) const {
  return oneapi::tbb::parallel_reduce(
      IndexRange(0, rays.size(), 1024), std::size_t{0},
      [&](const IndexRange& range, std::size_t hits) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          RTCRayHit query = embreeQuery(rays[i]);
          embreeIntersect(impl_->root(), query);
          hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
        return hits;
      },
      std::plus<>());
}

uint64_t raysTraced() {
  uint64_t sum = 0;
  for (const RayCounter& counter : rayCounters()) sum += counter.count.load(std::memory_order_relaxed);
  return sum;
}

}  // namespace nephroid
