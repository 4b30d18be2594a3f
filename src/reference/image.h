// The reference picture of a scene: correct but slow. It uses progressive photon mapping for light that met a
// caster, and path tracing for the rest. As in Knaus and Zwicker 2011, passes are independent and have
// shrinking radii. So their mean converges to the correct result, and their variance gives the error.
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
  // Channels in nit: R,G,B (the total), direct.R,G,B, caustics.R,G,B, shafts.R,G,B, and the variances (nit^2)
  // of total and caustics, variance.R,G,B and caustics.variance.R,G,B. Of the nearest surface: depth.Z (m
  // along the view, 0 where there is nothing) and normal.X,Y,Z.
  Image image() const override;
  void restore(const Image& image, uint32_t passes) override;

 private:
  // The sums of a pass, of each pixel.
  struct PassSums {
    std::vector<vec3> total, direct, caustics, shafts;
  };

  PhotonGuide findGuide() const;
  PassLight traceLight(const PhotonPass& pass, std::vector<Splat>& splats) const;
  void look(const PhotonPass& pass, const PassLight& light, PassSums& sums) const;

  const Scene& scene_;
  ReferenceSettings settings_;
  Boundaries boundaries_;
  Lights lights_;
  PhotonTracer tracer_;
  Sight sight_;
  Pinhole camera_;
  MediumStack mediaOfCamera_;
  RunningMean total_, direct_, caustics_, shafts_;
};

}  // namespace nephroid
