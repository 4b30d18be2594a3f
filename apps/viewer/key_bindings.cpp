#include "key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>

#include "lights/emitters.h"
#include "scene/framing.h"
#include "techniques/registry.h"
#include "viewer/camera_control.h"
#include "viewer_loop.h"

namespace nephroid {
namespace {

constexpr double kFrame = 1.0 / 60;  // s

void stepTechnique(Viewer& viewer, std::size_t steps) {
  std::string& technique = viewer.state().settings.technique.technique;
  const std::span<const TechniqueInfo* const> all = techniques();
  const auto now = std::ranges::find(all, &techniqueNamed(technique));
  technique = all[(static_cast<std::size_t>(now - all.begin()) + steps) % all.size()]->name;
}

void changeSource(Viewer& viewer) {
  Source& source = viewer.state().settings.technique.transport.source;
  source = source == Source::table ? Source::traced : Source::table;
}

void frameChosen(Viewer& viewer) {
  ViewerState& state = viewer.state();
  if (state.selection.what == Chosen::light) {
    const vec3 place = middleOf(state.scene.lights[state.selection.index]);
    return frameBox(state.scene.camera, {place - 0.5f, place + 0.5f});
  }
  const bool isOne = state.selection.what == Chosen::object;
  Box bounds;
  for (uint32_t i = 0; i < state.scene.objects.size(); ++i) {
    const Object& object = state.scene.objects[i];
    if (isOne ? i != state.selection.index : !state.scene.isCaster(object)) continue;
    bounds.include(worldBounds(state.scene, object));
  }
  if (!bounds.isEmpty()) frameBox(state.scene.camera, bounds);
}

void toggle(Viewer& viewer, Overlay overlay) {
  bool& isShown = viewer.state().overlays[static_cast<std::size_t>(overlay)];
  isShown = !isShown;
}

void showPicture(Viewer& viewer) {
  viewer.state().shown = Shown::picture;
  viewer.state().overlays.fill(false);
}

constexpr KeyBinding kBindings[] = {
    {"Left drag", "Go around the target. On a light, or on the object that is chosen: move it"},
    {"  with Shift", "up and down"},
    {"  with X, Y or Z", "along that axis"},
    {"  with Ctrl", "turn it"},
    {"Click", "Choose the light or object there; on water, drop a stone into it"},
    {"Right drag", "Look around"},
    {"Middle drag, Shift drag", "Move sideways"},
    {"Wheel", "Nearer and farther"},
    {"W A S D, Page up, down", "Fly"},
    {"Arrows", "Go around"},
    {"F", "Look at what is chosen", GLFW_KEY_F, false, false, frameChosen},
    {"Home", "Camera as in the file", GLFW_KEY_HOME, false, false,
     [](Viewer& viewer) { viewer.state().scene.camera = viewer.state().firstState.camera; }},
    {"Esc", "Choose nothing; show the picture", GLFW_KEY_ESCAPE, false, false,
     [](Viewer& viewer) {
       viewer.state().selection = {};
       viewer.state().isHelpShown = false;
       showPicture(viewer);
     }},
    {"M", "Next technique", GLFW_KEY_M, false, false, [](Viewer& viewer) { stepTechnique(viewer, 1); }},
    {"Shift M", "The technique before", GLFW_KEY_M, false, true,
     [](Viewer& viewer) { stepTechnique(viewer, techniques().size() - 1); }},
    {"B", "Beams from tables, or traced", GLFW_KEY_B, false, false, changeSource},
    {"Space", "While held: show the reference, which improves with time"},
    {"E", "Error against the reference", GLFW_KEY_E, false, false,
     [](Viewer& viewer) {
       Shown& shown = viewer.state().shown;
       shown = shown == Shown::error ? Shown::picture : Shown::error;
     }},
    {"1", "Beams; of adaptive-beams the mesh of rays", GLFW_KEY_1, false, false,
     [](Viewer& viewer) { toggle(viewer, Overlay::beams); }},
    {"2", "Virtual planes", GLFW_KEY_2, false, false,
     [](Viewer& viewer) { toggle(viewer, Overlay::planes); }},
    {"3", "Slices for the view through glass", GLFW_KEY_3, false, false,
     [](Viewer& viewer) { toggle(viewer, Overlay::slices); }},
    {"4", "Cells of irradiance volumes", GLFW_KEY_4, false, false,
     [](Viewer& viewer) { toggle(viewer, Overlay::cells); }},
    {"5", "Beams that carry nothing, and why", GLFW_KEY_5, false, false,
     [](Viewer& viewer) { toggle(viewer, Overlay::culled); }},
    {"6", "Normals", GLFW_KEY_6, false, false, [](Viewer& viewer) { viewer.show("normals"); }},
    {"7", "Caustics (lux)", GLFW_KEY_7, false, false, [](Viewer& viewer) { viewer.show("caustics"); }},
    {"8", "Direct light (lux)", GLFW_KEY_8, false, false,
     [](Viewer& viewer) { viewer.show("direct-light"); }},
    {"9", "Depth", GLFW_KEY_9, false, false, [](Viewer& viewer) { viewer.show("depth"); }},
    {"C", "Cells of landed light, by the size of their texels", GLFW_KEY_C, false, false,
     [](Viewer& viewer) { viewer.show("levels"); }},
    {"0", "The picture again", GLFW_KEY_0, false, false, showPicture},
    {"K", "Start and stop the time", GLFW_KEY_K, false, false,
     [](Viewer& viewer) { viewer.state().isPlaying = !viewer.state().isPlaying; }},
    {"L, J", "A 60th of a second forward, and back", GLFW_KEY_L, false, false,
     [](Viewer& viewer) { viewer.setTime(viewer.state().scene.time + kFrame); }, true},
    {"", "", GLFW_KEY_J, false, false,
     [](Viewer& viewer) { viewer.setTime(viewer.state().scene.time - kFrame); }, true},
    {"Shift J", "Time 0", GLFW_KEY_J, false, true, [](Viewer& viewer) { viewer.setTime(0); }},
    {"N", "Drop a stone into the water under the pointer", GLFW_KEY_N, false, false,
     [](Viewer& viewer) { viewer.dropStone(); }},
    {"G", "Meter the exposure again, where the camera has none of its own", GLFW_KEY_G, false, false,
     [](Viewer& viewer) { viewer.state().metered.reset(); }},
    {"R", "Resolution: full, a half, a third", GLFW_KEY_R, false, false,
     [](Viewer& viewer) { viewer.state().divisor = viewer.state().divisor % 3 + 1; }},
    {"T", "Times", GLFW_KEY_T, false, false,
     [](Viewer& viewer) { viewer.state().areTimesShown = !viewer.state().areTimesShown; }},
    {"Tab", "Panels", GLFW_KEY_TAB, false, false,
     [](Viewer& viewer) { viewer.state().arePanelsShown = !viewer.state().arePanelsShown; }},
    {"P", "Picture as PNG", GLFW_KEY_P, false, false, [](Viewer& viewer) { viewer.takePicture(".png"); }},
    {"Shift P", "Picture as EXR", GLFW_KEY_P, false, true,
     [](Viewer& viewer) { viewer.takePicture(".exr"); }},
    {"V", "Start and end a video", GLFW_KEY_V, false, false, [](Viewer& viewer) { viewer.recordVideo(); }},
    {"Ctrl S", "Save the scene", GLFW_KEY_S, true, false, [](Viewer& viewer) { viewer.save(); }},
    {"Ctrl Z", "Undo", GLFW_KEY_Z, true, false, [](Viewer& viewer) { viewer.undo(); }, true},
    {"Ctrl Y", "Redo", GLFW_KEY_Y, true, false, [](Viewer& viewer) { viewer.redo(); }, true},
    {"F5", "Load the scene again", GLFW_KEY_F5, false, false, [](Viewer& viewer) { viewer.reload(); }},
    {"Shift F5", "Compile the shaders again (builds for developers)", GLFW_KEY_F5, false, true,
     [](Viewer& viewer) { viewer.reloadShaders(); }},
    {"?, F1", "This help", GLFW_KEY_F1, false, false,
     [](Viewer& viewer) { viewer.state().isHelpShown = !viewer.state().isHelpShown; }},
    {"Ctrl Q", "Close", GLFW_KEY_Q, true, false, [](Viewer& viewer) { viewer.close(); }},
};

bool isMeant(const KeyBinding& binding, const KeyPress& key) {
  if (!binding.act || (key.isRepeated && !binding.repeats)) return false;
  if (binding.isControl != key.isControl || binding.isShift != key.isShift) return false;
  const bool isLetter = binding.key >= GLFW_KEY_A && binding.key <= GLFW_KEY_Z;
  return isLetter && key.text != 0 ? std::toupper(static_cast<int>(key.text)) == binding.key
                                   : key.key == binding.key;
}

}  // namespace

std::span<const KeyBinding> keyBindings() {
  return kBindings;
}

void Viewer::press(const KeyPress& key) {
  const auto found =
      std::ranges::find_if(kBindings, [&](const KeyBinding& binding) { return isMeant(binding, key); });
  if (found != std::end(kBindings)) found->act(*this);
}

}  // namespace nephroid
