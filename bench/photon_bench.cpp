// Photons through the bunny, beside the bare loop of Embree over the same rays, on one core and on all.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <filesystem>

#include "core/atomic_file.h"
#include "core/stopwatch.h"
#include "formats/load.h"
#include "reference/photons.h"

namespace nephroid {
namespace {

constexpr uint32_t kPhotons = 1 << 19;

class RayRecorder final : public PhotonVisitor {
 public:
  void segment(const PhotonSegment& segment) override { rays.push_back(segment.ray); }
  std::vector<Ray> rays;
};

// The bunny of glmark2 under a lamp, over a floor.
Scene bunnyScene() {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::filesystem::path file = folder / "nephroid-photon-bench.toml";
  writeFileAtomically(file, R"([[material]]
name = "glass"
type = "dielectric"
[[material]]
name = "floor"
type = "diffuse"
[[object]]
name = "bunny"
mesh = "bunny.obj"
material = "glass"
[[object]]
name = "floor"
shape = "plane"
size = [20, 20]
material = "floor"
translation = [0, -1, 0]
[[light]]
type = "point"
position = [-1.5, 3.5, 0.8]
intensity = 120
)");
  Scene scene = loadScene(file);
  std::filesystem::remove(file);
  return scene;
}

// Tracing and the bare loop take turns, so that both meet the same machine.
void tracePhotonsBesideBareLoop(benchmark::State& state) {
  const auto threads = static_cast<std::size_t>(state.range(0));
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  Scene scene;
  try {
    scene = bunnyScene();
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
    return;
  }
  const RayScene rayScene(scene);
  const Boundaries boundaries(scene, rayScene);
  const Lights lights(scene, Aim::casters);
  const PhotonTracer tracer(scene, boundaries, lights, Paths::all);
  const PhotonPass pass = photonPass(scene, Spectrum::continuous, 1, 0, kPhotons);
  FluxLedger ledger;
  std::vector<Ray> rays;
  for (const RayRecorder& group : tracePass(tracer, pass, RayRecorder(), ledger))
    rays.insert(rays.end(), group.rays.begin(), group.rays.end());

  double traceSeconds = 0, bareSeconds = 0;
  for (auto _ : state) {
    const Stopwatch ours;
    benchmark::DoNotOptimize(tracePass(tracer, pass, PhotonVisitor(), ledger));
    const double seconds = ours.seconds();
    state.SetIterationTime(seconds);
    traceSeconds += seconds;
    const Stopwatch bare;
    benchmark::DoNotOptimize(rayScene.replay(rays));
    bareSeconds += bare.seconds();
  }
  const double all = static_cast<double>(rays.size()) * static_cast<double>(state.iterations());
  state.counters["rays_per_photon"] = static_cast<double>(rays.size()) / kPhotons;
  state.counters["rays_per_s"] = all / traceSeconds;
  state.counters["bare_rays_per_s"] = all / bareSeconds;
  state.counters["of_bare_rate"] = bareSeconds / traceSeconds;
}
BENCHMARK(tracePhotonsBesideBareLoop)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(oneapi::tbb::info::default_concurrency())
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(2);

}  // namespace
}  // namespace nephroid
