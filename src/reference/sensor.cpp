#include "reference/sensor.h"

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
      : boundaries_(&boundariesOfScene),
        corner_(meter.corner),
        normal_(cross(glm::dvec3(meter.v), glm::dvec3(meter.u))),
        resolution_(meter.resolution),
        bands_(&bandsOfPass),
        margin_(tolerance) {
    // u and v need not be perpendicular: the part of one along the other is taken off.
    const glm::dvec3 u(meter.u), v(meter.v);
    across_ = cross(v, normal_) / dot(u, cross(v, normal_));
    along_ = cross(normal_, u) / dot(v, cross(normal_, u));
  }

  void segment(const PhotonSegment& segment) override {
    if (!segment.metCaster) return;
    const glm::dvec3 origin(segment.ray.origin), direction(segment.ray.direction);
    const double approach = dot(direction, normal_);
    if (approach >= 0) return;
    const double distance = dot(corner_ - origin, normal_) / approach;  // m
    // A meter that lies on a receiver is before it, whatever the rounding.
    const double spare = segment.endsOnReceiver ? margin_ * length(normal_) / -approach : 0.0;
    if (distance < 0 || distance > double(segment.length) + spare) return;
    const glm::dvec3 place = origin + distance * direction - corner_;
    const double column = dot(place, across_) * resolution_.x;
    const double row = dot(place, along_) * resolution_.y;
    if (!(column >= 0 && column < resolution_.x && row >= 0 && row < resolution_.y)) return;
    vec3 flux = segment.flux;
    if (segment.isDispersed) flux *= (*bands_)[segment.band].weight;
    flux *= segment.transmittance(*boundaries_, float(distance));
    counts.push_back({uint32_t(row) * resolution_.x + uint32_t(column), flux});
  }

  std::vector<Count> counts;

 private:
  const Boundaries* boundaries_;
  glm::dvec3 corner_, normal_, across_, along_;
  uvec2 resolution_;
  const std::vector<Band>* bands_;
  double margin_;  // m, across the receiver
};

float toleranceOf(const RayScene& rays) {
  return 2 * rays.largestRounding();
}

}  // namespace

ReferenceSensor::ReferenceSensor(const Scene& sceneToMeasure, const RayScene& rays, const Sensor& meter,
                                 const ReferenceSettings& referenceSettings)
    : scene_(sceneToMeasure),
      sensor_(meter),
      settings_(referenceSettings),
      boundaries_(scene_, rays),
      lights_(scene_, Aim::casters),
      tracer_(scene_, boundaries_, lights_, settings_.paths),
      medium_(boundaries_
                  .mediaAround(sensor_.corner + 0.5f * (sensor_.u + sensor_.v) +
                               toleranceOf(rays) * sensor_.normal())
                  .top()),
      total_(std::size_t(sensor_.resolution.x) * sensor_.resolution.y),
      direct_(total_),
      caustics_(total_) {
  checkSensor(sensor_);
}

void ReferenceSensor::pass() {
  const std::vector<vec3> fromCasters = countPhotons();
  const std::vector<vec3> straight = measureDirect();
  std::vector<vec3> all(fromCasters.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = fromCasters[i] + straight[i] + scene_.environment.ambient;
  ++passesDone_;
  total_.add(all, passesDone_);
  direct_.add(straight, passesDone_);
  caustics_.add(fromCasters, passesDone_);
}

std::vector<vec3> ReferenceSensor::countPhotons() {
  const PhotonPass pass =
      photonPass(scene_, settings_.spectrum, settings_.seed, passesDone_, settings_.photons);
  const std::vector<SensorVisitor> groups =
      tracePass(tracer_, pass,
                SensorVisitor(sensor_, pass.bands, boundaries_, toleranceOf(boundaries_.rayScene())), flux_);
  ++passesTraced_;
  std::vector<glm::dvec3> lumens(std::size_t(sensor_.resolution.x) * sensor_.resolution.y, glm::dvec3(0));
  for (const SensorVisitor& group : groups)
    for (const SensorVisitor::Count& count : group.counts) lumens[count.texel] += glm::dvec3(count.flux);
  const double texelArea =
      length(cross(glm::dvec3(sensor_.v), glm::dvec3(sensor_.u))) / double(lumens.size());
  std::vector<vec3> lux(lumens.size());
  for (std::size_t i = 0; i < lux.size(); ++i) lux[i] = vec3(lumens[i] / texelArea);
  return lux;
}

std::vector<vec3> ReferenceSensor::measureDirect() const {
  std::vector<vec3> lux(std::size_t(sensor_.resolution.x) * sensor_.resolution.y);
  oneapi::tbb::parallel_for(0u, sensor_.resolution.y, [&](uint32_t row) {
    for (uint32_t column = 0; column < sensor_.resolution.x; ++column) {
      const std::size_t texel = std::size_t(row) * sensor_.resolution.x + column;
      Random random = randomOf(~settings_.seed, passesDone_, texel);
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
    const vec2 place = (vec2(texel) + within / float(kShadowGrid)) / vec2(sensor_.resolution);
    LitPoint point;
    point.position = sensor_.corner + sensor_.u * place.x + sensor_.v * place.y;
    point.normal = point.geometricNormal = sensor_.normal();
    point.medium = medium_;
    point.rounding = toleranceOf(boundaries_.rayScene());
    for (uint32_t light = 0; light < lights_.count(); ++light)
      sum += directIlluminance(boundaries_, lights_, light, point, random.uniform());
  }
  return sum / float(kShadowGrid * kShadowGrid);
}

double ReferenceSensor::noise() const {
  return noiseOf(passesDone_, caustics_, total_);
}

Image ReferenceSensor::image() const {
  Image image;
  image.width = sensor_.resolution.x;
  image.height = sensor_.resolution.y;
  total_.writeMean(image, "");
  direct_.writeMean(image, "direct.");
  caustics_.writeMean(image, "caustics.");
  for (int c = 0; c < 3; ++c)
    for (float& value : image.channel(std::string("ambient.") + "RGB"[c]))
      value = scene_.environment.ambient[c];
  total_.writeVariance(image, "variance.");
  total_.writeStandardError(image, "standard_error.");
  caustics_.writeVariance(image, "caustics.variance.");
  caustics_.writeStandardError(image, "caustics.standard_error.");
  return image;
}

void ReferenceSensor::restore(const Image& image, uint32_t passes) {
  total_.readMean(image, "");
  direct_.readMean(image, "direct.");
  caustics_.readMean(image, "caustics.");
  total_.readVariance(image, "variance.");
  caustics_.readVariance(image, "caustics.variance.");
  passesDone_ = passes;
}

FluxLedger ReferenceSensor::ledger() const {
  FluxLedger mean = flux_;
  for (glm::dvec3* part : {&mean.emitted, &mean.received, &mean.absorbed, &mean.escaped, &mean.lost})
    *part /= std::max(passesTraced_, 1u);
  return mean;
}

}  // namespace nephroid
