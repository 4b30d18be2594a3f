// A technique that consists of several techniques, each for its own casters or its own part of the work.
#pragma once

#include <memory>
#include <vector>

#include "techniques/technique.h"

namespace nephroid {

struct CompositePart {
  std::unique_ptr<Technique> technique;
  bool shades = true;    // lights receivers
  bool scatters = true;  // draws what casters scatter
};

class CompositeTechnique final : public Technique {
 public:
  explicit CompositeTechnique(std::vector<CompositePart> parts);

  // A trait that needs more work is set where any part has it; a trait that saves work is set where all parts
  // that shade have it.
  TechniqueTraits traits() const override;
  void reserve(uvec2 size) override;
  void update(GpuScene& gpuScene) override;
  void record(gpu::CommandList& commands, GpuScene& gpuScene) override;
  std::vector<Lattice> lattices() const override;
  std::vector<PassOutput> outputs() const override;
  const RayMesh* rayMesh() const override;  // that of the first part that has one
  bool finish() override;
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override;
  void scatter(gpu::CommandList& commands, const WaysOfSight& ways, const gpu::Image& luminance) override;

 private:
  std::vector<CompositePart> parts_;
};

}  // namespace nephroid
