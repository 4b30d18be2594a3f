#include "viewer/stage.h"

#include "techniques/registry.h"

namespace nephroid {
namespace {

RenderSettings keepingLight(RenderSettings settings) {
  settings.keepsLight = true;
  return settings;
}

}  // namespace

Stage::Stage(gpu::Device& device, std::unique_ptr<Prepared> prepared, uvec2 size)
    : prepared_(std::move(prepared)),
      technique_(makeTechnique({device, prepared_->settings, *prepared_->transport, stats_})),
      renderer_(device, *prepared_->transport, keepingLight(renderSettings(prepared_->settings, size)),
                *technique_) {}

}  // namespace nephroid
