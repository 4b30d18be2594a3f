// The loop of the viewer. The comments name the file in which each group of functions is defined.
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
#include "gpu/transfer.h"
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

inline double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

class Viewer {
 public:
  explicit Viewer(const ViewerOptions& options);
  // Opens the scene of the options and draws frames until the window is closed.
  void run();
  // Does one frame. Returns false after the last one.
  bool step();

  ViewerState& state() { return state_; }
  DesktopWindow& window() { return window_; }
  gpu::Device& device() { return graphics_->device(); }
  // Of a scene that has been drawn: as it was rendered, and as it is shown, with smoothed edges.
  ByteImage picture() { return graphics_->stage->renderer().picture(); }
  ByteImage shownPicture() { return gpu::downloadPicture(device(), graphics_->stage->picture()); }

  // viewer_files.cpp
  void open(const std::filesystem::path& file);  // asks first if changes are not saved
  void reload();
  bool save();
  bool isSaved() const;
  void undo();
  void redo();
  void takePicture(const char* extension);  // when its samples are gathered, or before it changes
  void recordVideo();                       // starts a video, or ends it
  void close();                             // asks before changes are lost
  // viewer_time.cpp
  void setTime(double seconds);
  void dropStone();  // into the water under the pointer
  // viewer_views.cpp
  void show(const std::string& view);  // of viewNames(), or the picture again where it is shown
  // viewer_shaders.cpp
  void reloadShaders();

 private:
  using Clock = std::chrono::steady_clock;

  // Everything that the picture on the screen depends on.
  struct Drawn {
    SceneState state;
    double time = 0;
    uvec2 size{0};
    Paths paths = Paths::transmission;
    uint32_t samples = 1;  // 0: a frame was canceled, and the stage no longer has what the picture shows
    uint32_t stage = 0;    // number of the stage, counted from the start
    std::optional<float> metered{};  // the exposure, where the camera has none
    bool operator==(const Drawn&) const = default;
  };

  // A frame that is being drawn on another thread.
  struct Drawing {
    Drawing(Drawn wanted, std::shared_ptr<Prepared> from, bool ofNewStage)
        : of(std::move(wanted)), prepared(std::move(from)), isOfNewStage(ofNewStage) {}
    ~Drawing();  // cancels it, and waits for its end
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    Drawn of;
    std::shared_ptr<Prepared> prepared;  // with the progress of the work
    bool isOfNewStage;
    bool isLate = false;  // the window no longer waits for it
    Clock::time_point start = Clock::now();
    std::unique_ptr<Stage> made;  // the new stage
    std::vector<PassTime> passes;
    std::future<void> work;
  };

  // viewer.cpp
  Viewer(const ViewerOptions& options, const ViewerPreferences& preferences);
  float panelWidth() const;  // pixels
  void keepPreferences() const;
  void prepare(std::function<Scene()> load);
  void prepareWhatIsWanted();
  void takePrepared();
  double waitSeconds() const;
  void receive(const Input& input);
  void moveByKeys(double seconds);
  void usePointer(const Input& input);
  void keepHistory();
  void keepHistoryAtRest();
  uvec2 pictureSize() const;
  void layOut();
  void showTitle();
  void showFrame();
  void recover(const std::string& why, bool isLost);
  std::string rescued() const;
  void writeStatsOfFrames() const;
  bool isDone() const;  // what a run without a user is for
  // viewer_drawing.cpp
  Scene exposed(Scene scene) const;
  Drawn wantedOf(const Scene& scene, const PictureSettings& drawnWith, uint32_t stage) const;
  void beginStage(std::unique_ptr<Prepared> prepared);
  void beginFrame();
  bool isStageBusy() const;  // nothing of the stage but its picture may be used
  bool drawPicture();
  bool takeDrawing();
  void adopt(Drawing& done);
  void keepStage();
  void failToPrepare(const std::string& why);
  void watchDrawing();
  bool isGathering() const;
  void gatherPicture();
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
  void writeWantedPictures();
  std::filesystem::path fileToSave() const;
  SavedScene sceneToSave() const;
  Scene sceneAsLoaded() const;
  void writeShown();
  // viewer_views.cpp
  void refineReference();
  void showOutput();
  void chooseShownImage();
  void updateLines();
  void addMeshLines();
  void drawLines(vec2 corner, vec2 size) const;
  void drawHandles(vec2 corner, vec2 size) const;
  // viewer_time.cpp
  void play(double seconds);
  // viewer_shaders.cpp
  void useShaders();

  bool isPictureWhole() const { return drawn_.samples > 0; }
  // Whether the two show the same, apart from how they were drawn: then they have the same reference.
  static bool seeTheSame(Drawn a, const Drawn& b);

  const ViewerOptions options_;
  DesktopWindow window_;
  std::unique_ptr<Graphics> graphics_;
  ViewerState state_;
  Pointer pointer_;
  vec2 mouse_{0};  // in the picture, pixels of the window

  std::unique_ptr<Preparation> preparation_;
  bool opensScene_ = false;  // the preparation is for another scene, not for other settings of this one
  std::filesystem::path opening_;
  std::string openingText_;
  bool keepsCamera_ = false;  // keep the present camera when the scene has been opened
  std::optional<std::pair<SceneState, PictureSettings>> failed_;  // the state whose preparation failed
  Clock::time_point lastLoss_{};                                  // when the device was last lost
  Clock::time_point preparationStart_;
  double preparedMilliseconds_ = 0;  // of the last preparation
  double prepareMilliseconds_ = 0;   // of that of the stage

  std::string text_;  // of the scene's file, as it was last saved; empty for glTF
  WaveRuns waves_;    // at the time that is shown
  bool isTextSaved_ = true;
  std::filesystem::file_time_type fileTime_{}, lastSeenTime_{};
  Clock::time_point lastWatch_{};
  std::vector<std::future<std::string>> tasks_;  // work on other threads; each returns a message
  std::vector<std::string> wantedPictures_;      // their extensions
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
  std::optional<Drawn> canceled_;     // whose drawing the user has canceled
  std::unique_ptr<Drawing> drawing_;  // null: none
  bool isFlightHeld_ = false;
  Clock::time_point lastCameraStep_{};  // when the wheel or a key last moved the camera
  int framesToGo_ = 0;                  // frames still to draw before the window waits for input
  Clock::time_point lastFrame_ = Clock::now();
  Clock::time_point lastChange_ = Clock::now();
  std::vector<double> frameMilliseconds_;
  int shownFrames_ = 0;  // of a scene
};

}  // namespace nephroid
