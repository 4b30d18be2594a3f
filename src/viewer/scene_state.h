// What of a scene is changed by hand, apart from what was loaded and stays: what undo goes back to and saving
// writes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "techniques/settings.h"

namespace nephroid {

struct AirState {
  float extinction = 0;  // 1/m
  float albedo = 0;
  float g = 0;
  bool operator==(const AirState&) const = default;
};

// Lists are as long as those of the scene.
struct SceneState {
  Environment environment;
  std::vector<Material> materials;
  std::vector<Placement> placements;  // of the objects
  std::vector<Light> lights;
  std::optional<AirState> air;
  bool operator==(const SceneState&) const = default;
};

SceneState stateOf(const Scene& scene);
void apply(const SceneState& state, Scene& scene);

// Whether what was prepared for `before` cannot draw `after`.
bool needsPreparation(const SceneState& before, const SceneState& after, const TechniqueSettings& settings);

// States that were come by one after another.
class History {
 public:
  explicit History(SceneState first = {}) : states_{std::move(first)} {}

  const SceneState& now() const { return states_[now_]; }
  // A further one, unless it is the same as now; those that were undone are forgotten.
  void add(const SceneState& state);
  bool canUndo() const { return now_ > 0; }
  bool canRedo() const { return now_ + 1 < states_.size(); }
  const SceneState& undo() { return states_[now_ -= canUndo()]; }
  const SceneState& redo() { return states_[now_ += canRedo()]; }

  // In place of the state now: what moved by itself is no step.
  void replace(const SceneState& state);

  void markSaved() { saved_ = states_[now_]; }
  bool isSaved() const { return !saved_ ? now_ == 0 : *saved_ == states_[now_]; }

 private:
  std::vector<SceneState> states_;
  std::size_t now_ = 0;
  std::optional<SceneState> saved_;  // none: as it was first
};

}  // namespace nephroid
