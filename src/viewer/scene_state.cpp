#include "viewer/scene_state.h"

#include <algorithm>

#include "geometry/shapes.h"
#include "scene/volume.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr std::size_t kMostStates = 1000;

// What of a material programs and tables are made for.
bool isPreparedAlike(const Material& a, const Material& b, const TechniqueSettings& settings) {
  const bool hasEmission = a.emission != vec3(0), willHaveEmission = b.emission != vec3(0);
  if (a.type != b.type || hasEmission != willHaveEmission) return false;
  if (settings.technique == "irradiance-volume")
    return a.ior == b.ior && a.color == b.color && a.attenuationColor == b.attenuationColor &&
           a.attenuationDistance == b.attenuationDistance && a.scattering == b.scattering;
  return settings.source == Source::traced || a.ior == b.ior;
}

std::vector<WaterDrop> dropsInto(const Object& object) {
  return object.water && object.water->simulation ? object.water->simulation->drops
                                                  : std::vector<WaterDrop>{};
}

void setDrops(Scene& scene, Object& object, std::vector<WaterDrop> drops) {
  if (!object.water->simulation) object.water->simulation.emplace();
  object.water->simulation->drops = std::move(drops);
  scene.meshes[object.mesh] = makeWater(*object.water, scene.time);
}

bool isTinted(const SceneState& state) {
  return std::ranges::any_of(state.materials, [](const Material& m) { return extinctionOf(m) != vec3(0); });
}

}  // namespace

SceneState stateOf(const Scene& scene) {
  SceneState state{scene.camera, scene.environment, scene.materials, {}, {}, scene.lights, {}};
  for (const Object& object : scene.objects) {
    state.placements.push_back(object.placement);
    state.drops.push_back(dropsInto(object));
  }
  if (scene.medium) state.air = {scene.medium->extinction, scene.medium->albedo, scene.medium->g};
  return state;
}

void apply(const SceneState& state, Scene& scene) {
  scene.camera = state.camera;
  scene.environment = state.environment;
  scene.materials = state.materials;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    Object& object = scene.objects[i];
    object.placement = state.placements[i];
    if (dropsInto(object) != state.drops[i]) setDrops(scene, object, state.drops[i]);
  }
  scene.lights = state.lights;
  if (!scene.medium || !state.air) return;
  scene.medium->extinction = state.air->extinction;
  scene.medium->albedo = state.air->albedo;
  scene.medium->g = state.air->g;
}

bool isSameScene(const SceneState& a, const SceneState& b) {
  SceneState other = b;
  other.camera.position = a.camera.position;
  other.camera.target = a.camera.target;
  other.camera.up = a.camera.up;
  return a == other;
}

bool takesStones(const Object& object) {
  return object.water && object.water->grid.x > 0;
}

void dropStone(Scene& scene, uint32_t object, vec2 place) {
  constexpr float kRadius = 0.025f, kDepth = 0.01f;  // of the water's shorter side
  Object& water = scene.objects[object];
  const float across = std::min(water.water->size.x, water.water->size.y);
  std::vector<WaterDrop> drops = dropsInto(water);
  drops.push_back({static_cast<float>(scene.time), place, kRadius * across, kDepth * across});
  setDrops(scene, water, std::move(drops));
}

bool needsPreparation(const SceneState& before, const SceneState& after, const TechniqueSettings& settings) {
  const auto isAlike = [&](const Material& a, const Material& b) { return isPreparedAlike(a, b, settings); };
  if (!std::ranges::equal(before.materials, after.materials, isAlike)) return true;
  if (settings.technique != "irradiance-volume") return false;
  // What absorbs over a metre does so over less where the caster is scaled down.
  const auto isAsLarge = [](const Placement& a, const Placement& b) { return a.scale == b.scale; };
  return isTinted(after) && !std::ranges::equal(before.placements, after.placements, isAsLarge);
}

void History::changeAll(const std::function<void(SceneState&)>& change) {
  for (SceneState& state : states_) change(state);
  change(saved_);
}

void History::add(const SceneState& state) {
  if (state == now()) return;
  states_.resize(now_ + 1);
  states_.push_back(state);
  if (states_.size() > kMostStates) states_.erase(states_.begin() + 1);
  now_ = states_.size() - 1;
}

}  // namespace nephroid
