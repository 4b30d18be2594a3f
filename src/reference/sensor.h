// Photons counted on an illuminance meter: no kernel, no bias.
#pragma once

#include "reference/estimate.h"
#include "reference/photons.h"
#include "reference/refine.h"

namespace nephroid {

class ReferenceSensor final : public Estimate {
 public:
  // All must outlive this.
  ReferenceSensor(const Scene& scene, const RayScene& rays, const Sensor& sensor,
                  const ReferenceSettings& settings);

  void pass() override;
  double noise() const override;
  // lux: R,G,B the total; direct., caustics. and ambient.; variance., caustics.variance., standard_error. and
  // caustics.standard_error. of the total and of the caustics.
  Image image() const override;
  void restore(const Image& image, uint32_t passes) override;

  // Of all photons traced by this so far, divided by the number of passes.
  FluxLedger ledger() const;

 private:
  std::vector<vec3> countPhotons();
  std::vector<vec3> measureDirect() const;
  vec3 directAt(uvec2 texel, Random& random) const;

  const Scene& scene;
  const Sensor& sensor;
  ReferenceSettings settings;
  Boundaries boundaries;
  Lights lights;
  PhotonTracer tracer;
  uint32_t medium;  // the object the sensor is inside of
  RunningMean total, direct, caustics;
  FluxLedger flux;
  uint32_t passesTraced = 0;
};

}  // namespace nephroid
