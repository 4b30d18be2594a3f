#include "scene_panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lights/clear_sky.h"
#include "report/missing_light.h"
#include "scene/dispersion.h"
#include "widgets.h"

namespace nephroid {
namespace {

constexpr ImU32 kWarningColor = IM_COL32(255, 190, 80, 255);

// Ten times the next power of ten: a slider's end that stays where it is while it is drawn.
float endOfSlider(float value) {
  return std::pow(10.0f, std::ceil(std::log10(std::max(value, 0.1f))) + 1);
}

// An entry of a list, open where it is what was chosen last in the picture.
bool beginEntry(ViewerState& state, const std::string& name, const Selection& self) {
  const bool isChosen = state.selection == self;
  ImGui::PushID(static_cast<int>(self.index));
  ImGui::SetNextItemOpen(isChosen, ImGuiCond_Always);
  const ImGuiTreeNodeFlags flags = isChosen ? ImGuiTreeNodeFlags_Selected : ImGuiTreeNodeFlags_None;
  const bool isOpen =
      ImGui::TreeNodeEx("entry", flags | ImGuiTreeNodeFlags_SpanAvailWidth, "%s", name.c_str());
  if (ImGui::IsItemToggledOpen() || ImGui::IsItemClicked()) state.selection = isChosen ? Selection{} : self;
  if (!isOpen) ImGui::PopID();
  return isOpen;
}

void endEntry() {
  ImGui::TreePop();
  ImGui::PopID();
}

void drawDirection(vec3& direction) {
  vec3 value = direction;
  if (ImGui::DragFloat3("Direction", &value.x, 0.005f, -1, 1, "%.3f") && length(value) > 1e-3f)
    direction = normalize(value);
  tooltip("The way the light travels; its length does not matter");
}

void drawSpot(Light& light) {
  slider("Outer angle", light.outerAngle, std::max(light.innerAngle, 0.1f),
         light.goboTexture == kNone ? 90 : 89, "%.1f°",
         "Half the angle of the cone, where the light ends (degrees)");
  slider("Inner angle", light.innerAngle, 0, light.outerAngle, "%.1f°",
         "Half the angle of the cone that has all of the light (degrees)");
  if (light.goboTexture != kNone)
    slider("Gobo turned", light.goboRotation, -180, 180, "%.0f°",
           "How far the image in the light is turned, clockwise for who looks along the light (degrees)");
}

void drawLight(Light& light, const Light& first) {
  if (light.type == LightType::sky) {
    colorAndStrength("light", "Luminance", light.intensity,
                     endOfSlider(std::max({first.intensity.x, first.intensity.y, first.intensity.z})), "%.4g",
                     "Multiplies the map (nit of an even sky)");
    slider("Turned", light.skyRotation, -180, 180, "%.0f°", "About the upright axis (degrees)");
    ImGui::Checkbox("Seen", &light.isSeen);
    tooltip("It is seen where nothing stands, in glass and in mirrors");
  } else if (light.type == LightType::directional) {
    colorAndStrength("light", "Illuminance", light.illuminance,
                     endOfSlider(std::max({first.illuminance.x, first.illuminance.y, first.illuminance.z})),
                     "%.4g lx", "On a surface that faces the light (lux)");
  } else {
    colorAndStrength("light", "Intensity", light.intensity,
                     endOfSlider(std::max({first.intensity.x, first.intensity.y, first.intensity.z})),
                     "%.4g cd", "Luminous intensity (candela)");
    constexpr auto kPlace = "Where it stands (m)";
    const char* name = light.type == LightType::line   ? "From"
                       : light.type == LightType::area ? "Corner"
                                                       : "Position";
    dragMeters(name, light.position, kPlace);
  }
  if (light.type == LightType::line) dragMeters("To", light.end, "Where the tube ends (m)");
  if (light.type == LightType::directional)
    slider("Width", light.angle, 0, 10, "%.2f°",
           "The angle that its disk is seen under (degrees); the sun's is 0.53");
  if (light.type == LightType::point || light.type == LightType::spot)
    slider("Radius", light.radius, 0, 1, "%.3f m", "Of a ball that looks evenly bright; 0: a point");
  if (light.type == LightType::directional || light.type == LightType::spot) drawDirection(light.direction);
  if (light.type == LightType::spot && light.outerAngle <= 90) drawSpot(light);
}

void drawDielectric(Material& material) {
  float ior = material.ior.y;
  const bool isGiven = material.dispersion == 0 && material.isDispersive();
  if (isGiven) {
    ImGui::DragFloat3("Index", &material.ior.x, 0.002f, 1, 4, "%.3f");
    tooltip("Index of refraction of red, green and blue");
  } else {
    const bool isBent =
        slider("Index", ior, 1, 3, "%.3f", "Index of refraction; at 587.6 nm where it disperses");
    float dispersion = material.dispersion;
    const bool isSpread = slider("Dispersion", dispersion, 0, 1, "%.3f",
                                 "20 over the Abbe number; 0: none. 0.31 is crown glass, 0.55 flint");
    if (isBent || isSpread) setDispersion(material, double(ior), double(dispersion));
  }
  color("Tint", material.attenuationColor, "What is left of white light after the distance below");
  float meters = std::isfinite(material.attenuationDistance) ? material.attenuationDistance : 0;
  if (slider("Tint after", meters, 0, 10, meters > 0 ? "%.3g m" : "clear",
             "The way in the material after which white light has that color (m); 0: it is clear", true))
    material.attenuationDistance = meters > 0 ? meters : std::numeric_limits<float>::infinity();
}

// What was mended when the scene was loaded, and why light is missing now.
void drawWarnings(const ViewerState& state) {
  if (!state.isOpen) return;
  std::vector<std::string> lines = loadWarnings(state.scene);
  for (std::string& line : missingLight(state.scene, state.stats.budget)) lines.push_back(std::move(line));
  ImGui::PushStyleColor(ImGuiCol_Text, kWarningColor);
  for (const std::string& line : lines) ImGui::TextWrapped("%s", line.c_str());
  ImGui::PopStyleColor();
}

void drawExposure(Camera& camera, std::optional<float>& metered) {
  bool isAuto = !camera.exposure;
  if (ImGui::Checkbox("Automatic exposure", &isAuto))
    camera.exposure = isAuto ? std::nullopt : std::optional(metered.value_or(1.0f));
  tooltip("Metered when the scene is opened, and kept until it is metered again");
  if (camera.exposure) {
    slider("Exposure", *camera.exposure, 1e-6f, 1e3f, "%.4g", "Multiplies luminance before tone mapping",
           true);
    return;
  }
  if (ImGui::Button("Meter again")) metered.reset();
  tooltip("On the picture as it is now (G)");
  if (!metered) return;
  ImGui::SameLine();
  ImGui::TextDisabled("%.4g, EV100 %.1f", double(*metered), ev100OfExposure(double(*metered)));
}

void drawTone(Camera& camera) {
  constexpr const auto& names = kToneCurveNames;
  auto chosen = static_cast<int>(camera.tone);
  if (ImGui::Combo("Tone", &chosen, names.data(), static_cast<int>(names.size())))
    camera.tone = static_cast<ToneCurve>(chosen);
  tooltip("The curve from luminance to what a screen shows");
}

}  // namespace

void drawScenePanel(ViewerState& state) {
  const bool isSaved = state.history.isSaved();
  const std::string name = state.file.empty() ? "No scene" : state.file.filename().string();
  ImGui::TextUnformatted((name + (isSaved ? "" : " *")).c_str());
  tooltip(state.file.empty()
              ? "Drop a .toml, .gltf or .glb file here"
              : state.file.string() + (isSaved ? "" : "\nThere are changes that are not saved"));
  ImGui::TextDisabled("%s", state.device.c_str());
  drawWarnings(state);
  ImGui::Separator();
}

void drawLightsPanel(ViewerState& state) {
  if (!ImGui::CollapsingHeader("Lights", ImGuiTreeNodeFlags_DefaultOpen)) return;
  for (uint32_t i = 0; i < state.scene.lights.size(); ++i) {
    if (!beginEntry(state, state.scene.lights[i].name, {Chosen::light, i})) continue;
    Light& light = state.scene.lights[i];
    const Light before = light;
    drawLight(light, state.firstState.lights[i]);
    if (light.sun != kNone && light != before)
      state.scene.lights[light.sun] =
          sunWithSky(state.firstState.lights[light.sun], state.firstState.lights[i], light);
    endEntry();
  }
  colorAndStrength("ambient", "Ambient", state.scene.environment.ambient, 1e5f, "%.3g lx",
                   "Illuminance on every receiver from all around (lux)");
  colorAndStrength("background", "Background", state.scene.environment.background, 1e5f, "%.3g cd/m²",
                   "Luminance where there is nothing (nit)");
}

void drawObjectsPanel(ViewerState& state) {
  if (!ImGui::CollapsingHeader("Objects")) return;
  for (uint32_t i = 0; i < state.scene.objects.size(); ++i) {
    Object& object = state.scene.objects[i];
    if (!beginEntry(state, object.name, {Chosen::object, i})) continue;
    ImGui::TextDisabled("of %s, %zu triangles", state.scene.materialOf(object).name.c_str(),
                        state.scene.meshOf(object).triangles.size());
    dragMeters("Position", object.placement.translation, "Where its origin is (m)");
    slider("Scale", object.placement.scale, 0.01f, 100, "%.3g", "How many times as large as its mesh", true);
    endEntry();
  }
}

void drawMaterialsPanel(ViewerState& state) {
  if (!ImGui::CollapsingHeader("Materials")) return;
  for (uint32_t i = 0; i < state.scene.materials.size(); ++i) {
    Material& material = state.scene.materials[i];
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::TreeNodeEx("material", ImGuiTreeNodeFlags_SpanAvailWidth, "%s", material.name.c_str())) {
      if (material.type == MaterialType::dielectric)
        drawDielectric(material);
      else
        color("Color", material.color, "Reflectance of each channel, 0 to 1");
      ImGui::TreePop();
    }
    ImGui::PopID();
  }
}

void drawAirPanel(ViewerState& state) {
  if (!state.scene.medium || !ImGui::CollapsingHeader("Air")) return;
  Medium& medium = *state.scene.medium;
  slider("Extinction", medium.extinction, 0, 2, "%.4f /m", "How much of the light a meter of air takes (1/m)",
         true);
  slider("Albedo", medium.albedo, 0, 1, "%.3f", "The part of it that is scattered and not absorbed");
  if (medium.phase == PhaseType::henyeyGreenstein)
    slider("Forwardness", medium.g, -0.95f, 0.95f, "%.3f",
           "g of Henyey and Greenstein: 0 to all sides alike, above 0 ahead, below 0 back");
}

void drawCameraPanel(ViewerState& state) {
  if (!ImGui::CollapsingHeader("Camera")) return;
  Camera& camera = state.scene.camera;
  drawExposure(camera, state.metered);
  drawTone(camera);
  slider("Field of view", camera.verticalFov, 5, 120, "%.1f°", "From the lower edge to the upper (degrees)");
  vec3 position = camera.position, target = camera.target;
  if (dragMeters("Position", position, "Where it stands (m)") && position != target)
    camera.position = position;
  if (dragMeters("Target", target, "What it looks at, and goes around (m)") && position != target)
    camera.target = target;
}

}  // namespace nephroid
