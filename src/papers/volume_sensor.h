// What an illuminance meter under a caster reads of its irradiance volume, and of the truth.
#pragma once

#include "core/progress.h"
#include "irradiance_volume/volume.h"
#include "render/measure.h"

namespace nephroid {

// The scene's first; it has one.
const Object& casterOf(const Scene& scene);

// Of the scene's first caster, with nothing in the cache.
IrradianceVolume volumeOf(const Scene& scene, const VolumeSettings& settings);

// Caustics of the scene's first light, which is directional, on its first sensor, from pointsAcross^2 points
// of every texel.
SensorLayer readVolume(const Scene& scene, IrradianceVolume& volume, LightInterpolation interpolation,
                       uint32_t pointsAcross);

// The same by the reference's photons: unbiased, noisy.
SensorLayer readReference(const Scene& scene, uint32_t passes);

// The same by beams that the sensor itself cuts, refined where they bend: without noise. Of light that a
// mirror reflects more than once they have the last way alone.
SensorLayer readBeams(const Scene& scene, Progress& progress);

double meanOf(const SensorLayer& layer);
// Root of the mean square difference.
double rootMeanSquare(const SensorLayer& a, const SensorLayer& b);

}  // namespace nephroid
