// The state of the viewer that the panels show and change.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "render/settings.h"
#include "techniques/pass_output.h"
#include "viewer/frame_times.h"
#include "viewer/picking.h"
#include "viewer/reference_worker.h"
#include "viewer/scene_lines.h"
#include "viewer/scene_state.h"

namespace nephroid {

struct Message {
  std::string text;
  bool isError = false;
  std::chrono::steady_clock::time_point until{};
};

// A question to the user about changes that are not saved, and what to do after the answer.
struct Question {
  enum class About { close, open, reload };
  enum class Answer { none, save, discard, cancel };
  About about = About::close;
  std::filesystem::path file;  // to be opened
  Answer answer = Answer::none;
};

// What may be drawn over the picture.
enum class Overlay { beams, planes, slices, cells, culled };
inline constexpr std::size_t kOverlays = 5;

enum class Shown { picture, error, output };

struct ViewerState {
  std::filesystem::path file;    // of the scene
  bool isOpen = false;           // there is a scene
  Scene scene;                   // as shown now
  PictureSettings settings;      // as the user wants them
  std::optional<float> metered;  // the exposure of a camera that has none; none: the next frame is metered
  uint32_t gathered = 0;         // samples of each pixel in the picture; 0: one, with smoothed edges
  History history;
  SceneState firstState;  // as in the file
  Selection selection;

  Shown shown = Shown::picture;
  std::string shownPass;    // whose output is shown
  std::string shownOutput;  // the name of that output; empty: the first
  std::vector<PassOutput> outputs;
  std::array<bool, kOverlays> overlays{};
  BeamCounts beamCounts;
  Legend meshLegend;    // of the mesh of rays; without entries where that is not shown
  Legend outputLegend;  // of the output that is shown
  bool isReferenceHeld = false;
  std::shared_ptr<const ReferenceView> reference;  // the newest reference of what is shown

  FrameTimes times;
  double framesPerSecond = 0;
  Stats stats;               // counts of the last frame
  uint64_t memoryBytes = 0;  // on the device
  std::string device;
  std::optional<Progress::State> preparing;
  bool isPreparationCanceled = false;  // by the user
  Message message;
  std::optional<Question> question;
  std::string recording;  // file of the video that is being recorded; empty: none

  bool isPlaying = false;  // the scene's time is running
  bool arePanelsShown = true;
  bool areTimesShown = true;
  bool isHelpShown = false;
  uint32_t divisor = 1;  // side of a pixel of the picture, in pixels of the window

  bool isOverlaid(Overlay overlay) const { return overlays[static_cast<std::size_t>(overlay)]; }
};

inline void tell(ViewerState& state, std::string text, bool isError = false) {
  state.message = {std::move(text), isError, std::chrono::steady_clock::now() + std::chrono::seconds(8)};
}

}  // namespace nephroid
