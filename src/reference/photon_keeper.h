// Stores the photons of a pass's part. Photons that the camera sees directly are added to their pixel at once
// (splatted), without a kernel. All photons are also stored in maps, for view rays that go through casters.
#pragma once

#include "reference/photon_map.h"
#include "reference/photons.h"
#include "reference/pinhole.h"

namespace nephroid {

// Luminance (nit) that a photon adds to a pixel.
struct Splat {
  vec2 place{0};        // pixels from the picture's upper left corner, or about it
  uint32_t photon = 0;  // in its pass
  bool isScattered = false;
  vec3 luminance{0};
};

struct KeeperSettings {
  const Scene* scene = nullptr;
  const Boundaries* boundaries = nullptr;
  const Pinhole* camera = nullptr;
  const PhotonPass* pass = nullptr;
  uint32_t mediumOfCamera = kNone;  // the object it is inside of
  bool splats = true;
};

class PhotonKeeper final : public PhotonVisitor {
 public:
  explicit PhotonKeeper(const KeeperSettings& keeperSettings) : settings_(keeperSettings) {}
  void segment(const PhotonSegment& segment) override;
  void landing(const PhotonSegment& segment, const Hit& hit, vec3 flux) override;

  std::vector<StoredPhoton> onSurfaces, inVolumes;  // their flux as if the part were the whole pass
  std::vector<Splat> splats;

 private:
  void keep(StoredPhoton photon, std::vector<StoredPhoton>& photons) const;
  void splat(const PhotonSegment& segment, vec3 place, vec3 reflected, float clearance, bool isScattered,
             const Pinhole::Projection& seen);

  KeeperSettings settings_;
};

}  // namespace nephroid
