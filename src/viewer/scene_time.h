// Moves a scene to another time.
#pragma once

#include <string>

#include "viewer/scene_state.h"
#include "water/wave_simulation.h"

namespace nephroid {

// Sets waves and lights with cues to their state at `time` (s). `text`: of the scene's file; empty where it
// is no .toml. `asLoaded`: the state from the file at the scene's time; it is replaced by the one at `time`.
// Values that the user has changed by hand stay, in the scene and in all states of its history. `waves`: the
// state of simulated water at the last time. Throws InputError where the text is no scene.
void moveTo(Scene& scene, SceneState& asLoaded, History& history, const std::string& text, double time,
            WaveRuns& waves);

}  // namespace nephroid
