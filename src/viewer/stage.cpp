#include "viewer/stage.h"

#include "techniques/registry.h"

namespace nephroid {

Stage::Stage(gpu::Device& device, std::unique_ptr<Prepared> prepared, uvec2 size, bool keepsLight)
    : device_(device),
      prepared_(std::move(prepared)),
      keepsLight_(keepsLight),
      technique_(newTechnique()),
      renderer_(newRenderer(*technique_, size)) {}

std::unique_ptr<Technique> Stage::newTechnique() {
  return makeTechnique({device_, prepared_->settings.technique, *prepared_->transport, stats_});
}

std::unique_ptr<Renderer> Stage::newRenderer(Technique& technique, uvec2 size) const {
  RenderSettings settings = renderSettings(prepared_->settings, size);
  settings.keepsLight = keepsLight_;
  return std::make_unique<Renderer>(device_, *prepared_->transport, settings, technique);
}

void Stage::remake() {
  std::unique_ptr<Technique> technique = newTechnique();
  renderer_ = newRenderer(*technique, size());
  technique_ = std::move(technique);
}

std::vector<Lattice> Stage::lattices() const {
  std::vector<Lattice> all = technique_->lattices();
  for (const Lattice& slice : renderer_->slices()) all.push_back(slice);
  return all;
}

}  // namespace nephroid
