// Reads sensors (illuminance meters) in the scene.
#pragma once

#include "core/image.h"
#include "core/progress.h"
#include "core/stats.h"
#include "scene/scene.h"
#include "trace/ray_scene.h"
#include "transport/source.h"

namespace nephroid {

// Illuminance (lux) of one kind of light on a sensor's texels, [row * resolution.x + column].
using SensorLayer = std::vector<vec3>;

// Direct light, by shadow rays from points in every texel to every light; to lamps with a size as many as the
// error asks for, which is that of a texel's light over what it has without shadows.
SensorLayer measureDirect(const Scene& scene, const RayScene& rays, const Sensor& sensor, float error,
                          Progress& progress);

// Caustics, by beams that are cut at the sensor's own plane: without virtual planes and without a device.
// Adds the counts of rays and beams to `stats`.
SensorLayer measureBeams(const Scene& scene, const RayScene& rays, const TransportSource& source,
                         const Sensor& sensor, Paths paths, uint32_t refineDepth, Progress& progress,
                         Stats& stats);

// The layers as an image with R,G,B (the total), direct.R,G,B, caustics.R,G,B and ambient.R,G,B.
Image sensorImage(const Scene& scene, const Sensor& sensor, const SensorLayer& direct,
                  const SensorLayer& caustics);

}  // namespace nephroid
