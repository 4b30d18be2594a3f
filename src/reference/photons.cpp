#include "reference/photons.h"

#include <algorithm>

namespace nephroid {
namespace {

// Encounters of a photon that is trapped by total reflection or between mirrors, and what is left of one that
// is not worth following.
constexpr uint32_t kMostEncounters = 4096;
constexpr float kLeastThroughput = 1e-7f;

// Of 2^32. Numbers that go on by such a step fill [0, 1) evenly, from wherever they begin and however few
// they are, in pairs too (the plastic number's powers, Roberts 2018).
constexpr uint32_t kStepOfPlaces = 3242174889u, kStepOfBands = 2447445414u;

float stepped(uint32_t first, uint32_t index, uint32_t step) {
  return float((first + index * step) >> 8) * 0x1p-24f;
}

float largest(vec3 v) {
  return std::max({v.x, v.y, v.z});
}

}  // namespace

vec3 PhotonSegment::transmittance(const Boundaries& boundaries, float distance) const {
  return isWeakened ? boundaries.transmittance(medium, ray.origin, ray.direction, distance) : vec3(1);
}

struct PhotonTracer::Photon {
  Path path;
  Ray ray;
  vec3 emitted{0};  // lm
  uint32_t band = 0;
  uint32_t index = 0;
  bool comesFromAfar = false;  // and has met nothing yet, so that no air has weakened it
  Hit hit;
  uint32_t encounters = 0;
  vec3 flux() const { return emitted * path.throughput; }
};

FluxLedger& FluxLedger::operator+=(const FluxLedger& other) {
  emitted += other.emitted;
  received += other.received;
  absorbed += other.absorbed;
  escaped += other.escaped;
  lost += other.lost;
  return *this;
}

PhotonPass photonPass(const Scene& scene, Spectrum spectrum, uint64_t seed, uint64_t index,
                      uint32_t photons) {
  Random random = randomOf(seed, index, ~uint64_t{0});
  PhotonPass pass{seed, index, photons, chooseBands(scene, spectrum, random)};
  pass.firstBand = random.next();
  pass.firstPlace = random.next();
  return pass;
}

PhotonTracer::PhotonTracer(const Scene& scene, const Boundaries& sceneBoundaries, const Lights& sceneLights,
                           Paths followed)
    : boundaries_(sceneBoundaries), lights_(sceneLights), paths_(followed) {
  for (uint32_t light = 0; light < scene.lights.size(); ++light)
    mediaOfLights_.push_back(lights_.comesFromAfar(light)
                                 ? MediumStack{}
                                 : boundaries_.mediaAround(middleOf(scene.lights[light])));
}

// The first glass sends two photons on: what it reflects is a small part of the light over a wide field,
// which few whole photons would light with much noise.
FluxLedger PhotonTracer::trace(const PhotonPass& pass, uint32_t first, uint32_t last,
                               PhotonVisitor& visitor) const {
  FluxLedger ledger;
  for (uint32_t place = first; place < last; ++place) {
    const uint32_t index = pass.part + place * pass.parts;
    Random random = randomOf(pass.seed, pass.index, index);
    Photon photon = emit(pass, index, random);
    ledger.emitted += glm::dvec3(photon.emitted);
    if (!fly(random, photon, visitor, ledger)) continue;
    Choice choice = paths_ == Paths::transmission ? Choice::transmitted : Choice::random;
    const Material& material = boundaries_.materialOf(photon.hit);
    if (choice == Choice::random && material.type == MaterialType::dielectric) {
      Photon reflected = photon;
      if (meetCaster(pass, Choice::reflected, random, reflected, ledger))
        follow(pass, random, reflected, visitor, ledger);
      choice = Choice::transmitted;
    }
    if (meetCaster(pass, choice, random, photon, ledger)) follow(pass, random, photon, visitor, ledger);
  }
  return ledger;
}

void PhotonTracer::follow(const PhotonPass& pass, Random& random, Photon& photon, PhotonVisitor& visitor,
                          FluxLedger& ledger) const {
  const Choice choice = paths_ == Paths::transmission ? Choice::transmitted : Choice::random;
  while (fly(random, photon, visitor, ledger) && meetCaster(pass, choice, random, photon, ledger)) {
  }
}

PhotonTracer::Photon PhotonTracer::emit(const PhotonPass& pass, uint32_t index, Random& random) const {
  const auto [choice, weight] = guide_.at((double(index) + random.uniform()) / pass.photons);
  const EmittedPhoton emitted = lights_.emit(choice, stepped(pass.firstPlace, index, kStepOfPlaces));
  Photon photon;
  photon.index = index;
  photon.emitted = emitted.flux * (weight / float(pass.photons));
  photon.path.direction = emitted.direction;
  photon.path.media = lights_.meetsCaster(emitted.light) ? boundaries_.mediaAround(emitted.origin)
                                                         : mediaOfLights_[emitted.light];
  photon.ray = {emitted.origin, emitted.direction};
  photon.comesFromAfar = lights_.comesFromAfar(emitted.light);
  if (pass.bands.size() > 1)
    photon.band = uint32_t(stepped(pass.firstBand, index, kStepOfBands) * float(pass.bands.size()));
  return photon;
}

// To the next surface. False: it ends there, or nowhere.
bool PhotonTracer::fly(Random& random, Photon& photon, PhotonVisitor& visitor, FluxLedger& ledger) const {
  Path& path = photon.path;
  Hit& hit = photon.hit;
  const bool isHit = boundaries_.rayScene().intersect(photon.ray, hit);
  PhotonSegment segment;
  segment.ray = photon.ray;
  segment.length = isHit ? hit.distance : std::numeric_limits<float>::infinity();
  segment.flux = photon.flux();
  segment.metCaster = path.metCaster;
  segment.medium = path.media.top();
  segment.isWeakened = !photon.comesFromAfar;
  segment.endsOnReceiver = isHit && !boundaries_.isCaster(hit);
  segment.isDispersed = path.isDispersed;
  segment.band = photon.band;
  segment.photon = photon.index;
  segment.sample = random.uniform();
  visitor.segment(segment);
  path.throughput *= segment.transmittance(boundaries_, segment.length);
  const vec3 flux = photon.flux();
  ledger.absorbed += glm::dvec3(segment.flux) - glm::dvec3(flux);
  if (segment.endsOnReceiver && path.metCaster) visitor.landing(segment, hit, flux);
  if (segment.endsOnReceiver) ledger.received += glm::dvec3(flux);
  if (!isHit) ledger.escaped += glm::dvec3(flux);
  photon.comesFromAfar = false;
  return isHit && !segment.endsOnReceiver;
}

// On from a caster. False: the photon ends here.
bool PhotonTracer::meetCaster(const PhotonPass& pass, Choice choice, Random& random, Photon& photon,
                              FluxLedger& ledger) const {
  const vec3 arriving = photon.flux();
  const bool goesOn = boundaries_.send(photon.hit, pass.bands[photon.band], Carried::flux, choice,
                                       random.uniform(), photon.path);
  const vec3 leaving = photon.flux();
  const bool isSplit =
      paths_ == Paths::all && choice != Choice::random;  // the other part is a photon as well
  if (!isSplit) {
    const bool isLost =
        paths_ == Paths::transmission && boundaries_.materialOf(photon.hit).type == MaterialType::dielectric;
    (isLost ? ledger.lost : ledger.absorbed) += glm::dvec3(arriving) - glm::dvec3(leaving);
  }
  if (!goesOn && isSplit && choice == Choice::transmitted) return false;  // all of it was reflected
  if (!goesOn || ++photon.encounters > kMostEncounters ||
      largest(photon.path.throughput) < kLeastThroughput) {
    ledger.lost += glm::dvec3(leaving);
    return false;
  }
  photon.ray = boundaries_.rayScene().leavingTriangle(photon.hit, photon.path.direction);
  return true;
}

}  // namespace nephroid
