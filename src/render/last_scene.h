// Finds what can be kept from the frame before.
#pragma once

#include <optional>
#include <vector>

#include "scene/scene.h"

namespace nephroid {

struct Remade {
  bool sight = true;  // the surfaces that the camera sees, and what they show by no light
  bool lamps = true;  // what the surfaces see of the lamps
  bool shadowMaps = true;
  bool beams = true;  // the technique's work that does not depend on a view
};

// The parts of the last frame's scene that may change: placements, materials, water, lights, camera and
// environment.
class LastScene {
 public:
  // Returns what has to be computed again for `scene`, and stores it as the last scene. Without `keepsLight`,
  // everything that a moved light would change is computed again. `beamsFollowCamera`: the beams depend on
  // the camera's position.
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
  Environment environment_;
  std::vector<Standing> objects_;
  std::vector<Material> materials_;
  std::vector<Light> lights_;
};

}  // namespace nephroid
