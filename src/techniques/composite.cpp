#include "techniques/composite.h"

#include <utility>

namespace nephroid {
namespace {

template <class Element>
std::vector<Element> ofAll(const std::vector<CompositePart>& parts,
                           std::vector<Element> (Technique::*get)() const) {
  std::vector<Element> all;
  for (const CompositePart& part : parts)
    for (const Element& element : ((*part.technique).*get)()) all.push_back(element);
  return all;
}

}  // namespace

CompositeTechnique::CompositeTechnique(std::vector<CompositePart> parts) : parts_(std::move(parts)) {}

TechniqueTraits CompositeTechnique::traits() const {
  TechniqueTraits all{
      .followsCamera = false, .usesBeams = false, .coversSquares = true, .drawsCaustics = false};
  for (const CompositePart& part : parts_) {
    const TechniqueTraits own = part.technique->traits();
    all.followsCamera = all.followsCamera || own.followsCamera;
    all.usesBeams = all.usesBeams || own.usesBeams;
    if (!part.shades) continue;
    all.coversSquares = all.coversSquares && own.coversSquares;
    all.drawsCaustics = all.drawsCaustics || own.drawsCaustics;
  }
  return all;
}

void CompositeTechnique::reserve(uvec2 size) {
  for (const CompositePart& part : parts_) part.technique->reserve(size);
}

void CompositeTechnique::update(GpuScene& gpuScene) {
  for (const CompositePart& part : parts_) part.technique->update(gpuScene);
}

void CompositeTechnique::record(gpu::CommandList& commands, GpuScene& gpuScene) {
  for (const CompositePart& part : parts_) part.technique->record(commands, gpuScene);
}

std::vector<Lattice> CompositeTechnique::lattices() const {
  return ofAll(parts_, &Technique::lattices);
}

std::vector<PassOutput> CompositeTechnique::outputs() const {
  return ofAll(parts_, &Technique::outputs);
}

const RayMesh* CompositeTechnique::rayMesh() const {
  for (const CompositePart& part : parts_)
    if (const RayMesh* mesh = part.technique->rayMesh()) return mesh;
  return nullptr;
}

bool CompositeTechnique::finish() {
  bool isDone = true;
  // The lists of a part that does not shade were not filled.
  for (const CompositePart& part : parts_)
    if (part.shades) isDone = part.technique->finish() && isDone;
  return isDone;
}

void CompositeTechnique::shade(gpu::CommandList& commands, const ReceiverPoints& points,
                               const gpu::Image& causticsLux) {
  for (const CompositePart& part : parts_)
    if (part.shades) part.technique->shade(commands, points, causticsLux);
}

void CompositeTechnique::scatter(gpu::CommandList& commands, const WaysOfSight& ways,
                                 const gpu::Image& luminance) {
  for (const CompositePart& part : parts_)
    if (part.scatters) part.technique->scatter(commands, ways, luminance);
}

}  // namespace nephroid
