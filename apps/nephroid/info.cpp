#include <iostream>
#include <memory>

#include "command.h"
#include "core/error.h"
#include "gpu/device.h"
#include "techniques/registry.h"

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

void printProgram() {
  std::cout << "nephroid   " NEPHROID_VERSION "\n"
            << "Embree     " NEPHROID_EMBREE_VERSION "\n"
            << "techniques " << joined(techniqueList()) << '\n';
  printDevices();
}

}  // namespace

Command addInfo(CLI::App& program) {
  CLI::App* command = program.add_subcommand("info", "Versions, techniques and devices");
  return {command, printProgram};
}

}  // namespace nephroid
