#include "reference/sensor.h"

#include <cmath>

#include "reference/direct.h"
#include "scene/checks.h"

namespace nephroid {
namespace {

constexpr uint32_t kShadowGrid = 2;  // points along a texel's side that look at each light in a pass

// Where photons cross the sensor's rectangle, against its normal.
class SensorVisitor final : public PhotonVisitor {
 public:
  struct Count {
    uint32_t texel;
    vec3 flux;  // lm
  };

  SensorVisitor(const Sensor& meter, const std::vector<Band>& bandsOfPass,
                const Boundaries& boundariesOfScene, float tolerance)
      : boundaries(&boundariesOfScene),
        corner(meter.corner),
        normal(cross(glm::dvec3(meter.v), glm::dvec3(meter.u))),
        resolution(meter.resolution),
        bands(&bandsOfPass),
        margin(tolerance) {
    // u and v need not be perpendicular: the part of one along the other is taken off.
    const glm::dvec3 u(meter.u), v(meter.v);
    across = cross(v, normal) / dot(u, cross(v, normal));
    along = cross(normal, u) / dot(v, cross(normal, u));
  }

  void segment(const PhotonSegment& segment) override {
    if (!segment.metCaster) return;
    const glm::dvec3 origin(segment.ray.origin), direction(segment.ray.direction);
    const double approach = dot(direction, normal);
    if (approach >= 0) return;
    const double distance = dot(corner - origin, normal) / approach;  // m
    // A meter that lies on a receiver is before it, whatever the rounding.
    if (distance < 0 || distance > double(segment.length) + (segment.endsOnReceiver ? margin : 0.0)) return;
    const glm::dvec3 place = origin + distance * direction - corner;
    const double column = dot(place, across) * resolution.x;
    const double row = dot(place, along) * resolution.y;
    if (!(column >= 0 && column < resolution.x && row >= 0 && row < resolution.y)) return;
    vec3 flux = segment.flux;
    if (segment.isDispersed) flux *= (*bands)[segment.band].weight;
    flux *= segment.transmittance(*boundaries, float(distance));
    counts.push_back({uint32_t(row) * resolution.x + uint32_t(column), flux});
  }

  std::vector<Count> counts;

 private:
  const Boundaries* boundaries;
  glm::dvec3 corner, normal, across, along;
  uvec2 resolution;
  const std::vector<Band>* bands;
  double margin;  // m
};

float toleranceOf(const RayScene& rays) {
  return 10 * rays.selfIntersectionDistance();
}

}  // namespace

ReferenceSensor::ReferenceSensor(const Scene& sceneToMeasure, const RayScene& rays, const Sensor& meter,
                                 const ReferenceSettings& referenceSettings)
    : scene(sceneToMeasure),
      sensor(meter),
      settings(referenceSettings),
      boundaries(scene, rays),
      lights(scene, Aim::casters),
      tracer(scene, boundaries, lights, settings.paths),
      medium(
          boundaries
              .mediaAround(sensor.corner + 0.5f * (sensor.u + sensor.v) + toleranceOf(rays) * sensor.normal())
              .top()),
      total(std::size_t(sensor.resolution.x) * sensor.resolution.y),
      direct(total),
      caustics(total) {
  checkSensor(sensor);
}

void ReferenceSensor::pass() {
  const std::vector<vec3> fromCasters = countPhotons();
  const std::vector<vec3> straight = measureDirect();
  std::vector<vec3> all(fromCasters.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = fromCasters[i] + straight[i] + scene.environment.ambient;
  ++passesDone;
  total.add(all, passesDone);
  direct.add(straight, passesDone);
  caustics.add(fromCasters, passesDone);
}

std::vector<vec3> ReferenceSensor::countPhotons() {
  const PhotonPass pass = photonPass(scene, settings.spectrum, settings.seed, passesDone, settings.photons);
  const std::vector<SensorVisitor> groups = tracePass(
      tracer, pass, SensorVisitor(sensor, pass.bands, boundaries, toleranceOf(boundaries.rayScene())), flux);
  ++passesTraced;
  std::vector<glm::dvec3> lumens(std::size_t(sensor.resolution.x) * sensor.resolution.y, glm::dvec3(0));
  for (const SensorVisitor& group : groups)
    for (const SensorVisitor::Count& count : group.counts) lumens[count.texel] += glm::dvec3(count.flux);
  const double texelArea = length(cross(glm::dvec3(sensor.v), glm::dvec3(sensor.u))) / double(lumens.size());
  std::vector<vec3> lux(lumens.size());
  for (std::size_t i = 0; i < lux.size(); ++i) lux[i] = vec3(lumens[i] / texelArea);
  return lux;
}

std::vector<vec3> ReferenceSensor::measureDirect() const {
  std::vector<vec3> lux(std::size_t(sensor.resolution.x) * sensor.resolution.y);
  oneapi::tbb::parallel_for(0u, sensor.resolution.y, [&](uint32_t row) {
    for (uint32_t column = 0; column < sensor.resolution.x; ++column) {
      const std::size_t texel = std::size_t(row) * sensor.resolution.x + column;
      Random random = randomOf(~settings.seed, passesDone, texel);
      lux[texel] = directAt({column, row}, random);
    }
  });
  return lux;
}

// The mean over a texel, a random point in each part of it.
vec3 ReferenceSensor::directAt(uvec2 texel, Random& random) const {
  vec3 sum(0);
  for (uint32_t i = 0; i < kShadowGrid * kShadowGrid; ++i) {
    const vec2 within =
        vec2(float(i % kShadowGrid) + random.uniform(), float(i / kShadowGrid) + random.uniform());
    const vec2 place = (vec2(texel) + within / float(kShadowGrid)) / vec2(sensor.resolution);
    LitPoint point;
    point.position = sensor.corner + sensor.u * place.x + sensor.v * place.y;
    point.normal = point.geometricNormal = sensor.normal();
    point.medium = medium;
    point.clearance = toleranceOf(boundaries.rayScene());
    for (uint32_t light = 0; light < lights.count(); ++light)
      sum += directIlluminance(boundaries, lights, light, point, random);
  }
  return sum / float(kShadowGrid * kShadowGrid);
}

double ReferenceSensor::noise() const {
  const double ofCaustics = caustics.noise();
  return std::isfinite(ofCaustics) ? ofCaustics : total.noise();
}

Image ReferenceSensor::image() const {
  Image image;
  image.width = sensor.resolution.x;
  image.height = sensor.resolution.y;
  total.writeMean(image, "");
  direct.writeMean(image, "direct.");
  caustics.writeMean(image, "caustics.");
  for (int c = 0; c < 3; ++c)
    for (float& value : image.channel(std::string("ambient.") + "RGB"[c]))
      value = scene.environment.ambient[c];
  total.writeVariance(image, "variance.");
  total.writeStandardError(image, "standard_error.");
  caustics.writeVariance(image, "caustics.variance.");
  caustics.writeStandardError(image, "caustics.standard_error.");
  return image;
}

void ReferenceSensor::restore(const Image& image, uint32_t passes) {
  total.readMean(image, "");
  direct.readMean(image, "direct.");
  caustics.readMean(image, "caustics.");
  total.readVariance(image, "variance.");
  caustics.readVariance(image, "caustics.variance.");
  passesDone = passes;
}

FluxLedger ReferenceSensor::ledger() const {
  FluxLedger mean = flux;
  for (glm::dvec3* part : {&mean.emitted, &mean.received, &mean.absorbed, &mean.escaped, &mean.lost})
    *part /= std::max(passesTraced, 1u);
  return mean;
}

}  // namespace nephroid
