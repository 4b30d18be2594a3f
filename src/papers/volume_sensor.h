// Reads an illuminance meter under a caster: by its irradiance volume, by the reference, and by beams.
#pragma once

#include "core/progress.h"
#include "irradiance_volume/volume.h"
#include "render/measure.h"

namespace nephroid {

// The first caster of the scene, which must have one.
const Object& casterOf(const Scene& scene);

// The irradiance volume of the first caster, without using the cache.
IrradianceVolume volumeOf(const Scene& scene, const VolumeSettings& settings);

// The caustics (lux) of the scene's first light, which must be directional, on its first sensor. Each texel
// is the mean of pointsAcross^2 points.
SensorLayer readVolume(const Scene& scene, IrradianceVolume& volume, LightInterpolation interpolation,
                       uint32_t pointsAcross);

// The same by the reference's photons: unbiased, noisy.
SensorLayer readReference(const Scene& scene, uint32_t passes);

// The same by beams, which are cut at the sensor's plane and refined where they bend: without noise. Where a
// mirror reflects light several times, only the last path is included.
SensorLayer readBeams(const Scene& scene, Progress& progress);

double meanOf(const SensorLayer& layer);
// The root mean square difference.
double rootMeanSquare(const SensorLayer& a, const SensorLayer& b);

}  // namespace nephroid
