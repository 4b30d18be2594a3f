#include "reference/image.h"

#include <cmath>

namespace nephroid {
namespace {

constexpr float kFirstRadius = 2;        // pixels, of the first pass, on surfaces
constexpr float kFirstRadiusInAir = 10;  // pixels
constexpr float kShrinking = 2.0f / 3;   // alpha of Knaus and Zwicker 2011, eq. 15

// What is left of the first pass's area or volume in the pass of an index from 0.
float kernelLeft(uint32_t pass) {
  double left = 1;
  for (uint32_t i = 1; i <= pass; ++i) left *= (i + double(kShrinking)) / (i + 1.0);
  return static_cast<float>(left);
}

// Keeps photons where they land and, once a segment, where they are in the air.
class MapVisitor final : public PhotonVisitor {
 public:
  explicit MapVisitor(bool keepsAir) : isAirKept(keepsAir) {}

  void segment(const PhotonSegment& segment) override {
    if (!isAirKept || !segment.metCaster || !segment.isInAir) return;
    const float extinction = segment.extinction.x;
    const DistanceSample sample = sampleExtinction(segment.sample, extinction, segment.length);
    StoredPhoton photon = stored(segment, segment.flux);
    photon.position = segment.ray.origin + sample.distance * segment.ray.direction;
    photon.flux *= std::exp(-extinction * sample.distance) / sample.density;
    photon.direction = segment.ray.direction;
    inAir.push_back(photon);
  }

  void landing(const PhotonSegment& segment, const Hit& hit, vec3 flux) override {
    const vec3 arriving = segment.ray.direction;
    StoredPhoton photon = stored(segment, flux);
    photon.direction = dot(arriving, hit.geometricNormal) < 0 ? hit.geometricNormal : -hit.geometricNormal;
    const vec3 smooth = dot(hit.normal, photon.direction) < 0 ? -hit.normal : hit.normal;
    // Receivers are lit by their smooth normals, photons land on triangles.
    photon.flux *= glm::clamp(dot(arriving, smooth) / dot(arriving, photon.direction), 0.0f, 4.0f);
    photon.position = hit.flatPosition;
    photon.object = hit.object;
    onSurfaces.push_back(photon);
  }

  std::vector<StoredPhoton> onSurfaces, inAir;

 private:
  static StoredPhoton stored(const PhotonSegment& segment, vec3 flux) {
    StoredPhoton photon;
    photon.flux = flux;
    photon.band = uint16_t(segment.band);
    photon.isDispersed = segment.isDispersed;
    return photon;
  }

  bool isAirKept;
};

std::vector<StoredPhoton> joined(std::vector<MapVisitor>& groups,
                                 std::vector<StoredPhoton> MapVisitor::*part) {
  std::vector<StoredPhoton> all;
  std::size_t count = 0;
  for (const MapVisitor& group : groups) count += (group.*part).size();
  all.reserve(count);
  for (MapVisitor& group : groups) {
    all.insert(all.end(), (group.*part).begin(), (group.*part).end());
    (group.*part) = {};
  }
  return all;
}

mat3 cameraFrame(const Camera& camera, uvec2 size) {
  const vec3 forward = normalize(camera.target - camera.position);
  const vec3 up = std::abs(dot(forward, normalize(camera.up))) < 0.9999f ? camera.up : vec3(0, 0, -1);
  const vec3 right = normalize(cross(forward, up));
  const float tangent = std::tan(0.5f * glm::radians(camera.verticalFov));
  return {right * (tangent * float(size.x) / float(size.y)), cross(right, forward) * tangent, forward};
}

}  // namespace

ReferenceImage::ReferenceImage(const Scene& sceneToSee, const RayScene& rays,
                               const ReferenceSettings& referenceSettings)
    : scene(sceneToSee),
      settings(referenceSettings),
      boundaries(scene, rays),
      lights(scene, Aim::casters),
      tracer(scene, boundaries, lights, settings.paths),
      sight(scene, boundaries, lights),
      camera(cameraFrame(scene.camera, settings.size)),
      pixelAngle(2 * length(camera[1]) / float(settings.size.y)),
      mediaOfCamera(boundaries.mediaAround(scene.camera.position)),
      total(std::size_t(settings.size.x) * settings.size.y),
      direct(total),
      caustics(total),
      shafts(total) {}

PassLight ReferenceImage::traceLight() const {
  const PhotonPass pass = photonPass(scene, settings.spectrum, settings.seed, passesDone, settings.photons);
  const bool scatters = scene.medium && scene.medium->extinction * scene.medium->albedo > 0;
  FluxLedger ledger;
  std::vector<MapVisitor> groups = tracePass(tracer, pass, MapVisitor(scatters), ledger);
  const float left = kernelLeft(passesDone);
  const float surfaceRadius = kFirstRadius * pixelAngle * std::sqrt(left);
  const float airRadius = kFirstRadiusInAir * pixelAngle * std::cbrt(left);
  const float middle = distance(scene.camera.target, scene.camera.position);  // m
  return {pass.bands,
          PhotonMap(joined(groups, &MapVisitor::onSurfaces), 2 * surfaceRadius * middle),
          PhotonMap(joined(groups, &MapVisitor::inAir), 2 * airRadius * middle),
          surfaceRadius,
          airRadius,
          3 * surfaceRadius * middle};
}

Ray ReferenceImage::rayThrough(vec2 pixel) const {
  const vec2 place = 2.0f * pixel / vec2(settings.size) - 1.0f;
  return {scene.camera.position, normalize(camera[2] + place.x * camera[0] - place.y * camera[1])};
}

void ReferenceImage::pass() {
  const PassLight light = traceLight();
  const std::size_t pixels = std::size_t(settings.size.x) * settings.size.y;
  std::vector<vec3> all(pixels), straight(pixels), fromCasters(pixels), inAir(pixels);
  oneapi::tbb::parallel_for(0u, settings.size.y, [&](uint32_t row) {
    for (uint32_t column = 0; column < settings.size.x; ++column) {
      const std::size_t i = std::size_t(row) * settings.size.x + column;
      Random random = randomOf(~settings.seed, passesDone, i);
      const vec2 pixel(float(column) + random.uniform(), float(row) + random.uniform());
      const Seen seen = sight.look(rayThrough(pixel), mediaOfCamera, light, random);
      straight[i] = seen.direct;
      fromCasters[i] = seen.caustics;
      inAir[i] = seen.shafts;
      all[i] = seen.direct + seen.caustics + seen.shafts + seen.rest;
    }
  });
  ++passesDone;
  total.add(all, passesDone);
  direct.add(straight, passesDone);
  caustics.add(fromCasters, passesDone);
  shafts.add(inAir, passesDone);
}

double ReferenceImage::noise() const {
  const double ofCaustics = caustics.noise();
  return std::isfinite(ofCaustics) ? ofCaustics : total.noise();
}

Image ReferenceImage::image() const {
  Image image;
  image.width = settings.size.x;
  image.height = settings.size.y;
  total.writeMean(image, "");
  direct.writeMean(image, "direct.");
  caustics.writeMean(image, "caustics.");
  shafts.writeMean(image, "shafts.");
  total.writeVariance(image, "variance.");
  caustics.writeVariance(image, "caustics.variance.");
  image.channel("depth.Z");
  for (const char* axis : {"normal.X", "normal.Y", "normal.Z"}) image.channel(axis);
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const Ray ray = rayThrough(vec2(i % settings.size.x, i / settings.size.x) + 0.5f);
    Hit hit;
    if (!boundaries.rayScene().intersect(ray, hit)) continue;
    const vec3 normal = dot(ray.direction, hit.geometricNormal) < 0 ? hit.normal : -hit.normal;
    image.channel("depth.Z")[i] = hit.distance * dot(ray.direction, camera[2]);
    for (int axis = 0; axis < 3; ++axis)
      image.channel(std::string("normal.") + "XYZ"[axis])[i] = normal[axis];
  }
  return image;
}

void ReferenceImage::restore(const Image& image, uint32_t passes) {
  total.readMean(image, "");
  direct.readMean(image, "direct.");
  caustics.readMean(image, "caustics.");
  shafts.readMean(image, "shafts.");
  total.readVariance(image, "variance.");
  caustics.readVariance(image, "caustics.variance.");
  passesDone = passes;
}

}  // namespace nephroid
