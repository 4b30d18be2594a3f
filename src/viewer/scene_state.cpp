#include "viewer/scene_state.h"

#include <algorithm>

namespace nephroid {
namespace {

constexpr std::size_t kMostStates = 1000;

// What of a material programs and tables are made for.
bool isPreparedAlike(const Material& a, const Material& b, const TechniqueSettings& settings) {
  const bool hasEmission = a.emission != vec3(0), willHaveEmission = b.emission != vec3(0);
  if (a.type != b.type || hasEmission != willHaveEmission) return false;
  if (settings.technique == "irradiance-volume")
    return a.ior == b.ior && a.color == b.color && a.attenuationColor == b.attenuationColor &&
           a.attenuationDistance == b.attenuationDistance;
  return settings.source == Source::traced || a.ior == b.ior;
}

bool isTinted(const SceneState& state) {
  return std::ranges::any_of(state.materials,
                             [](const Material& m) { return m.inverseAttenuationDistance() > 0; });
}

}  // namespace

SceneState stateOf(const Scene& scene) {
  SceneState state{scene.environment, scene.materials, {}, scene.lights, {}};
  for (const Object& object : scene.objects) state.placements.push_back(object.placement);
  if (scene.medium) state.air = {scene.medium->extinction, scene.medium->albedo, scene.medium->g};
  return state;
}

void apply(const SceneState& state, Scene& scene) {
  scene.environment = state.environment;
  scene.materials = state.materials;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) scene.objects[i].placement = state.placements[i];
  scene.lights = state.lights;
  if (!scene.medium || !state.air) return;
  scene.medium->extinction = state.air->extinction;
  scene.medium->albedo = state.air->albedo;
  scene.medium->g = state.air->g;
}

bool needsPreparation(const SceneState& before, const SceneState& after, const TechniqueSettings& settings) {
  const auto isAlike = [&](const Material& a, const Material& b) { return isPreparedAlike(a, b, settings); };
  if (!std::ranges::equal(before.materials, after.materials, isAlike)) return true;
  if (settings.technique != "irradiance-volume") return false;
  // What absorbs over a metre does so over less where the caster is scaled down.
  const auto isAsLarge = [](const Placement& a, const Placement& b) { return a.scale == b.scale; };
  return isTinted(after) && !std::ranges::equal(before.placements, after.placements, isAsLarge);
}

void History::replace(const SceneState& state) {
  const bool wasSaved = isSaved();
  states_[now_] = state;
  if (wasSaved) markSaved();
}

void History::add(const SceneState& state) {
  if (state == now()) return;
  states_.resize(now_ + 1);
  states_.push_back(state);
  if (states_.size() > kMostStates) states_.erase(states_.begin() + 1);
  now_ = states_.size() - 1;
}

}  // namespace nephroid
