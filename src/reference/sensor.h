// The reference for a sensor: photons are counted on its texels, without a kernel and without bias.
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
  // Channels in lux: R,G,B (the total), direct.R,G,B, caustics.R,G,B and ambient.R,G,B. Of the total and of
  // the caustics also variance. (lux^2) and standard_error. (lux), each with R,G,B; those of the caustics
  // begin with caustics.
  Image image() const override;
  void restore(const Image& image, uint32_t passes) override;

  // The balance of all photons that this object has traced, divided by the number of passes.
  FluxLedger ledger() const;

 private:
  std::vector<vec3> countPhotons();
  std::vector<vec3> measureDirect() const;
  vec3 directAt(uvec2 texel, Random& random) const;

  const Scene& scene_;
  const Sensor& sensor_;
  ReferenceSettings settings_;
  Boundaries boundaries_;
  Lights lights_;
  PhotonTracer tracer_;
  uint32_t medium_;  // the object the sensor is inside of
  RunningMean total_, direct_, caustics_;
  FluxLedger flux_;
  uint32_t passesTraced_ = 0;
};

}  // namespace nephroid
