#include <memory>

#include "command.h"
#include "core/error.h"
#include "formats/load.h"
#include "irradiance_volume/volume_file.h"
#include "techniques/irradiance_volume/irradiance_volume.h"
#include "techniques/sources.h"
#include "transport/table/table_file.h"

namespace nephroid {
namespace {

constexpr const char* kVolumes = "irradiance-volume";

struct BakeOptions : CommonOptions {
  TechniqueSettings technique;
  SampleRange range;
  std::vector<std::filesystem::path> parts;
};

void bakeTables(const BakeOptions& options, const Scene& scene, Progress& progress) {
  const std::vector<TransportTable> tables = makeTables(scene, options.technique, progress);
  if (tables.empty())
    throw InputError(
        "'" + options.scene.string() +
        "' has no caster that light passes through, so there is nothing to bake; give an object a "
        "material of type 'dielectric'");
  writeTables(tables, options.output);
}

void bakeVolumes(const BakeOptions& options, const Scene& scene, Progress& progress) {
  const SceneVolumes all = sceneVolumes(scene, options.technique);
  std::vector<IrradianceVolume*> volumes;
  for (const auto& volume : all.volumes) volumes.push_back(volume.get());
  if (volumes.empty())
    throw InputError("'" + options.scene.string() +
                     "' has no caster, so there is nothing to bake; give an object a material of type "
                     "'dielectric' or 'mirror'");
  writeVolumes(volumes, options.range, options.output, progress);
}

void runBake(const BakeOptions& options) {
  checkOutput(options.output, options.scene);
  if (!options.parts.empty()) return mergeVolumes(options.parts, options.output);
  if (options.scene.empty()) throw InputError("bake: name a SCENE, or parts to --merge");
  Progress progress(progressDisplay(options.isQuiet));
  const Scene scene = loadScene(options.scene);
  if (options.technique.technique == kVolumes)
    bakeVolumes(options, scene, progress);
  else
    bakeTables(options, scene, progress);
}

void addLightRange(CLI::App& command, SampleRange& range) {
  command
      .add_option_function<std::string>(
          "--light-range",
          [&range](const std::string& text) {
            const std::optional<uvec2> pair = pairOf(text, ':');
            if (!pair || pair->y <= pair->x)
              throw CLI::ValidationError("--light-range", "'" + text + "' is not FIRST:END, such as 0:100");
            range = {pair->x, pair->y};
          },
          "Light samples A to B - 1 of an irradiance volume alone: a part, for --merge")
      ->type_name("A:B");
}

}  // namespace

Command addBake(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "bake",
      "The light transport tables of a scene, or its irradiance volumes, in a file for --baked. They hold "
      "wherever casters, receivers, lights and camera are moved to");
  const auto options = std::make_shared<BakeOptions>();
  command->add_option("SCENE", options->scene, "The scene: a .toml, .gltf or .glb file")->type_name("");
  addOutput(*command, options->output, "The file to write");
  const std::vector<std::string> names{options->technique.technique, kVolumes};
  command
      ->add_option(
          "--technique", options->technique.technique,
          "What is baked: light transport tables for " + names[0] + ", irradiance volumes for " + names[1])
      ->check(oneOf(names))
      ->type_name(joined(names, "|"))
      ->capture_default_str()
      ->group("Technique");
  for (const ChoiceField& field : choiceFields())
    if (field.isBaked) addChoice(*command, field, options->technique);
  for (const SettingField& field : settingFields())
    if (field.isBaked) addField(*command, field, options->technique, false);
  addLightRange(*command, options->range);
  command
      ->add_option("--merge", options->parts,
                   "Irradiance volumes baked by --light-range, to be joined in place of baking a scene")
      ->type_name("PART...");
  addQuiet(*command, options->isQuiet);
  return {command, [options] { runBake(*options); }};
}

}  // namespace nephroid
