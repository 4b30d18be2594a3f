// The picture of a scene, right but slow: progressive photon mapping for light that met a caster, path
// tracing for the rest. Knaus and Zwicker 2011: passes with shrinking radii that share nothing, so that their
// mean converges to the truth and their spread tells how far it is.
#pragma once

#include "reference/estimate.h"
#include "reference/photon_keeper.h"
#include "reference/photons.h"
#include "reference/pinhole.h"
#include "reference/refine.h"
#include "reference/sight.h"

namespace nephroid {

class ReferenceImage final : public Estimate {
 public:
  // All must outlive this.
  ReferenceImage(const Scene& scene, const RayScene& rays, const ReferenceSettings& settings);

  void pass() override;
  double noise() const override;
  // nit: R,G,B the total; direct., caustics. and shafts.; variance. and caustics.variance. of the total and
  // of the caustics; depth.Z (m along the view, 0 where there is nothing) and normal.X,Y,Z of the nearest
  // surface.
  Image image() const override;
  void restore(const Image& image, uint32_t passes) override;

 private:
  PassLight traceLight(std::vector<Splat>& splats) const;

  const Scene& scene;
  ReferenceSettings settings;
  Boundaries boundaries;
  Lights lights;
  PhotonTracer tracer;
  Sight sight;
  Pinhole camera;
  MediumStack mediaOfCamera;
  RunningMean total, direct, caustics, shafts;
};

}  // namespace nephroid
