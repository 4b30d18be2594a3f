#include "techniques/registry.h"

#include <algorithm>

#include "core/error.h"
#include "techniques/list.h"

namespace nephroid {

#define DECLARE_TECHNIQUE(name) extern const TechniqueInfo name;
NEPHROID_TECHNIQUES(DECLARE_TECHNIQUE)
#undef DECLARE_TECHNIQUE

namespace {

#define ADDRESS_OF_TECHNIQUE(name) &(name),
constexpr const TechniqueInfo* kTechniques[] = {NEPHROID_TECHNIQUES(ADDRESS_OF_TECHNIQUE)};
#undef ADDRESS_OF_TECHNIQUE

void addOwn(const TechniqueInfo& info, OwnSettings& own, std::vector<SettingsView>& views) {
  for (const TechniqueInfo* part : info.parts) addOwn(*part, own, views);
  for (const SettingsOwner& owner : info.settings) {
    const bool isThere = std::ranges::any_of(
        views, [&](const SettingsView& view) { return view.settings.data() == owner.settings.data(); });
    if (!isThere) views.push_back({owner.owner, owner.settings, owner.values(own)});
  }
}

std::vector<SettingsView> sharedSettings(TechniqueSettings& settings) {
  return {{"Transport", transportSettings(), &settings.transport},
          {"Beams", beamSettings(), &settings.beams}};
}

}  // namespace

std::span<const TechniqueInfo* const> techniques() {
  return kTechniques;
}

const char* defaultTechnique() {
  return kTechniques[0]->name;
}

const TechniqueInfo& techniqueNamed(const std::string& name) {
  std::vector<std::string> names;
  std::string all;
  for (const TechniqueInfo* info : kTechniques) {
    if (info->name == name) return *info;
    names.emplace_back(info->name);
    all += (all.empty() ? "" : ", ") + names.back();
  }
  const std::string nearest = nearestName(name, names);
  throw InputError("--technique: there is no technique \"" + name + "\"; " +
                   (nearest.empty() ? "there are: " + all : "did you mean \"" + nearest + "\"?"));
}

std::unique_ptr<Technique> makeTechnique(const TechniqueContext& context) {
  return techniqueNamed(context.settings.technique).make(context);
}

std::vector<SettingsView> allSettings(TechniqueSettings& settings) {
  std::vector<SettingsView> views = sharedSettings(settings);
  for (const TechniqueInfo* info : kTechniques) addOwn(*info, settings.own, views);
  return views;
}

std::vector<SettingsView> usedSettings(TechniqueSettings& settings) {
  std::vector<SettingsView> views = sharedSettings(settings);
  addOwn(techniqueNamed(settings.technique), settings.own, views);
  return views;
}

TransportSettings transportOf(const TechniqueSettings& settings) {
  TransportSettings transport = settings.transport;
  if (!techniqueNamed(settings.technique).bake.write) transport.baked = settings.baked;
  return transport;
}

void prepareTransport(const Scene&, SceneTransport& transport, const TechniqueSettings&, Progress&) {
  transport.source();
}

bool isTransportStillPrepared(const PreparedParts& before, const PreparedParts& after,
                              const TechniqueSettings& settings) {
  return settings.transport.source == Source::traced ||
         std::ranges::equal(before.materials, after.materials, {}, &Material::ior, &Material::ior);
}

}  // namespace nephroid
