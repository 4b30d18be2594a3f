// The irradiance volumes of a scene's casters.
#pragma once

#include <memory>
#include <vector>

#include "irradiance_volume/volume.h"
#include "techniques/irradiance_volume/settings.h"
#include "techniques/settings.h"

namespace nephroid {

// The volumes of a scene's casters, and the volume of each object; null where an object makes no caustic.
// Casters with the same mesh and material share a volume; if the material absorbs, they must also have the
// same scale.
struct SceneVolumes {
  std::vector<std::unique_ptr<IrradianceVolume>> volumes;
  std::vector<IrradianceVolume*> ofObject;
};

// Takes the volumes from the file `settings.baked`; without one, light samples are traced when they are
// needed, and stored in the cache. The scene's meshes must outlive the volumes. Throws InputError where the
// baked file is not for this scene.
SceneVolumes sceneVolumes(const Scene& scene, const TechniqueSettings& settings);

// Traces the light samples that the lights of `scene` need, and stores them in the cache, where they are not
// yet there.
void keepLightSamples(const Scene& scene, const TechniqueSettings& settings, Progress& progress);

}  // namespace nephroid
