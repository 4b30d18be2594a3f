#include <memory>

#include "command.h"
#include "core/error.h"
#include "formats/load.h"
#include "techniques/registry.h"
#include "transport/scene_transport.h"
#include "transport/table/table_file.h"

namespace nephroid {
namespace {

struct BakeOptions : CommonOptions {
  TechniqueSettings technique;
  BakeRequest request;  // its range
  std::vector<std::filesystem::path> parts;
};

void bakeTables(const BakeOptions& options, const Scene& scene, Progress& progress) {
  const std::vector<TransportTable> tables = makeTables(scene, options.technique.transport, progress);
  if (tables.empty())
    throw InputError(
        "'" + options.scene.string() +
        "' has no caster that light passes through, so there is nothing to bake; give an object a "
        "material of type 'dielectric'");
  writeTables(tables, options.output);
}

// Techniques that bake something of their own.
std::vector<const TechniqueInfo*> bakers() {
  std::vector<const TechniqueInfo*> all;
  for (const TechniqueInfo* info : techniques())
    if (info->bake.write) all.push_back(info);
  return all;
}

void merge(const BakeOptions& options) {
  for (const TechniqueInfo* info : bakers())
    if (info->bake.merge) return info->bake.merge(options.parts, options.output);
  throw InputError("--merge: no technique bakes in parts");
}

void runBake(const BakeOptions& options) {
  checkOutput(options.output, options.scene);
  if (!options.parts.empty()) return merge(options);
  if (options.scene.empty()) throw InputError("bake: name a SCENE, or parts to --merge");
  Progress progress(progressDisplay(options.isQuiet));
  const Scene scene = loadScene(options.scene);
  Stats stats;
  warnOf(scene, stats);
  const TechniqueBake& bake = techniqueNamed(options.technique.technique).bake;
  if (!bake.write) return bakeTables(options, scene, progress);
  BakeRequest request = options.request;
  request.scene = options.scene;
  request.output = options.output;
  bake.write(scene, options.technique, request, progress);
}

void addLightRange(CLI::App& command, BakeRequest& request) {
  command
      .add_option_function<std::string>(
          "--light-range",
          [&request](const std::string& text) {
            const std::optional<uvec2> pair = pairOf(text, ':');
            if (!pair || pair->y <= pair->x)
              throw CLI::ValidationError("--light-range", "'" + text + "' is not FIRST:END, such as 0:100");
            request.first = pair->x;
            request.end = pair->y;
          },
          "Bake only the light samples A to B - 1 of irradiance volumes; parts are joined with --merge")
      ->type_name("A:B");
}

}  // namespace

Command addBake(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "bake",
      "Writes the light transport tables of a scene, or its irradiance volumes, to a file for --baked. They "
      "stay valid when casters, receivers, lights and camera move");
  const auto options = std::make_shared<BakeOptions>();
  command->add_option("SCENE", options->scene, "The scene: a .toml, .gltf or .glb file")->type_name("");
  addOutput(*command, options->output, "The file to write");
  std::vector<std::string> names{options->technique.technique};
  std::string help = "The technique to bake for: light transport tables for " + names[0];
  for (const TechniqueInfo* info : bakers()) {
    names.emplace_back(info->name);
    help += std::string(", ") + info->bake.what + " for " + info->name;
  }
  command->add_option("--technique", options->technique.technique, help)
      ->check(oneOf(names))
      ->type_name(joined(names, "|"))
      ->capture_default_str();
  for (const SettingsView& view : allSettings(options->technique))
    for (const Setting& setting : view.settings)
      if (setting.isBaked) addSetting(*command, setting, view.values, view.owner);
  addLightRange(*command, options->request);
  command
      ->add_option(
          "--merge", options->parts,
          "Instead of baking a scene: join files of irradiance volumes that were baked with --light-range")
      ->type_name("PART...");
  addQuiet(*command, options->isQuiet);
  return {command, [options] { runBake(*options); }};
}

}  // namespace nephroid
