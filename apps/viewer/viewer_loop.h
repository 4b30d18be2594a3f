// The viewer from frame to frame. Its functions stand in files by what they are about.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "formats/save_scene.h"
#include "gpu/reloadable_shader.h"
#include "graphics.h"
#include "key_bindings.h"
#include "pointer.h"
#include "viewer.h"
#include "viewer/preferences.h"
#include "viewer/preparation.h"
#include "viewer/reference_worker.h"
#include "viewer/video_pipe.h"
#include "viewer_state.h"

namespace nephroid {

class Viewer {
 public:
  explicit Viewer(const ViewerOptions& options);
  // With the scene of the options, until the window is closed.
  void run();
  // One frame of that; false when it was the last.
  bool step();

  ViewerState& state() { return state_; }
  DesktopWindow& window() { return window_; }
  gpu::Device& device() { return graphics_->device(); }
  ByteImage picture() { return graphics_->stage->renderer().picture(); }  // where there is one

  // viewer_files.cpp
  void open(const std::filesystem::path& file);  // asks before changes are lost
  void reload();
  bool save();
  bool isSaved() const;
  void undo();
  void redo();
  void takePicture(const char* extension);
  void recordVideo();  // or end it
  void close();        // asks before changes are lost
  // viewer_time.cpp
  void setTime(double seconds);
  void dropStone();  // where the pointer is
  // viewer_views.cpp
  void show(const char* pass, const char* output);
  // viewer_shaders.cpp
  void reloadShaders();

 private:
  // viewer.cpp
  Viewer(const ViewerOptions& options, const ViewerPreferences& preferences);
  float panelWidth() const;  // pixels
  void keepPreferences() const;
  void prepare(std::function<Scene()> load);
  void prepareWhatIsWanted();
  void takePrepared();
  void adopt(std::unique_ptr<Prepared> prepared);
  double waitSeconds() const;
  void receive(const Input& input);
  void moveByKeys(double seconds);
  void usePointer(const Input& input);
  void keepHistory();
  void keepHistoryAtRest();
  uvec2 pictureSize() const;
  bool drawPicture();  // whether there was anything new to draw
  void layOut();
  void showTitle();
  void showFrame();
  void recover(const std::string& why, bool isLost);
  std::string rescued() const;
  void writeStatsOfFrames() const;
  // viewer_keys.cpp
  void press(const KeyPress& key);
  // viewer_files.cpp
  void openNow(const std::filesystem::path& file);
  void prepareOpening();
  void drop(const std::filesystem::path& file);
  void addMesh(const std::filesystem::path& file);
  void watchFile();
  void answerQuestion();
  void finishTasks();
  void addToVideo();
  std::filesystem::path fileToSave() const;
  SavedScene sceneToSave() const;
  Scene sceneAsLoaded() const;
  // viewer_views.cpp
  void refineReference();
  void chooseShownImage();
  void updateLines();
  void drawLines(vec2 corner, vec2 size) const;
  void drawHandles(vec2 corner, vec2 size) const;
  // viewer_time.cpp
  void play(double seconds);
  // viewer_shaders.cpp
  void useShaders();

  // What the picture on the screen was made of.
  struct Drawn {
    SceneState state;
    double time = 0;
    uvec2 size{0};
    Paths paths = Paths::transmission;
    uint32_t stage = 0;  // counted
    bool operator==(const Drawn&) const = default;
  };
  // Apart from how it was drawn: one reference serves both.
  static bool seeTheSame(Drawn a, const Drawn& b);

  using Clock = std::chrono::steady_clock;

  const ViewerOptions options_;
  DesktopWindow window_;
  std::unique_ptr<Graphics> graphics_;
  ViewerState state_;
  Pointer pointer_;
  vec2 mouse_{0};  // in the picture, pixels of the window

  std::unique_ptr<Preparation> preparation_;
  bool opensScene_ = false;  // what is to be shown is another scene, not this one with other settings
  std::filesystem::path opening_;
  std::string openingText_;
  bool keepsCamera_ = false;                                      // of the scene that is opened
  std::optional<std::pair<SceneState, PictureSettings>> failed_;  // what could not be prepared
  Clock::time_point lastLoss_{};                                  // of the device
  Clock::time_point preparationStart_;
  double prepareMilliseconds_ = 0;

  std::string text_;  // of the scene's file, as it is saved; empty for glTF
  WaveRuns waves_;    // of the time that is shown
  bool isTextSaved_ = true;
  std::filesystem::file_time_type fileTime_{}, lastSeenTime_{};
  Clock::time_point lastWatch_{};
  std::vector<std::future<std::string>> tasks_;  // each ends with what there is to say
  std::unique_ptr<VideoPipe> video_;
  std::future<gpu::ShaderChanges> shaders_;  // being compiled

  ReferenceWorker referenceWorker_;
  std::optional<Drawn> referenceOf_;
  std::optional<Drawn> comparedOf_;
  std::shared_ptr<const ReferenceView> uploaded_;
  bool isErrorUploaded_ = false;
  std::vector<SceneLine> lines_;
  std::optional<std::pair<Drawn, std::array<bool, kOverlays>>> linesOf_;

  GuiImage picture_;
  uint32_t stageCount_ = 0;
  Drawn drawn_;
  bool isFlightHeld_ = false;
  Clock::time_point lastCameraStep_{};  // by the wheel or a key
  int framesToGo_ = 0;                  // until the window is at rest
  Clock::time_point lastFrame_ = Clock::now();
  Clock::time_point lastChange_ = Clock::now();
  std::vector<double> frameMilliseconds_;
};

}  // namespace nephroid
