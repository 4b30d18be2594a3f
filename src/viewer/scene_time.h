// A scene at another time.
#pragma once

#include <string>

#include "viewer/scene_state.h"
#include "water/wave_simulation.h"

namespace nephroid {

// Waves and lights' cues go on to `time` (s). `text` is that of the scene's file, empty where it is no .toml.
// `asLoaded` is what the file has at the scene's time, and then at the other; what was changed by hand since
// stays as it is, in the scene and in all states of its history. `waves` are those of the last time. Throws
// InputError where the text is no scene.
void moveTo(Scene& scene, SceneState& asLoaded, History& history, const std::string& text, double time,
            WaveRuns& waves);

}  // namespace nephroid
