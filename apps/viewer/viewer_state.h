// All that panels show and change.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "core/progress.h"
#include "viewer/frame_times.h"
#include "viewer/picking.h"
#include "viewer/scene_state.h"

namespace nephroid {

struct Message {
  std::string text;
  bool isError = false;
  std::chrono::steady_clock::time_point until{};
};

struct ViewerState {
  std::filesystem::path file;  // of the scene
  bool isOpen = false;         // there is a scene
  Scene scene;                 // as it is shown
  TechniqueSettings settings;  // as they are wanted
  History history;
  SceneState firstState;  // as the file has it
  Selection selection;

  FrameTimes times;
  double shownPerSecond = 0;  // frames
  Stats stats;                // of the last frame: counts
  uint64_t memoryBytes = 0;   // on the device
  std::string device;
  std::optional<Progress::State> preparing;
  bool isPreparationCancelled = false;  // asked for by the user
  Message message;

  bool arePanelsShown = true;
  bool areTimesShown = true;
  bool isHelpShown = false;
  uint32_t divisor = 1;  // pixels of the window along a pixel of the picture
};

inline void tell(ViewerState& state, std::string text, bool isError = false) {
  state.message = {std::move(text), isError, std::chrono::steady_clock::now() + std::chrono::seconds(8)};
}

}  // namespace nephroid
