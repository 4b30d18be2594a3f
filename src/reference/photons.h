// Photons from the lights through the casters to where they end.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include "reference/boundary.h"
#include "reference/lights.h"
#include "reference/sampling.h"
#include "trace/paths.h"

namespace nephroid {

// A photon on its way from one place to the next. Its flux is without the weight of its band.
struct PhotonSegment {
  Ray ray;                  // m
  float length = 0;         // m; infinite where it escapes
  vec3 flux{0};             // lm at the start
  uint32_t medium = kNone;  // the object it is in
  bool isWeakened = true;   // by what it is in
  bool metCaster = false;   // before; if not, it is direct light
  bool isInAir() const { return medium == kNone; }
  bool endsOnReceiver = false;
  bool isDispersed = false;
  uint32_t band = 0;  // of the pass
  float sample = 0;   // uniform in [0, 1), for the visitor
  // What is left of its flux after so many m.
  vec3 transmittance(const Boundaries& boundaries, float distance) const;
};

// Is told where photons go.
class PhotonVisitor {
 public:
  virtual ~PhotonVisitor() = default;
  virtual void segment(const PhotonSegment&) {}
  // The end of a segment on a diffuse surface, of a photon that met a caster; `flux` (lm) as it arrives.
  virtual void landing(const PhotonSegment&, const Hit&, vec3 flux) { static_cast<void>(flux); }
};

// What became of flux, lm per channel: emitted = received + absorbed + escaped + lost.
struct FluxLedger {
  glm::dvec3 emitted{0};
  glm::dvec3 received{0};  // by diffuse surfaces
  glm::dvec3 absorbed{0};  // in materials, in the air and by mirrors
  glm::dvec3 escaped{0};
  glm::dvec3 lost{0};  // reflected where paths are of transmission alone; trapped
  FluxLedger& operator+=(const FluxLedger& other);
};

// What the photons of a pass have in common. A pass is one estimate, independent of all others.
struct PhotonPass {
  uint64_t seed;
  uint64_t index;
  uint32_t photons;
  std::vector<Band> bands;
};

PhotonPass photonPass(const Scene& scene, Spectrum spectrum, uint64_t seed, uint64_t index, uint32_t photons);

class PhotonTracer {
 public:
  // All must outlive this.
  PhotonTracer(const Scene& scene, const Boundaries& boundaries, const Lights& lights, Paths paths);

  // Photons from `first` to before `last` of a pass.
  FluxLedger trace(const PhotonPass& pass, uint32_t first, uint32_t last, PhotonVisitor& visitor) const;

  // No photon would meet a caster.
  bool isDark() const { return lights.isDark(); }

 private:
  struct Photon;
  Photon emit(const PhotonPass& pass, uint32_t index, Random& random) const;
  bool fly(Random& random, Photon& photon, PhotonVisitor& visitor, FluxLedger& ledger) const;
  bool meetCaster(const PhotonPass& pass, Choice choice, Random& random, Photon& photon,
                  FluxLedger& ledger) const;
  void follow(const PhotonPass& pass, Random& random, Photon& photon, PhotonVisitor& visitor,
              FluxLedger& ledger) const;

  const Boundaries& boundaries;
  const Lights& lights;
  Paths paths;
  std::vector<MediumStack> mediaOfLights;  // around the middle of each
};

// Traces a whole pass, each group of photons with a copy of `visitor`. The copies come back in the order of
// the groups, so that what is put together from them does not depend on the threads.
template <class Visitor>
std::vector<Visitor> tracePass(const PhotonTracer& tracer, const PhotonPass& pass, const Visitor& visitor,
                               FluxLedger& ledger) {
  constexpr uint32_t kPhotonsInGroup = 4096;
  const uint32_t groups = tracer.isDark() ? 0 : (pass.photons + kPhotonsInGroup - 1) / kPhotonsInGroup;
  std::vector<Visitor> visitors(groups, visitor);
  std::vector<FluxLedger> ledgers(groups);
  oneapi::tbb::parallel_for(0u, groups, [&](uint32_t group) {
    const uint32_t first = group * kPhotonsInGroup;
    ledgers[group] =
        tracer.trace(pass, first, std::min(first + kPhotonsInGroup, pass.photons), visitors[group]);
  });
  for (const FluxLedger& part : ledgers) ledger += part;
  return visitors;
}

}  // namespace nephroid
