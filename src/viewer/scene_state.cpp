#include "viewer/scene_state.h"

#include <algorithm>

#include "geometry/shapes.h"
#include "techniques/registry.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr std::size_t kMostStates = 1000;

// What of a material the frame's programs are made for.
bool isDrawnAlike(const Material& a, const Material& b) {
  return a.type == b.type && (a.emission != vec3(0)) == (b.emission != vec3(0));
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
  if (!std::ranges::equal(before.materials, after.materials, isDrawnAlike)) return true;
  const TechniqueInfo& info = techniqueNamed(settings.technique);
  return info.isStillPrepared && !info.isStillPrepared({before.materials, before.placements},
                                                       {after.materials, after.placements}, settings);
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
