// What of a frame can be taken from the one before.
#pragma once

#include <optional>
#include <vector>

#include "scene/scene.h"

namespace nephroid {

struct Remade {
  bool sight = true;  // what the camera sees, whatever lights it
  bool shadowMaps = true;
  bool beams = true;  // what the technique does that no view has a part in
};

// The scene of the last frame, as far as it may move: placements, materials, water, lights and the camera.
class LastScene {
 public:
  // What has to be made again for `scene`, which is the last one from now on. Without `keepsLight`, all that
  // a moved light would change is. `beamsFollowCamera`: they depend on where it stands.
  Remade replace(const Scene& scene, bool keepsLight, bool beamsFollowCamera);

 private:
  struct Standing {
    uint32_t material = 0;
    Placement placement;
    std::vector<vec3> water;  // its vertices
    bool operator==(const Standing&) const = default;
  };

  bool isThere_ = false;
  Camera camera_;
  std::vector<Standing> objects_;
  std::vector<Material> materials_;
  std::vector<Light> lights_;
};

}  // namespace nephroid
