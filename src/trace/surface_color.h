// The color of a surface at a place of it.
#pragma once

#include "trace/ray_scene.h"

namespace nephroid {

// The texture coordinate at a hit; 0 where the mesh has none.
vec2 texcoordAt(const Scene& scene, const Hit& hit);

// The reflectance of a diffuse material at a texture coordinate: bilinear between texels.
vec3 diffuseReflectance(const Scene& scene, const Material& material, vec2 texcoord);

// The same at a hit.
vec3 diffuseReflectance(const Scene& scene, const Hit& hit);

}  // namespace nephroid
