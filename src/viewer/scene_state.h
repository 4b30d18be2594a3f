// What of a scene is changed by hand, apart from what was loaded and stays: what undo goes back to and saving
// writes.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "scene/scene.h"
#include "techniques/settings.h"
#include "water/wave_simulation.h"

namespace nephroid {

struct AirState {
  float extinction = 0;  // 1/m
  float albedo = 0;
  float g = 0;
  bool operator==(const AirState&) const = default;
};

// Lists are as long as those of the scene.
struct SceneState {
  Camera camera;
  Environment environment;
  std::vector<Material> materials;
  std::vector<Placement> placements;          // of the objects
  std::vector<std::vector<WaterDrop>> drops;  // that fall into them; none into what is no simulated water
  std::vector<Light> lights;
  std::optional<AirState> air;
  bool operator==(const SceneState&) const = default;
};

SceneState stateOf(const Scene& scene);
// Water into which other drops fall is made anew, at the scene's time.
void apply(const SceneState& state, Scene& scene);

// Whether they differ at most in where they are looked at from, which is no change to a scene.
bool isSameScene(const SceneState& a, const SceneState& b);

// Whether stones can fall into the object: it is water that moves on a grid of its own.
bool takesStones(const Object& object);
// One falls there (m, in the object's space) at the scene's time.
void dropStone(Scene& scene, uint32_t object, vec2 place);

// Whether what was prepared for `before` cannot draw `after`.
bool needsPreparation(const SceneState& before, const SceneState& after, const TechniqueSettings& settings);

// States that were come by one after another.
class History {
 public:
  explicit History(SceneState first = {}) : states_{std::move(first)}, saved_(states_.front()) {}

  const SceneState& now() const { return states_[now_]; }
  // A further one, unless it is the same as now; those that were undone are forgotten.
  void add(const SceneState& state);
  bool canUndo() const { return now_ > 0; }
  bool canRedo() const { return now_ + 1 < states_.size(); }
  const SceneState& undo() { return states_[now_ -= canUndo()]; }
  const SceneState& redo() { return states_[now_ += canRedo()]; }

  // All of them, and the saved one: what moves by itself is no step.
  void changeAll(const std::function<void(SceneState&)>& change);

  void markSaved() { saved_ = states_[now_]; }
  bool isSaved() const { return isSameScene(saved_, states_[now_]); }

 private:
  std::vector<SceneState> states_;
  std::size_t now_ = 0;
  SceneState saved_;
};

}  // namespace nephroid
