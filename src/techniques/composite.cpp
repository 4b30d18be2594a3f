#include "techniques/composite.h"

#include <utility>

namespace nephroid {
namespace {

template <class Element>
std::vector<Element> ofAll(const std::vector<std::unique_ptr<Technique>>& parts,
                           std::vector<Element> (Technique::*get)() const) {
  std::vector<Element> all;
  for (const auto& part : parts)
    for (const Element& element : ((*part).*get)()) all.push_back(element);
  return all;
}

}  // namespace

CompositeTechnique::CompositeTechnique(std::vector<std::unique_ptr<Technique>> parts)
    : parts_(std::move(parts)) {}

TechniqueTraits CompositeTechnique::traits() const {
  TechniqueTraits all{
      .followsCamera = false, .usesBeams = false, .coversSquares = true, .drawsCaustics = false};
  for (const auto& part : parts_) {
    const TechniqueTraits own = part->traits();
    all.followsCamera = all.followsCamera || own.followsCamera;
    all.usesBeams = all.usesBeams || own.usesBeams;
    all.coversSquares = all.coversSquares && own.coversSquares;
    all.drawsCaustics = all.drawsCaustics || own.drawsCaustics;
  }
  return all;
}

void CompositeTechnique::reserve(uvec2 size) {
  for (const auto& part : parts_) part->reserve(size);
}

void CompositeTechnique::update(GpuScene& gpuScene) {
  for (const auto& part : parts_) part->update(gpuScene);
}

void CompositeTechnique::record(gpu::CommandList& commands, GpuScene& gpuScene) {
  for (const auto& part : parts_) part->record(commands, gpuScene);
}

std::vector<Lattice> CompositeTechnique::lattices() const {
  return ofAll(parts_, &Technique::lattices);
}

std::vector<PassOutput> CompositeTechnique::outputs() const {
  return ofAll(parts_, &Technique::outputs);
}

bool CompositeTechnique::finish() {
  bool isDone = true;
  for (const auto& part : parts_) isDone = part->finish() && isDone;
  return isDone;
}

void CompositeTechnique::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                               const gpu::Image& causticsLux) {
  for (const auto& part : parts_) part->shade(commands, points, causticsLux);
}

void CompositeTechnique::scatter(gpu::CommandList& commands, const WaysOfSight& ways,
                                 const gpu::Image& luminance) {
  for (const auto& part : parts_) part->scatter(commands, ways, luminance);
}

}  // namespace nephroid
