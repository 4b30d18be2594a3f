// No caustics: to see and to time all else.
#include "techniques/technique_info.h"

namespace nephroid {
namespace {

constexpr TechniqueTraits kTraits{.drawsCaustics = false};

class NoCaustics final : public TechniqueBase {
 public:
  TechniqueTraits traits() const override { return kTraits; }
  void update(GpuScene&) override {}
  void shade(gpu::CommandList&, const ReceiverPoints&, const gpu::Image&) override {}
};

std::unique_ptr<Technique> make(const TechniqueContext&) {
  return std::make_unique<NoCaustics>();
}

constexpr Omission kOmissions[] = {
    {"Caustics: light that met glass or a mirror is not drawn at all", hasCaster},
    omissions::kScattering,
};

}  // namespace

extern const TechniqueInfo kNoCaustics;
constinit const TechniqueInfo kNoCaustics{
    .name = "none",
    .summary = "No caustics",
    .make = make,
    .traits = kTraits,
    .omissions = kOmissions,
};

}  // namespace nephroid
