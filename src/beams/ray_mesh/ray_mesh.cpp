#include "beams/ray_mesh/ray_mesh.h"

#include <algorithm>
#include <cmath>

#include "beams/ray_mesh/refinement.h"

namespace nephroid {
namespace {

// Beams that are widened by the size of their lamp, each of which becomes up to kLampPlaces.
constexpr uint64_t kMostWidened = 500'000;

// Adds what was told of some lamps to what was told of others.
void addStats(const RayMeshStats& some, RayMeshStats& all) {
  all.rays += some.rays;
  all.shadowRays += some.shadowRays;
  all.bytes = std::max(all.bytes, some.bytes);
  // Errors of lamps have nothing to do with each other.
  const double error = std::hypot(all.error * all.landedFlux, some.error * some.landedFlux);
  all.incidentFlux += some.incidentFlux;
  all.landedFlux += some.landedFlux;
  all.error = all.landedFlux > 0 ? error / all.landedFlux : 0;
  all.droppedFlux += some.droppedFlux;
  all.lostFlux += some.lostFlux;
  all.shadedFlux += some.shadedFlux;
  all.missedFlux += some.missedFlux;
  all.singlePaths += some.singlePaths;
  all.bound = std::max(all.bound, some.bound);
  for (std::size_t i = 0; i < kToldLevels; ++i) {
    all.beamsByLevel[i] += some.beamsByLevel[i];
    all.beamsByBranch[i] += some.beamsByBranch[i];
  }
}

}  // namespace

void traceRayMesh(const Scene& scene, const RayScene& rays, const RayMeshSettings& settings,
                  Progress& progress, RayMesh& mesh) {
  progress.begin("beams", 0);
  if (!mesh.memory) mesh.memory = std::make_shared<SheetMemory>();
  SheetMemory& memory = *mesh.memory;
  std::vector<PathNode> nodes = std::move(mesh.nodes);
  mesh.beams.clear();
  mesh.paths.clear();
  mesh.stats = {};
  MediaTable media(rays);
  const auto [lights, fewSkyParts] = lightOntoCasters(scene, rays, settings.error, memory.skies, media);
  mesh.stats.fewSkyParts = fewSkyParts;
  auto groups = lightGroups(scene, lights, settings.mostBytes);
  for (std::size_t at = 0; at < groups.size(); ++at) {
    const std::span<const CasterLight> group = groups[at];
    RayMeshSettings own = settings;
    own.mostBeams = std::max<uint64_t>(settings.mostBeams * group.size() / lights.size(), 1);
    if (std::ranges::any_of(group, [](const CasterLight& light) { return light.spread.hasSize(); }))
      own.mostBeams = std::min(own.mostBeams, kMostWidened);
    LightSheets sheets(scene, rays, own, group, media, memory);
    sheets.tree.nodes = std::move(nodes);
    sheets.tree.nodes.clear();
    std::vector<Sheet>& landed = memory.landed;
    landed.clear();
    memory.sheets.clear();
    sheets.addFirstSheets(memory.sheets);
    sheets.follow(memory.sheets, landed, progress);
    if (sheets.bytes() > settings.mostBytes) {
      if (group.size() == 1) throw TooManyPaths(sheets.bytes());
      // Half of the lamps at a time.
      groups[at] = group.first(group.size() / 2);
      groups.insert(groups.begin() + std::ptrdiff_t(at) + 1, group.subspan(group.size() / 2));
      memory.sheets.clear();
      landed.clear();
      memory.giveBackLarge();
      nodes = {};
      --at;
      continue;
    }
    Refinement refinement(sheets, own, memory);
    refinement.run(landed, progress);
    sheets.conform(landed);
    refinement.describeAnew(landed);
    refinement.emit(landed, mesh);
    sheets.stats.rays = sheets.tree.raysTraced;
    sheets.stats.bytes = sheets.bytes();
    addStats(sheets.stats, mesh.stats);
    nodes = std::move(sheets.tree.nodes);
    landed.clear();
    memory.giveBackLarge();
  }
  if (groups.size() > 1) {
    nodes.clear();
    mesh.paths.clear();
  }
  mesh.nodes = std::move(nodes);
}

}  // namespace nephroid
