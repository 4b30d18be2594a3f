// Traces photons from the lights through the casters to the point where they end.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include "reference/boundary.h"
#include "reference/lights.h"
#include "reference/photon_guide.h"
#include "reference/sampling.h"
#include "trace/paths.h"

namespace nephroid {

// A straight part of a photon's path. Its flux is without the weight of its band.
struct PhotonSegment {
  Ray ray;                  // m
  float length = 0;         // m; infinite where it escapes
  vec3 flux{0};             // lm at the start
  uint32_t medium = kNone;  // the object it is in
  bool isWeakened = true;   // the medium around it weakens it
  bool metCaster = false;   // it met a caster before; if not, it is direct light
  bool isInAir() const { return medium == kNone; }
  bool endsOnReceiver = false;
  bool isDispersed = false;
  uint32_t band = 0;    // of the pass
  uint32_t photon = 0;  // of the pass
  float sample = 0;     // a random number in [0, 1) for the visitor
  // The part (0..1 per channel) of its flux that is left after `distance` (m).
  vec3 transmittance(const Boundaries& boundaries, float distance) const;
};

// Is called for each part of each photon's path.
class PhotonVisitor {
 public:
  virtual ~PhotonVisitor() = default;
  virtual void segment(const PhotonSegment&) {}
  // Called where a photon that met a caster arrives at a diffuse surface. `flux`: lm, on arrival.
  virtual void landing(const PhotonSegment&, const Hit&, vec3 flux) { static_cast<void>(flux); }
};

// The balance of flux, in lm per channel: emitted = received + absorbed + escaped + lost.
struct FluxLedger {
  glm::dvec3 emitted{0};
  glm::dvec3 received{0};  // by diffuse surfaces
  glm::dvec3 absorbed{0};  // in materials, in the air and by mirrors
  glm::dvec3 escaped{0};
  glm::dvec3 lost{0};  // reflected although only transmission is followed, or trapped
  FluxLedger& operator+=(const FluxLedger& other);
};

// The settings of a pass. Each pass is an independent estimate. It may be traced in parts: every `parts`-th
// photon, from the one at `part`.
struct PhotonPass {
  uint64_t seed = 0;
  uint64_t index = 0;
  uint32_t photons = 0;  // of all parts
  std::vector<Band> bands;
  uint32_t firstBand = 0;   // of the photon at 0, in 2^-32 of all bands
  uint32_t firstPlace = 0;  // on a light with a size, of the photon at 0, in 2^-32 of its curve
  uint32_t part = 0, parts = 1;
  uint32_t photonsInPart() const { return (photons - part + parts - 1) / parts; }
};

PhotonPass photonPass(const Scene& scene, Spectrum spectrum, uint64_t seed, uint64_t index, uint32_t photons);

class PhotonTracer {
 public:
  // All must outlive this.
  PhotonTracer(const Scene& scene, const Boundaries& boundaries, const Lights& lights, Paths paths);

  // From now on sends photons so; until then, evenly.
  void guide(PhotonGuide by) { guide_ = std::move(by); }

  // Traces the photons `first` to `last` - 1 of a pass's part.
  FluxLedger trace(const PhotonPass& pass, uint32_t first, uint32_t last, PhotonVisitor& visitor) const;

  // Whether no photon can meet a caster.
  bool isDark() const { return lights_.isDark(); }

 private:
  struct Photon;
  Photon emit(const PhotonPass& pass, uint32_t index, Random& random) const;
  bool fly(Random& random, Photon& photon, PhotonVisitor& visitor, FluxLedger& ledger) const;
  bool meetCaster(const PhotonPass& pass, Choice choice, Random& random, Photon& photon,
                  FluxLedger& ledger) const;
  void follow(const PhotonPass& pass, Random& random, Photon& photon, PhotonVisitor& visitor,
              FluxLedger& ledger) const;

  const Boundaries& boundaries_;
  const Lights& lights_;
  Paths paths_;
  PhotonGuide guide_;
  std::vector<MediumStack> mediaOfLights_;  // around the middle of each
};

// Traces a pass's part; each group of photons has its own copy of `visitor`. Returns the copies in the order
// of the groups, so that results do not depend on the threads.
template <class Visitor>
std::vector<Visitor> tracePass(const PhotonTracer& tracer, const PhotonPass& pass, const Visitor& visitor,
                               FluxLedger& ledger) {
  constexpr uint32_t kPhotonsInGroup = 4096;
  const uint32_t groups =
      tracer.isDark() ? 0 : (pass.photonsInPart() + kPhotonsInGroup - 1) / kPhotonsInGroup;
  std::vector<Visitor> visitors(groups, visitor);
  std::vector<FluxLedger> ledgers(groups);
  oneapi::tbb::parallel_for(0u, groups, [&](uint32_t group) {
    const uint32_t first = group * kPhotonsInGroup;
    ledgers[group] =
        tracer.trace(pass, first, std::min(first + kPhotonsInGroup, pass.photonsInPart()), visitors[group]);
  });
  for (const FluxLedger& part : ledgers) ledger += part;
  return visitors;
}

}  // namespace nephroid
