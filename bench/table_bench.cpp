// The light transport table of the papers' ball (Iwasaki 2005, table 1, figure 8 a), beside what the paper
// states: 6,400 vertices, 129 directions, 10.6 MB, 1.2 hours of preprocessing.
#include <benchmark/benchmark.h>

#include "core/stopwatch.h"
#include "support/table_meshes.h"
#include "trace/ray_scene.h"
#include "transport/table/table.h"

namespace nephroid {
namespace {

constexpr float kIor = 1.5f;
constexpr double kPaperSeconds = 1.2 * 3600;
constexpr double kPaperMegabytes = 10.6;

Mesh papersBall() {
  return ballMesh(56, 0.5f);
}  // 6,441 vertices

// The rays a table of `mesh` takes: for each vertex and direction one back to the light, then from boundary
// to boundary.
std::vector<Ray> raysOfTable(const Mesh& mesh, const RayScene& scene) {
  std::vector<Ray> rays;
  const float margin = 10 * scene.rounding(0);
  const TableKey key = tableKey(mesh, vec3(kIor));
  for (uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    for (uint32_t i = 0; i < key.directions(); ++i) {
      vec3 direction = vertexFrame(mesh.normals[vertex]) * sampledDirection(i, key.rings, key.azimuths);
      vec3 position = mesh.positions[vertex];
      vec3 normal = mesh.normals[vertex];
      rays.push_back({position, -direction, margin});
      bool isEntering = true;
      Hit hit;
      while (refractDirection(direction, isEntering ? normal : -normal, isEntering ? 1 / kIor : kIor,
                              direction)) {
        rays.push_back({position, direction, margin});
        if (!scene.intersect(rays.back(), hit)) break;
        position = hit.position;
        normal = hit.normal;
        isEntering = dot(direction, hit.geometricNormal) < 0;
      }
    }
  }
  return rays;
}

// Building and the bare Embree loop over the same rays take turns, so that both meet the same machine.
void buildBesideBareLoop(benchmark::State& state) {
  const Mesh mesh = papersBall();
  const RayScene scene(mesh);
  const std::vector<Ray> rays = raysOfTable(mesh, scene);
  Progress progress;
  double buildSeconds = 0;
  double bareSeconds = 0;
  uint64_t traced = 0;
  std::size_t bytes = 0;
  for (auto _ : state) {
    const uint64_t before = raysTraced();
    const Stopwatch ours;
    bytes = buildTable(mesh, vec3(kIor), {}, progress).sizeInBytes();
    const double seconds = ours.seconds();
    state.SetIterationTime(seconds);
    buildSeconds += seconds;
    traced += raysTraced() - before;
    const Stopwatch bare;
    benchmark::DoNotOptimize(scene.replay(rays));
    bareSeconds += bare.seconds();
  }
  const auto runs = static_cast<double>(state.iterations());
  const double buildRate = static_cast<double>(traced) / buildSeconds;
  const double bareRate = static_cast<double>(rays.size()) * runs / bareSeconds;
  state.counters["build_s"] = buildSeconds / runs;
  state.counters["paper_build_s"] = kPaperSeconds;
  state.counters["MB"] = static_cast<double>(bytes) / 1e6;
  state.counters["paper_MB"] = kPaperMegabytes;
  state.counters["rays"] = static_cast<double>(traced) / runs;
  state.counters["rays_per_s"] = buildRate;
  state.counters["bare_rays_per_s"] = bareRate;
  state.counters["of_bare_rate"] = buildRate / bareRate;
}
BENCHMARK(buildBesideBareLoop)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(3);

void lookUpAllVertices(benchmark::State& state) {
  const Mesh mesh = papersBall();
  Progress progress;
  const TransportTable table = buildTable(mesh, vec3(kIor), {}, progress);
  Emitter emitter{};
  emitter.type = kEmitterPoint;
  std::vector<OutgoingRay> rays(mesh.positions.size());
  for (auto _ : state) {
    emitter.position = vec3(1, 2, 0.01f * static_cast<float>(state.iterations() % 100));
    tableRays(table, mesh, Placement{}, Material{}, emitter, 0, rays);
    benchmark::DoNotOptimize(rays.data());
  }
}
BENCHMARK(lookUpAllVertices)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace nephroid
