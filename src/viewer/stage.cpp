#include "viewer/stage.h"

#include "techniques/registry.h"

namespace nephroid {
namespace {

RenderSettings keepingLight(RenderSettings settings, bool keepsLight) {
  settings.keepsLight = keepsLight;
  return settings;
}

}  // namespace

Stage::Stage(gpu::Device& device, std::unique_ptr<Prepared> prepared, uvec2 size, bool keepsLight)
    : prepared_(std::move(prepared)),
      technique_(makeTechnique({device, prepared_->settings, *prepared_->transport, stats_})),
      renderer_(device, *prepared_->transport,
                keepingLight(renderSettings(prepared_->settings, size), keepsLight), *technique_) {}

std::vector<Lattice> Stage::lattices() const {
  std::vector<Lattice> all = technique_->lattices();
  for (const Lattice& slice : renderer_.slices()) all.push_back(slice);
  return all;
}

}  // namespace nephroid
