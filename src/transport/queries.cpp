#include "transport/queries.h"

#include <algorithm>

namespace nephroid {

// Every choice among the first four boundaries, then longer runs of reflections inside. What is left out has
// been through at least three reflections of some 4 % before total reflection, which needs no choice, is
// counted.
std::vector<uint32_t> reflectionChoices(const Material& material, Paths paths) {
  std::vector<uint32_t> generations{0};
  if (paths == Paths::transmission || material.thinWalled) return generations;
  for (uint32_t choice = 1; choice < 16; ++choice) generations.push_back(choice);
  for (const uint32_t inside : {0b11110u, 0b111110u}) generations.push_back(inside);
  return generations;
}

std::vector<BandQuery> queriesFor(const Scene& scene, uint32_t object, const Emitter& emitter,
                                  const MediumStack& mediaAround, Paths paths) {
  const bool disperses = std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& other) {
    const Material& material = scene.materialOf(other);
    return material.type == MaterialType::dielectric && material.isDispersive();
  });
  std::vector<BandQuery> queries;
  for (const uint32_t reflections : reflectionChoices(scene.materialOf(scene.objects[object]), paths)) {
    for (uint32_t channel = 0; channel < (disperses ? 3u : 1u); ++channel) {
      vec3 color(disperses ? 0.0f : 1.0f);
      color[int(channel)] = 1;
      queries.push_back({{object, emitter, channel, paths, reflections, mediaAround}, color});
    }
  }
  return queries;
}

}  // namespace nephroid
