// What of a frame is lit, and how much of the lamps it sees.
#include "render/frame.h"

namespace nephroid {

std::vector<Renderer::LitView> Renderer::litViews() const {
  std::vector<LitView> views;
  const auto add = [&](uint32_t which, const std::optional<gpu::Region>& region) {
    const SeenImages& seen = images_.seen[which];
    views.push_back({which, {&seen.position, &seen.normal, region}, &seen.directLux, &seen.causticsLux});
  };
  add(kSeen, std::nullopt);
  if (isByRays_ && raySight_.hasPoints())
    views.push_back({kSeenByRays, raySight_.points(), &raySight_.directLux(), &raySight_.causticsLux()});
  if (sight_.reflects()) add(kSeenReflected, sight_.region());
  if (sight_.disperses())
    for (const uint32_t channel : {kSeenGreen, kSeenBlue}) add(channel, sight_.region());
  return views;
}

// From all points that are lit.
void Renderer::lookAtLamps() {
  if (sample_.index == 0) lampShadows_.forget();
  for (const LitView& lit : litViews()) {
    if (lit.view != kSeenByRays) {
      lampShadows_.look(lit.view, transport_.rayScene(), sample_);
      continue;
    }
    const SeenByRays& seen = raySight_.seen();
    lampShadows_.look(
        lit.view, transport_.rayScene(), sample_,
        {seen.positions, seen.normals, uvec2(seen.region.corner), seen.region.size, seen.ranges},
        kPointsInRow);
  }
}

}  // namespace nephroid
