#include "viewer/stage.h"

#include "techniques/registry.h"

namespace nephroid {

Stage::Stage(gpu::Device& device, std::unique_ptr<Prepared> prepared, uvec2 size)
    : prepared_(std::move(prepared)),
      technique_(makeTechnique({device, prepared_->settings, *prepared_->transport, stats_})),
      renderer_(device, *prepared_->transport, renderSettings(prepared_->settings, size), *technique_) {}

}  // namespace nephroid
