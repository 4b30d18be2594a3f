#include "formats/save_scene.h"

#include <algorithm>
#include <cmath>

#include "core/settings.h"
#include "formats/save_imports.h"
#include "formats/toml_table.h"
#include "formats/toml_text.h"
#include "geometry/bounds.h"
#include "lights/clear_sky.h"
#include "scene/framing.h"
#include "water/wave_simulation.h"

namespace nephroid {
namespace {

// By the key that is there.
void saveExposure(const Camera& before, const Camera& after, TomlText& text) {
  if (before.exposure == after.exposure) return;
  const toml::table* camera = text.table("camera");
  const std::string value = after.exposure ? tomlNumber(*after.exposure) : tomlString(kAutoExposure);
  if (!camera || !camera->contains("ev100"))
    text.set("camera", "exposure", value);
  else if (after.exposure)
    text.set(*camera, "ev100", tomlNumber(float(ev100OfExposure(double(*after.exposure)))));
  else
    text.replace(*camera, "ev100", "exposure", value);
}

void saveCamera(const Camera& before, const Camera& after, TomlText& text) {
  if (before == after) return;
  text.set("camera", "position", tomlVector(after.position));
  text.set("camera", "target", tomlVector(after.target));
  if (before.verticalFov != after.verticalFov || !text.table("camera"))
    text.set("camera", "fov", tomlNumber(after.verticalFov));
  saveExposure(before, after, text);
  if (before.tone != after.tone) text.set("camera", "tone", tomlString(nameOf(after.tone)));
  if (upFor(after.target - after.position) != after.up) text.set("camera", "up", tomlVector(after.up));
}

// A file with ambient light has no default sky, and one with a background does not show it.
void saveEnvironment(const Environment& before, const Environment& after, bool hasDefaultSky,
                     bool isBackgroundNew, TomlText& text, std::vector<std::string>& notSaved) {
  if (before.ambient != after.ambient && hasDefaultSky)
    notSaved.push_back("ambient light beside the default sky");
  else if (before.ambient != after.ambient)
    text.set("environment", "ambient", tomlColor(after.ambient));
  if (isBackgroundNew && hasDefaultSky)
    notSaved.push_back("a background beside the default sky");
  else if (before.background != after.background)
    text.set("environment", "background", tomlColor(after.background));
}

void saveMedium(const std::optional<Medium>& before, const std::optional<Medium>& after, TomlText& text) {
  if (!before || !after) return;
  const auto save = [&](const char* key, float Medium::*member) {
    if (*before.*member != *after.*member) text.set("medium", key, tomlNumber(*after.*member));
  };
  save("extinction", &Medium::extinction);
  save("albedo", &Medium::albedo);
  save("g", &Medium::g);
}

void saveMaterial(const Material& before, const Material& after, const toml::table& table, TomlText& text) {
  if (before.type != MaterialType::dielectric) {
    if (before.color != after.color) text.set(table, "color", tomlColor(after.color));
    return;
  }
  if (before.ior != after.ior)
    text.set(table, "ior", after.dispersion > 0 ? tomlNumber(after.ior.y) : tomlColor(after.ior));
  if (before.dispersion != after.dispersion)
    text.set(table, "abbe", tomlNumber(after.dispersion > 0 ? 20 / after.dispersion : 10000.0f));
  const bool isTinted = std::isfinite(after.attenuationDistance);
  const bool differs = before.attenuationColor != after.attenuationColor ||
                       before.attenuationDistance != after.attenuationDistance;
  if (!differs || (!isTinted && !table.contains("attenuation_distance"))) return;
  text.set(table, "attenuation_color", tomlVector(isTinted ? after.attenuationColor : vec3(1)));
  if (isTinted) text.set(table, "attenuation_distance", tomlNumber(after.attenuationDistance));
}

void savePlacement(const Scene& scene, const Object& before, const Object& after, const toml::table& table,
                   TomlText& text) {
  const Placement& placement = after.placement;
  if (before.placement == placement) return;
  const Box box = boundingBox(scene.meshOf(after));
  const bool isFitted = table.contains("fit");
  // What `fit` adds to the translation so that the box's middle is where the origin would be.
  const vec3 moved = isFitted ? placement.rotation * (placement.scale * box.center()) : vec3(0);
  text.set(table, "translation", tomlVector(placement.translation + moved));
  if (before.placement.rotation != placement.rotation)
    text.set(table, "rotation", tomlVector(eulerDegrees(placement.rotation)));
  if (before.placement.scale == placement.scale) return;
  if (isFitted)
    text.set(table, "fit", tomlNumber(placement.scale * box.longestSide()));
  else
    text.set(table, "scale", tomlNumber(placement.scale));
}

TomlEntries entriesOf(const WaterDrop& drop) {
  return {{"time", tomlNumber(drop.time)},
          {"position", "[" + tomlNumber(drop.position.x) + ", " + tomlNumber(drop.position.y) + "]"},
          {"radius", tomlNumber(drop.radius)},
          {"depth", tomlNumber(drop.depth)}};
}

// False where drops that the file has would have to go and stand each under a heading of its own.
bool saveDrops(const Object& before, const Object& after, const toml::table& table, TomlText& text) {
  if (!after.water || !after.water->simulation) return true;
  const std::vector<WaterDrop>& drops = after.water->simulation->drops;
  const std::vector<WaterDrop> there =
      before.water->simulation ? before.water->simulation->drops : std::vector<WaterDrop>{};
  if (there == drops) return true;
  const toml::table* simulation = table.get_as<toml::table>("simulation");
  const toml::array* list = simulation ? simulation->get_as<toml::array>("drops") : nullptr;
  if (list && !there.empty() && there.size() < drops.size() &&
      std::equal(there.begin(), there.end(), drops.begin())) {
    for (std::size_t i = there.size(); i < drops.size(); ++i)
      text.prepend(*simulation, "drops", entriesOf(drops[i]));
    return true;
  }
  const bool hasHeadings = list && !there.empty() && !list->front().as_table()->is_inline();
  if (hasHeadings) return false;
  std::string all;
  for (const WaterDrop& drop : drops) all += (all.empty() ? "" : ", ") + tomlInlineTable(entriesOf(drop));
  all = "[" + all + "]";
  if (simulation)
    text.set(*simulation, "drops", all);
  else
    text.set(table, "simulation", "{ drops = " + all + " }");
  return true;
}

// A cue's key no longer says anything else than `value`.
void endCue(const toml::table& table, const char* key, float value, TomlText& text) {
  if (table.contains(key)) text.set(table, key, tomlNumber(value));
}

// A strength that other keys multiply: what stands there, multiplied as the light was. False where it is not
// to be had so: there is none, or it was dark.
bool scaleStrength(const toml::table& table, const char* key, vec3 before, vec3 after, TomlText& text) {
  if (!table.contains(key)) return false;
  vec3 factor(1);
  for (int c = 0; c < 3; ++c) {
    if (before[c] == 0 && after[c] != 0) return false;
    if (before[c] != 0) factor[c] = after[c] / before[c];
  }
  TomlTable reader(table, "", "");
  text.set(table, key, tomlColor(factor * reader.requiredNumberOrRgb(key, kNotNegative)));
  return true;
}

// What the file calls a light's strength.
struct Strength {
  const char* key = "intensity";
  vec3 value{0};
};

Strength strengthOf(const Light& light) {
  if (light.type == LightType::directional) return {"illuminance", light.illuminance};
  if (light.type == LightType::sky) return {"luminance", light.intensity};
  if (light.type == LightType::area) return {"luminance", light.intensity / length(cross(light.v, light.u))};
  return {"intensity", light.intensity};
}

void saveStrength(const Light& before, const Light& after, bool hasOtherCone, const toml::table& table,
                  TomlText& text) {
  const Strength was = strengthOf(before), is = strengthOf(after);
  if (was.value == is.value && before.intensity == after.intensity && !hasOtherCone) return;
  if (!hasOtherCone && (scaleStrength(table, is.key, was.value, is.value, text) ||
                        scaleStrength(table, "flux", before.intensity, after.intensity, text)))
    return;
  endCue(table, "dimmer", 1, text);
  if (table.contains("flux"))
    text.replace(table, "flux", is.key, tomlColor(is.value));
  else
    text.set(table, is.key, tomlColor(is.value));
}

void saveDirection(const Light& before, const Light& after, const toml::table& table, TomlText& text) {
  if (before.direction == after.direction) return;
  endCue(table, "pan", 0, text);
  endCue(table, "tilt", 0, text);
  if (table.contains("target"))
    text.replace(table, "target", "direction", tomlVector(after.direction));
  else
    text.set(table, "direction", tomlVector(after.direction));
}

// `isBackgroundNew`: the file did not give one before, and a sky that says nothing would no longer be seen.
void saveIsSeen(const Light& before, const Light& after, bool isBackgroundNew, const toml::table& table,
                TomlText& text) {
  if (after.type != LightType::sky) return;
  if (before.isSeen != after.isSeen || (isBackgroundNew && !table.contains("visible")))
    text.set(table, "visible", after.isSeen ? "true" : "false");
}

void saveLight(const Light& before, const Light& after, const toml::table& table, TomlText& text) {
  if (before == after) return;
  const bool isArea = before.type == LightType::area;
  if (before.position != after.position) {
    const char* key = isArea ? "corner" : before.type == LightType::line ? "from" : "position";
    text.set(table, key, tomlVector(after.position));
  }
  if (before.u != after.u) text.set(table, "u", tomlVector(after.u));
  if (before.v != after.v) text.set(table, "v", tomlVector(after.v));
  if (before.skyRotation != after.skyRotation) text.set(table, "rotation", tomlNumber(after.skyRotation));
  if (before.end != after.end) text.set(table, "to", tomlVector(after.end));
  // A spot that is moved keeps its direction, which "target" would not.
  Light aimed = before;
  if (table.contains("target") && before.position != after.position) aimed.direction = vec3(0);
  if (!isArea) saveDirection(aimed, after, table, text);
  const bool hasOtherCone = before.innerAngle != after.innerAngle || before.outerAngle != after.outerAngle;
  if (hasOtherCone) {
    text.set(table, "outer_angle", tomlNumber(after.outerAngle));
    text.set(table, "inner_angle", tomlNumber(after.innerAngle));
    endCue(table, "zoom", after.outerAngle, text);
  }
  if (before.radius != after.radius) text.set(table, "radius", tomlNumber(after.radius));
  if (before.angle != after.angle) text.set(table, "angle", tomlNumber(after.angle));
  if (before.goboRotation != after.goboRotation)
    text.set(table, "gobo_rotation", tomlNumber(after.goboRotation));
  saveStrength(before, after, hasOtherCone, table, text);
}

// `after` without what changed of suns by their skies, which a file does not have.
std::vector<Light> withoutMovedSuns(const std::vector<Light>& before, std::vector<Light> after) {
  constexpr float kRounding = 1e-4f;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const uint32_t sun = before[i].sun;
    if (sun == kNone) continue;
    Light expected = sunWithSky(before[sun], before[i], after[i]);
    const bool isNear =
        distance(expected.direction, after[sun].direction) < kRounding &&
        distance(expected.illuminance, after[sun].illuminance) <= kRounding * length(expected.illuminance);
    expected.direction = after[sun].direction;
    expected.illuminance = after[sun].illuminance;
    if (isNear && expected == after[sun]) after[sun] = before[sun];
  }
  return after;
}

// What the names of imported things begin with, where there are as many objects before them; nothing in a
// scene that is the imported file alone.
std::string importPrefix(const Scene& scene, const toml::table& table, std::size_t objects) {
  if (scene.file.extension() != ".toml") return {};
  return table["name"].value_or("object " + std::to_string(objects + 1)) + "/";
}

// Tables of imports stand for as many objects as their names begin.
void saveObjects(const Scene& before, const Scene& after, TomlText& text,
                 std::vector<std::string>& notSaved) {
  std::size_t next = 0;
  const auto addIfMoved = [&](std::size_t i) {
    if (before.objects[i].placement != after.objects[i].placement) notSaved.push_back(before.objects[i].name);
  };
  for (const toml::table* table : text.tables("object")) {
    if (!table->contains("import")) {
      if (next >= before.objects.size()) return;
      savePlacement(after, before.objects[next], after.objects[next], *table, text);
      if (!saveDrops(before.objects[next], after.objects[next], *table, text))
        notSaved.push_back("the drops into " + before.objects[next].name);
      ++next;
      continue;
    }
    const std::string prefix = importPrefix(before, *table, next);
    for (; next < before.objects.size() && before.objects[next].name.starts_with(prefix); ++next)
      addIfMoved(next);
  }
  for (; next < before.objects.size(); ++next) addIfMoved(next);
}

// After all else has said what it could not save.
void saveImports(const Scene& before, const Scene& after, TomlText& text,
                 std::vector<std::string>& notSaved) {
  std::size_t next = 0;
  for (const toml::table* table : text.tables("object")) {
    const std::string prefix = importPrefix(before, *table, next);
    const auto isOfIt = [&](const Object& object) { return object.name.starts_with(prefix); };
    if (table->contains("import")) {
      saveImported(before, after, prefix, *table, text, notSaved);
      while (next < before.objects.size() && isOfIt(before.objects[next])) ++next;
    } else {
      ++next;
    }
  }
}

// Of lists that the file has a part of, in a row: `first` is the place of its first table.
template <class Element, class Save>
void saveList(const std::vector<Element>& before, const std::vector<Element>& after, std::size_t first,
              const std::vector<const toml::table*>& tables, std::vector<std::string>& notSaved,
              const Save& save) {
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (i >= first && i - first < tables.size())
      save(before[i], after[i], *tables[i - first]);
    else if (!(before[i] == after[i]))
      notSaved.push_back(before[i].name);
  }
}

}  // namespace

SavedScene savedScene(const std::string& source, const Scene& before, const Scene& after) {
  TomlText text(source, before.file.string());
  SavedScene saved;
  const auto givesBackground = [&] {
    const toml::table* environment = text.table("environment");
    return environment && environment->contains("background");
  };
  const bool isBackgroundNew =
      !givesBackground() && before.environment.background != after.environment.background;
  saveCamera(before.camera, after.camera, text);
  saveEnvironment(before.environment, after.environment, before.hasDefaultSky, isBackgroundNew, text,
                  saved.notSaved);
  saveMedium(before.medium, after.medium, text);
  saveList(before.materials, after.materials, 0, text.tables("material"), saved.notSaved,
           [&](const Material& was, const Material& is, const toml::table& table) {
             saveMaterial(was, is, table, text);
           });
  saveObjects(before, after, text, saved.notSaved);
  const std::vector<const toml::table*> lights = text.tables("light");
  saveList(before.lights, withoutMovedSuns(before.lights, after.lights),
           before.lights.size() - std::min(lights.size(), before.lights.size()), lights, saved.notSaved,
           [&](const Light& was, const Light& is, const toml::table& table) {
             saveLight(was, is, table, text);
             saveIsSeen(was, is, isBackgroundNew, table, text);
           });
  saveImports(before, after, text, saved.notSaved);
  saved.text = text.text();
  return saved;
}

std::string sceneAround(const std::filesystem::path& file) {
  return "[[object]]\nname = " + tomlString(file.stem().string()) +
         "\nimport = " + tomlString(file.filename().string()) + "\n";
}

}  // namespace nephroid
