#include <iostream>
#include <memory>
#include <span>

#include "command.h"
#include "core/error.h"
#include "formats/load.h"
#include "gpu/device.h"
#include "render/omissions.h"
#include "report/diagnose.h"
#include "techniques/registry.h"
#include "transport/table/table_file.h"

namespace nephroid {
namespace {

void printDevices() {
  std::cout << "\nVulkan devices, for --device\n";
  try {
    for (const gpu::DeviceInfo& device : gpu::listDevices()) {
      std::cout << "  " << device.index << "  " << device.name << " (" << device.type << ", " << device.driver
                << ", Vulkan " << device.apiVersion << ")\n";
      if (!device.missing.empty())
        std::cout << "     cannot be used, it lacks: " << joined(device.missing) << '\n';
    }
  } catch (const RuntimeFailure& none) {
    std::cout << "  none: " << none.what() << '\n';
  }
}

void printOmissions(const std::string& heading, std::span<const Omission> omissions) {
  std::cout << "  " << heading << '\n';
  for (const Omission& omission : omissions) std::cout << "    - " << omission.what << '\n';
}

void printAllOmissions() {
  std::cout << "\nLeft out, compared with the reference\n";
  printOmissions("by every technique", omissionsOfFrame());
  for (const TechniqueInfo* info : techniques()) printOmissions(info->name, info->omissions);
}

void printProgram() {
  std::cout << "nephroid   " NEPHROID_VERSION "\n"
            << "Embree     " NEPHROID_EMBREE_VERSION "\n"
            << "techniques " << joined(techniqueList()) << "\n"
            << "tables     " << cacheFolder().string() << "\n";
  printDevices();
  printAllOmissions();
}

void runInfo(const std::filesystem::path& sceneFile) {
  if (sceneFile.empty()) return printProgram();
  const Scene scene = loadScene(sceneFile);
  std::cout << describe(scene, diagnose(scene));
}

}  // namespace

Command addInfo(CLI::App& program) {
  CLI::App* command = program.add_subcommand("info",
                                             "Shows versions, techniques and devices. For a scene: what was "
                                             "loaded, which casters make no caustics, and why");
  const auto scene = std::make_shared<std::filesystem::path>();
  command->add_option("SCENE", *scene, "The scene: a .toml, .gltf or .glb file")->type_name("");
  return {command, [scene] { runInfo(*scene); }};
}

}  // namespace nephroid
