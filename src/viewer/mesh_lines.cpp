#include "viewer/mesh_lines.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "core/index_range.h"
#include "techniques/level_color.h"

namespace nephroid {
namespace {

constexpr float kSideOpacity = 0.75f, kWayOpacity = 0.3f, kPathOpacity = 0.35f;
constexpr vec3 kPathColor(0.55f, 0.75f, 0.75f);
// Of the way from the eye to a line: what is no nearer than this before the line does not hide it, so that
// the surface that it lies on does not.
constexpr float kBefore = 3e-3f;

uint32_t mostCuts(const RayMesh& mesh) {
  uint32_t most = 0;
  for (std::size_t i = 0; i < mesh.beams.size(); ++i)
    if (!mesh.beams[i].isPath) most = std::max<uint32_t>(most, mesh.paths[i].cuts);
  return most;
}

uint32_t firstOf(const RayMesh& mesh, uint32_t node) {
  while (mesh.nodes[node].parent != kNone) node = mesh.nodes[node].parent;
  return node;
}

// Between two nodes of the mesh of rays.
struct Side {
  uint64_t ends;
  uint8_t cuts;
};

Side sideBetween(uint32_t a, uint32_t b, uint8_t cuts) {
  return {uint64_t(std::min(a, b)) << 32 | std::max(a, b), cuts};
}

// Each once, with the most cuts that it has.
void keepFinest(std::vector<Side>& sides) {
  std::ranges::sort(sides, [](const Side& a, const Side& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.cuts > b.cuts;
  });
  const auto isSame = [](const Side& a, const Side& b) { return a.ends == b.ends; };
  sides.erase(std::unique(sides.begin(), sides.end(), isSame), sides.end());
}

// From the caster on.
void addWay(const RayMesh& mesh, uint32_t node, vec3 color, std::vector<SceneLine>& lines) {
  for (uint32_t from = mesh.nodes[node].parent; from != kNone; node = from, from = mesh.nodes[node].parent)
    lines.push_back({mesh.nodes[from].position, mesh.nodes[node].position, color, kWayOpacity});
}

}  // namespace

MeshLines meshLines(const RayMesh& mesh, std::size_t mostBeams, std::size_t mostWays) {
  const std::size_t count = mesh.beams.size(), stride = (count + mostBeams - 1) / mostBeams;
  const std::size_t wayStride = (count + mostWays - 1) / mostWays;
  MeshLines lines;
  if (mesh.paths.size() != count) return lines;  // lamps that were followed one after the other
  const uint32_t colors = mostCuts(mesh) + 1;
  std::vector<Side> sides;
  for (std::size_t i = 0; i < count; i += stride) {
    const LandedBeam& beam = mesh.beams[i];
    const BeamPaths& paths = mesh.paths[i];
    for (int from = 0; from < 3; ++from) {
      const int to = (from + 1) % 3;
      if (beam.isPath) {
        lines.sides.push_back({beam.corner[from], beam.corner[to], kPathColor, kPathOpacity});
        continue;
      }
      const uint32_t a = paths.node[from], b = paths.node[to];
      sides.push_back(sideBetween(a, b, paths.cuts));
      sides.push_back(sideBetween(firstOf(mesh, a), firstOf(mesh, b), paths.cuts));
    }
  }
  keepFinest(sides);
  for (const Side& side : sides) {
    const PathNode &a = mesh.nodes[side.ends >> 32], &b = mesh.nodes[side.ends & 0xffffffffu];
    // On the caster's triangles, which stand where rays meet it, and not on its curved surface.
    const bool isFirst = a.parent == kNone;
    lines.sides.push_back({isFirst ? a.flatPosition : a.position, isFirst ? b.flatPosition : b.position,
                           levelColor(side.cuts, colors), kSideOpacity});
  }
  for (std::size_t i = 0; i < count; i += wayStride)
    addWay(mesh, mesh.paths[i].node[0],
           mesh.beams[i].isPath ? kPathColor : levelColor(mesh.paths[i].cuts, colors), lines.ways);
  return lines;
}

Legend meshLegend(const RayMesh& mesh) {
  std::vector<uint64_t> beams(mostCuts(mesh) + 1, 0);
  uint64_t alone = 0;
  for (std::size_t i = 0; i < mesh.beams.size(); ++i)
    ++(mesh.beams[i].isPath ? alone : beams[mesh.paths[i].cuts]);
  Legend legend{"Mesh of rays", "beams", {}};
  for (uint32_t cuts = 0; cuts < beams.size(); ++cuts)
    if (beams[cuts] > 0)
      legend.entries.push_back({levelColor(cuts, uint32_t(beams.size())),
                                "cut " + std::to_string(cuts) + (cuts == 1 ? " time" : " times"),
                                beams[cuts]});
  if (alone > 0) legend.entries.push_back({kPathColor, "single paths", alone});
  return legend;
}

void removeHidden(const RayScene& rays, vec3 eye, std::vector<SceneLine>& lines) {
  std::vector<uint8_t> isHidden(lines.size());
  oneapi::tbb::parallel_for(IndexRange(0, lines.size(), 256), [&](const IndexRange& range) {
    std::vector<Ray> toMiddles;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const vec3 way = 0.5f * (lines[i].from + lines[i].to) - eye;
      const float far = length(way);
      toMiddles.push_back({eye, way / far, 0, (1 - kBefore) * far});
    }
    rays.occluded(toMiddles, std::span(isHidden).subspan(range.begin(), range.size()));
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!isHidden[i]) lines[kept++] = lines[i];
  lines.resize(kept);
}

}  // namespace nephroid
