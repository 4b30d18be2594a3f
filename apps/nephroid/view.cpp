#include <memory>

#include "command.h"
#include "viewer.h"

namespace nephroid {

Command addView(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "view",
      "Opens a window in which lights, objects, water and camera are moved by hand; ? shows the keys");
  const auto options = std::make_shared<ViewerOptions>();
  command
      ->add_option("SCENE", options->scene,
                   "The scene: a .toml, .gltf or .glb file. Without it: drop a file onto the window")
      ->type_name("");
  addSize(*command, options->size);
  addTime(*command, options->time);
  addTone(*command, options->tone);
  addTechnique(*command, options->settings);
  addDevice(*command, options->device);
  command
      ->add_option("--frames", options->frames,
                   "End after this many frames; each is computed completely, as if a light had moved")
      ->check(CLI::Range(1u, 1000000u))
      ->type_name("N");
  command
      ->add_option("--show", options->shown,
                   "What is shown over the picture or in its place, as by the keys 1 to 9 and C: " +
                       joined(viewNames()) + "; several with commas")
      ->delimiter(',')
      ->check(oneOf(viewNames()))
      ->type_name("VIEW,...");
  command
      ->add_option("--picture", options->picture,
                   "Write what the window shows, without panels, as PNG, and end")
      ->type_name("OUT.png");
  addStats(*command, options->stats);
  return {command, [options] {
            if (!options->picture.empty()) checkOutput(options->picture, options->scene, {".png"});
            runViewer(*options);
          }};
}

}  // namespace nephroid
