#include <memory>

#include "command.h"
#include "viewer.h"

namespace nephroid {

Command addView(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "view", "A window in which light, glass, water and camera are moved by hand; ? in it shows the keys");
  const auto options = std::make_shared<ViewerOptions>();
  command
      ->add_option("SCENE", options->scene,
                   "The scene: a .toml, .gltf or .glb file. Left out: what is dropped onto the window")
      ->type_name("");
  addSize(*command, options->size);
  addTime(*command, options->time);
  addTechnique(*command, options->settings);
  addDevice(*command, options->device);
  command
      ->add_option("--frames", options->frames,
                   "End after so many frames, each of them made anew as if a light had moved")
      ->check(CLI::Range(1u, 1000000u))
      ->type_name("N");
  addStats(*command, options->stats);
  return {command, [options] { runViewer(*options); }};
}

}  // namespace nephroid
