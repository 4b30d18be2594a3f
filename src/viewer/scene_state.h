// The parts of a scene that the user can change by hand. Undo restores them, and saving writes them.
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

// Lists have the same length as those of the scene.
struct SceneState {
  Camera camera;
  Environment environment;
  std::vector<Material> materials;
  std::vector<Placement> placements;  // of the objects
  std::vector<std::vector<WaterDrop>>
      drops;  // the drops that fall into each object; only simulated water has drops
  std::vector<Light> lights;
  std::optional<AirState> air;
  bool operator==(const SceneState&) const = default;
};

SceneState stateOf(const Scene& scene);
// Where the drops have changed, the water's mesh is made again for the scene's time.
void apply(const SceneState& state, Scene& scene);

// Whether the two are equal apart from the camera, whose movement is no change of the scene.
bool isSameScene(const SceneState& a, const SceneState& b);

// Whether stones can be dropped into the object: it is simulated water, or can be.
bool takesStones(const Object& object);
// Drops a stone at `place` (m, x and z in the object's space) at the scene's time.
void dropStone(Scene& scene, uint32_t object, vec2 place);

// Whether a new preparation is needed, because the one for `before` cannot be used for `after`.
bool needsPreparation(const SceneState& before, const SceneState& after, const TechniqueSettings& settings);

// The history of states, for undo and redo.
class History {
 public:
  explicit History(SceneState first = {}) : states_{std::move(first)}, saved_(states_.front()) {}

  const SceneState& now() const { return states_[now_]; }
  // Adds a state, unless it is equal to the present one. States that were undone are removed.
  void add(const SceneState& state);
  bool canUndo() const { return now_ > 0; }
  bool canRedo() const { return now_ + 1 < states_.size(); }
  const SceneState& undo() { return states_[now_ -= canUndo()]; }
  const SceneState& redo() { return states_[now_ += canRedo()]; }

  // Changes all states and the saved one, for things that move by themselves, which are no steps of the
  // history.
  void changeAll(const std::function<void(SceneState&)>& change);

  void markSaved() { saved_ = states_[now_]; }
  bool isSaved() const { return isSameScene(saved_, states_[now_]); }

 private:
  std::vector<SceneState> states_;
  std::size_t now_ = 0;
  SceneState saved_;
};

}  // namespace nephroid
