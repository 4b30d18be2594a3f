#include <memory>

#include "command.h"
#include "core/error.h"
#include "scene/load.h"
#include "techniques/sources.h"
#include "transport/table/table_file.h"

namespace nephroid {
namespace {

struct BakeOptions : CommonOptions {
  TechniqueSettings technique;
};

void runBake(const BakeOptions& options) {
  checkOutput(options.output, options.scene);
  Progress progress(progressDisplay(options.isQuiet));
  const Scene scene = loadScene(options.scene);
  const std::vector<TransportTable> tables = makeTables(scene, options.technique, progress);
  if (tables.empty())
    throw InputError(
        "'" + options.scene.string() +
        "' has no caster that light passes through, so there is nothing to bake; give an object a "
        "material of type 'dielectric'");
  writeTables(tables, options.output);
}

}  // namespace

Command addBake(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "bake",
      "The light transport tables of a scene, in a file for --baked. They hold wherever casters, "
      "receivers, lights and camera are moved to");
  const auto options = std::make_shared<BakeOptions>();
  addScene(*command, options->scene);
  addOutput(*command, options->output, "The file to write");
  for (const SettingField& field : settingFields())
    if (field.member == &TechniqueSettings::directions) addField(*command, field, options->technique, false);
  addQuiet(*command, options->isQuiet);
  return {command, [options] { runBake(*options); }};
}

}  // namespace nephroid
