// What the viewer reads and writes.
#include <algorithm>
#include <cstdio>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/image_io.h"
#include "formats/load.h"
#include "formats/save_scene.h"
#include "formats/scene_toml.h"
#include "formats/toml_text.h"
#include "viewer_loop.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

constexpr double kSecondsBetweenWatches = 0.25;
constexpr double kVideoFramesPerSecond = 30;

bool isToml(const fs::path& file) {
  return file.extension() == ".toml";
}

bool isSceneFile(const fs::path& file) {
  return isToml(file) || file.extension() == ".gltf" || file.extension() == ".glb";
}

// stem-001.png, or the first number that is not taken, in the folder the program was started in.
fs::path freeName(const std::string& stem, const std::string& extension) {
  for (int i = 1;; ++i) {
    char number[16];
    std::snprintf(number, sizeof number, "-%03d", i);
    fs::path file = fs::current_path() / (stem + number + extension);
    if (!fs::exists(file)) return file;
  }
}

fs::file_time_type timeOf(const fs::path& file) {
  std::error_code ignored;
  return fs::last_write_time(file, ignored);
}

// A place to look at a mesh that comes alone.
constexpr const char* kPlainScene = R"([environment]
ambient = [1.2, 1.3, 1.5]
background = [0.9, 1.1, 1.4]

[[material]]
name = "glass"
type = "dielectric"
ior = 1.5

[[material]]
name = "floor"
type = "diffuse"
color = [0.75, 0.71, 0.66]

[[object]]
name = "floor"
shape = "plane"
size = [20, 20]
material = "floor"
translation = [0, -0.8, 0]

[[light]]
name = "lamp"
type = "point"
position = [1.5, 3, 0.5]
intensity = 100

[camera]
position = [0, 1, 3]
exposure = 0.25
)";

std::string freeObjectName(const Scene& scene, const std::string& stem) {
  std::string name = stem;
  const auto isTaken = [&](const Object& object) { return object.name == name; };
  for (int i = 2; std::ranges::any_of(scene.objects, isTaken); ++i) name = stem + " " + std::to_string(i);
  return name;
}

}  // namespace

void Viewer::openNow(const fs::path& file) {
  fileTime_ = timeOf(file);
  std::string text;
  try {
    if (isToml(file)) text = readSceneFile(file);
  } catch (const InputError& wrong) {
    return tell(state_, wrong.what(), true);
  }
  opensScene_ = true;
  opening_ = fs::absolute(file);
  openingText_ = text;
  isTextSaved_ = true;
  prepareOpening();
}

void Viewer::prepareOpening() {
  prepare([file = opening_, text = openingText_, time = options_.time, tone = options_.tone] {
    Scene scene = isToml(file) ? readTomlScene(text, file, time) : loadScene(file, time);
    applyTo(scene.camera, tone);
    return scene;
  });
}

void Viewer::open(const fs::path& file) {
  if (isSaved())
    openNow(file);
  else
    state_.question = Question{Question::About::open, file};
}

void Viewer::close() {
  window_.setClosing(isSaved());
  if (!isSaved()) state_.question = Question{};
}

bool Viewer::isSaved() const {
  return !state_.isOpen || (isTextSaved_ && state_.history.isSaved());
}

void Viewer::reload() {
  if (state_.file.empty()) return;
  keepsCamera_ = true;
  if (isSaved())
    openNow(state_.file);
  else
    state_.question = Question{Question::About::reload, state_.file};
}

void Viewer::answerQuestion() {
  if (!state_.question || state_.question->answer == Question::Answer::none) return;
  const Question question = *std::exchange(state_.question, std::nullopt);
  if (question.answer == Question::Answer::cancel) {
    keepsCamera_ = false;
    return;
  }
  if (question.answer == Question::Answer::save && !save()) return;
  if (question.about == Question::About::close)
    window_.setClosing(true);
  else
    openNow(question.file);
}

// By other hands: while this scene has no changes of its own, it goes with its file.
void Viewer::watchFile() {
  if (!state_.isOpen || preparation_ || state_.question) return;
  if (std::chrono::duration<double>(Clock::now() - lastWatch_).count() < kSecondsBetweenWatches) return;
  lastWatch_ = Clock::now();
  const fs::file_time_type time = timeOf(state_.file);
  if (time == fileTime_ || time == fs::file_time_type::min()) return;
  // Whoever writes it may not be done.
  if (std::exchange(lastSeenTime_, time) != time) return;
  fileTime_ = time;
  reload();
}

Scene Viewer::sceneAsLoaded() const {
  Scene scene = state_.scene;
  apply(state_.firstState, scene);
  return scene;
}

// A glTF file stays as it is: what was changed goes into a scene around it.
fs::path Viewer::fileToSave() const {
  fs::path file = state_.file;
  return isToml(file) ? file : file.replace_extension(".toml");
}

SavedScene Viewer::sceneToSave() const {
  return savedScene(isToml(state_.file) ? text_ : sceneAround(state_.file), sceneAsLoaded(), state_.scene);
}

// Where there is no window any more: what is not saved is written beside its file. To be added to a message.
std::string Viewer::rescued() const {
  if (isSaved()) return {};
  try {
    fs::path file = fileToSave();
    file.replace_filename(file.stem().string() + "-unsaved.toml");
    writeFileAtomically(file, sceneToSave().text);
    return "; what was not saved is in " + file.string();
  } catch (const std::exception& wrong) {
    return std::string("; what was not saved is lost: ") + wrong.what();
  }
}

bool Viewer::save() {
  if (!state_.isOpen) return false;
  keepHistory();
  try {
    const bool isAround = !isToml(state_.file);
    const fs::path file = fileToSave();
    if (isAround && fs::exists(file))
      throw InputError("'" + file.string() + "' is there already, and would be written over; move it away");
    const SavedScene saved = sceneToSave();
    writeFileAtomically(file, saved.text);
    std::string said = "Saved " + file.string();
    for (const std::string& name : saved.notSaved)
      said += (&name == &saved.notSaved.front() ? "; what was changed of these cannot be: " : ", ") + name;
    tell(state_, said, !saved.notSaved.empty());
    fileTime_ = timeOf(file);
    isTextSaved_ = true;
    if (isAround) {
      openNow(file);
      return true;
    }
    text_ = saved.text;
    state_.firstState = stateOf(state_.scene);
    state_.history.markSaved();
    return true;
  } catch (const std::exception& wrong) {
    tell(state_, wrong.what(), true);
    return false;
  }
}

void Viewer::drop(const fs::path& file) {
  if (isSceneFile(file)) return open(file);
  if (file.extension() == ".obj" || file.extension() == ".ply") return addMesh(file);
  tell(state_, file.filename().string() + ": what can be dropped here is .toml, .gltf, .glb, .obj and .ply",
       true);
}

// Into the scene that is shown, as it was changed so far.
void Viewer::addMesh(const fs::path& file) {
  try {
    const bool isAlone = !state_.isOpen || !isToml(state_.file);
    const fs::path scene = isAlone ? fs::absolute(file).replace_extension(".toml") : state_.file;
    std::string text = isAlone ? kPlainScene : savedScene(text_, sceneAsLoaded(), state_.scene).text;
    std::string material = "glass";
    if (!isAlone) {
      const auto& materials = state_.scene.materials;
      const auto glass = std::ranges::find(materials, MaterialType::dielectric, &Material::type);
      material = glass != materials.end() ? glass->name : materials.front().name;
    }
    text += "\n[[object]]\nname = " +
            tomlString(freeObjectName(isAlone ? Scene{} : state_.scene, file.stem().string())) +
            "\nmesh = " + tomlString(fs::absolute(file).string()) + "\nmaterial = " + tomlString(material) +
            "\nfit = 1\n";
    opensScene_ = true;
    keepsCamera_ = !isAlone;
    opening_ = scene;
    openingText_ = text;
    isTextSaved_ = false;
    fileTime_ = timeOf(scene);
    prepareOpening();
  } catch (const std::exception& wrong) {
    tell(state_, wrong.what(), true);
  }
}

void Viewer::takePicture(const char* extension) {
  if (graphics_->stage && state_.isOpen && std::ranges::count(wantedPictures_, extension) == 0)
    wantedPictures_.emplace_back(extension);
}

void Viewer::writeWantedPictures() {
  for (const std::string& extension : std::exchange(wantedPictures_, {})) {
    const fs::path file = freeName(state_.file.stem().string(), extension);
    // The device has it at once; what takes long is done beside the window.
    if (file.extension() == ".png")
      tasks_.push_back(std::async(std::launch::async, [file, picture = shownPicture()] {
        writePng(file, picture);
        return "Picture: " + file.string();
      }));
    else
      tasks_.push_back(std::async(std::launch::async, [file, layers = graphics_->stage->renderer().layers()] {
        writeExr(file, layers);
        return "Picture: " + file.string();
      }));
  }
}

void Viewer::finishTasks() {
  std::erase_if(tasks_, [&](std::future<std::string>& task) {
    if (task.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    framesToGo_ = std::max(framesToGo_, 2);
    try {
      tell(state_, task.get());
    } catch (const std::exception& wrong) {
      tell(state_, wrong.what(), true);
    }
    return true;
  });
}

void Viewer::recordVideo() {
  if (video_) {
    video_.reset();
    tell(state_, "Recorded " + std::exchange(state_.recording, {}));
    return;
  }
  if (!graphics_->stage || !state_.isOpen) return;
  try {
    const fs::path file = freeName(state_.file.stem().string(), ".mp4");
    video_ = std::make_unique<VideoPipe>(file, graphics_->stage->size(), kVideoFramesPerSecond);
    state_.recording = file.string();
    tell(state_, "Recording each new picture into " + file.string() + "; V ends it");
  } catch (const std::exception& wrong) {
    tell(state_, wrong.what(), true);
  }
}

void Viewer::addToVideo() {
  if (!video_) return;
  if (graphics_->stage->size() != video_->size() || !video_->add(shownPicture())) {
    const bool isResized = graphics_->stage->size() != video_->size();
    video_.reset();
    const std::string file = std::exchange(state_.recording, {});
    tell(state_,
         isResized ? "The picture has another size: the recording ended, " + file
                   : "ffmpeg ended: " + file + " may not be whole",
         true);
  }
}

}  // namespace nephroid
