// The skies that are seen where nothing stands, in glass and in mirrors.
#pragma once

#include <map>
#include <vector>

#include "lights/sky_sight.h"
#include "scene/scene.h"

namespace nephroid {

// A map and its coarser levels, each of half as many columns and rows (rounded down), down to one cell. A
// cell's luminance is the mean of what it covers of the level before, by the solid angle. The map must
// outlive it.
class SkyLevels {
 public:
  explicit SkyLevels(const SkyMap& map);

  int count() const { return int(coarser_.size()) + 1; }
  const SkyMap& operator[](int level) const {
    return level == 0 ? *map_ : coarser_[static_cast<std::size_t>(level) - 1];
  }

 private:
  const SkyMap* map_;
  std::vector<SkyMap> coarser_;
};

struct SeenSky {
  SkySight sight{};
  uint32_t map = 0;  // in Scene::skies
  const SkyLevels* levels = nullptr;
};

class SeenSkies {
 public:
  // The maps are those of `scene`, which must outlive it. None is seen until `place`.
  explicit SeenSkies(const Scene& scene) : maps_(scene.skies) {}

  // Those of the lights of `scene`, whose maps are the same. Returns whether they differ from those before.
  bool place(const Scene& scene);

  const std::vector<SeenSky>& all() const { return all_; }

  // The sum (nit) in the direction `toward` (unit), filtered over `width` (radians; 0: not filtered).
  vec3 luminance(vec3 toward, float width) const;
  vec3 mean() const;  // nit, of the sum over all directions, without disks

 private:
  const std::vector<SkyMap>& maps_;
  std::map<uint32_t, SkyLevels> levels_;  // of the maps that were seen
  std::vector<SeenSky> all_;
};

// How a light of the type sky is seen.
SkySight sightOf(const Scene& scene, const Light& sky);

}  // namespace nephroid
