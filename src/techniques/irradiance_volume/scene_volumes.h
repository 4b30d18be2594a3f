// The irradiance volumes of a scene's casters.
#pragma once

#include <memory>
#include <vector>

#include "irradiance_volume/volume.h"
#include "techniques/irradiance_volume/settings.h"
#include "techniques/settings.h"

namespace nephroid {

// The volumes of a scene's casters and which of them each object uses; none where an object casts no caustic
// of its own. Casters alike in mesh, material and scale where they absorb share theirs.
struct SceneVolumes {
  std::vector<std::unique_ptr<IrradianceVolume>> volumes;
  std::vector<IrradianceVolume*> ofObject;
};

// From `settings.baked`, or traced as they are asked for and kept in the cache. The scene's meshes must
// outlive them. Throws InputError where the baked file is not of this scene.
SceneVolumes sceneVolumes(const Scene& scene, const TechniqueSettings& settings);

// What the technique would look up for the lights of `scene` is traced where the cache does not hold it, and
// kept there.
void keepLightSamples(const Scene& scene, const TechniqueSettings& settings, Progress& progress);

}  // namespace nephroid
