#include <iostream>

#include "command.h"

namespace nephroid {
namespace {

void runInfo() {
  std::cout << "nephroid " NEPHROID_VERSION "\n"
            << "Embree   " NEPHROID_EMBREE_VERSION "\n";
}

}  // namespace

Command addInfo(CLI::App& program) {
  CLI::App* command = program.add_subcommand("info", "Versions");
  return {command, runInfo};
}

}  // namespace nephroid
