// Casters, and small volumes of them.
#pragma once

#include "irradiance_volume/volume.h"

namespace nephroid {

inline Material glass() {
  Material material;
  material.type = MaterialType::dielectric;
  return material;
}

inline Material silver() {
  Material material;
  material.type = MaterialType::mirror;
  material.color = vec3(0.9f, 0.8f, 0.6f);
  return material;
}

inline VolumeSettings someSettings() {
  VolumeSettings settings;
  settings.representation = kRepresentationGrid;
  settings.kilobytes = 90;
  settings.lightLevel = 1;
  settings.photons = 30;
  return settings;
}

inline Symmetry symmetryOf(const Mesh& mesh) {
  return findSymmetry(RayScene(mesh), boundingSphere(mesh));
}

}  // namespace nephroid
