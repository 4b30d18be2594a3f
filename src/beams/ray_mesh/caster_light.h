// One lamp's light, of one band, onto one caster: its triangles, and where paths begin on them.
#pragma once

#include <vector>

#include "beams/ray_mesh/path_tree.h"
#include "core/color.h"
#include "lights/lamp_cells.h"
#include "lights/light_intensity.h"

namespace nephroid {

struct CasterLight {
  uint32_t object = 0;
  Emitter emitter{};
  ShapedLight light;
  LampSpread spread;    // of what the emitter stands for, where the lamp has a size
  uint16_t medium = 0;  // that the emitter stands in, of the media table
  uint8_t channel = 0;
  vec3 bandColor{1};  // the part of each color channel that travels in this band
  float facing = 1;   // -1 where the light stands inside the caster and meets its triangles from behind
};

// All that casters get, lamp by lamp. Where materials disperse, one for each channel.
struct LightOntoCasters {
  std::vector<CasterLight> lights;
  uint32_t fewSkyParts = 0;  // that a sky is, where the error would take more than can be followed; else 0
};

// `error`: that the light may have, of its mean.
LightOntoCasters lightOntoCasters(const Scene& scene, const RayScene& rays, float error, CutSkies& skies,
                                  MediaTable& media);

// A point of a triangle of a caster's mesh, by weights of its second and third corner. World space.
struct EntryPoint {
  vec3 position{0};      // m, on the curved surface where the mesh has one
  vec3 flatPosition{0};  // m, on the triangle
  vec3 normal{0};        // unit, smooth
  vec3 geometricNormal{0};
  uint32_t patch = 0;
  bool isCurved = false;  // between the vertices of its mesh
};
// m, on the curved surface.
vec3 entryPosition(const Scene& scene, uint32_t object, uint32_t triangle, vec2 weights);
EntryPoint entryPoint(const Scene& scene, const RayScene& rays, uint32_t object, uint32_t triangle,
                      vec2 weights);

// What lies there, for light that comes along `direction`.
Hit placeOf(const EntryPoint& entry, uint32_t object, uint32_t triangle, vec3 direction,
            const RayScene& rays);

// The first node of the path that begins there.
PathNode firstNode(const CasterLight& light, const EntryPoint& entry, uint32_t corner);

// lm onto the triangle between three points of the caster's surface; none where it faces away.
vec3 fluxBetween(const Scene& scene, const CasterLight& light, vec3 a, vec3 b, vec3 c);

}  // namespace nephroid
