// What an illuminance meter in the scene reads.
#pragma once

#include "core/image.h"
#include "core/progress.h"
#include "core/stats.h"
#include "scene/scene.h"
#include "trace/ray_scene.h"
#include "transport/source.h"

namespace nephroid {

// Illuminance (lux) of one kind of light on a sensor's texels, rows first.
using SensorLayer = std::vector<vec3>;

// Light that met no caster: shadow rays from a grid of points in every texel to every emitter.
SensorLayer measureDirect(const Scene& scene, const RayScene& rays, const Sensor& sensor, Progress& progress);

// Light that met at least one caster, by beams cut by the sensor's own plane: no virtual planes and no
// device. Counts of rays and beams are added to `stats`.
SensorLayer measureBeams(const Scene& scene, const RayScene& rays, const TransportSource& source,
                         const Sensor& sensor, Paths paths, uint32_t refineDepth, Progress& progress,
                         Stats& stats);

// The layers as an image with R,G,B (the total), direct.R,G,B, caustics.R,G,B and ambient.R,G,B.
Image sensorImage(const Scene& scene, const Sensor& sensor, const SensorLayer& direct,
                  const SensorLayer& caustics);

}  // namespace nephroid
