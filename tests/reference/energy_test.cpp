// No light is made, and none lost unseen; and the same seed makes the same picture.
#include <gtest/gtest.h>

#include <oneapi/tbb/global_control.h>

#include "support/reference_scenes.h"

namespace nephroid {
namespace {

constexpr double kCandela = 100;
constexpr double kEmitted = 4 * double(kPi) * kCandela;  // lm

// A lamp in a room of 4 m that lets nothing out.
Scene room() {
  Scene scene;
  scene.lights = {pointLight({0.3f, 1.2f, -0.2f}, float(kCandela))};
  add(scene, makeBox({4, 4, 4}), diffuse(0.5f));
  return scene;
}

void addTintedBall(Scene& scene) {
  Material tinted = glass();
  tinted.attenuationColor = {0.2f, 0.5f, 0.9f};
  tinted.attenuationDistance = 0.5f;
  add(scene, makeSphere(0.7f), tinted, {-0.4f, 0, 0.2f});
}

void addNested(Scene& scene) {
  add(scene, makeBox({1.5f, 0.8f, 1.2f}), glass(1.33f), {0.2f, -1, 0.3f});
  add(scene, makeSphere(0.35f), glass(1.6f), {0.2f, -1, 0.3f});
  add(scene, makeSphere(0.2f), glass(1), {0.2f, -1, 0.3f});
}

struct Ignored final : PhotonVisitor {};

FluxLedger ledgerOf(const Scene& scene, Paths paths) {
  const RayScene rays(scene);
  const Boundaries boundaries(scene, rays);
  const Lights lights(scene, Aim::everywhere);
  const PhotonTracer tracer(scene, boundaries, lights, paths);
  FluxLedger ledger;
  tracePass(tracer, photonPass(scene, Spectrum::continuous, 1, 0, 1 << 17), Ignored(), ledger);
  return ledger;
}

void expectKept(const Scene& scene, bool absorbs) {
  const FluxLedger flux = ledgerOf(scene, Paths::all);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(flux.emitted[c], kEmitted, 1e-5 * kEmitted);  // in single precision
    EXPECT_NEAR(flux.received[c] + flux.absorbed[c], flux.emitted[c], 1e-3 * kEmitted);
    EXPECT_LT(flux.escaped[c], 1e-3 * kEmitted);
    EXPECT_LT(flux.lost[c], 1e-3 * kEmitted);
    EXPECT_EQ(flux.absorbed[c] > 1e-3 * kEmitted, absorbs) << flux.absorbed[c];
  }
}

TEST(Energy, InAClosedRoomIsReceivedOrAbsorbed) {
  Scene clear = room();
  addNested(clear);
  add(clear, makeTorusKnot(2, 3, 0.5f, 0.15f), glass(), {-1, 0.8f, 0});
  expectKept(clear, false);

  Scene tinted = room();
  addTintedBall(tinted);
  add(tinted, makeTorus(0.5f, 0.2f), mirror(0.7f), {1, 0.5f, 0.5f});
  expectKept(tinted, true);

  Scene misty = room();
  addNested(misty);
  misty.medium = Medium{.extinction = 0.2f};
  expectKept(misty, true);
}

// The first that light from within a ball of glass meets is the water's face inside of it, where nothing
// happens.
TEST(Energy, WhereOneMediumReachesIntoAnotherIsCountedOnce) {
  Scene scene = room();
  const vec3 lamp = scene.lights[0].position;
  add(scene, makeBox({1, 0.8f, 1}), glass(1.33f), lamp - vec3(0, 0.3f, 0));
  add(scene, makeSphere(0.3f), glass(), lamp);
  expectKept(scene, false);
}

TEST(Energy, WithoutReflectionIsLostToItAlone) {
  Scene scene = room();
  addNested(scene);
  const FluxLedger flux = ledgerOf(scene, Paths::transmission);
  EXPECT_NEAR(flux.received.y + flux.lost.y, flux.emitted.y, 1e-3 * kEmitted);
  EXPECT_GT(flux.lost.y, 0.01 * kEmitted);
}

// Flux that lands on walls, which all stand in the air, and the part of it that believes to be in glass.
struct Landed final : PhotonVisitor {
  void landing(const PhotonSegment& segment, const Hit&, vec3 flux) override {
    all += double(flux.y);
    if (!segment.isInAir()) inGlass += double(flux.y);
  }
  double all = 0, inGlass = 0;
};

TEST(Energy, KnowsWhatItIsInsideOf) {
  for (const Mesh& mesh : {makeTorusKnot(2, 3, 0.6f, 0.2f), makeSphere(0.8f), makeTorus(0.6f, 0.3f)}) {
    Scene scene = room();
    add(scene, mesh, glass());
    const RayScene rays(scene);
    const Boundaries boundaries(scene, rays);
    const Lights lights(scene, Aim::casters);
    const PhotonTracer tracer(scene, boundaries, lights, Paths::all);
    FluxLedger ledger;
    Landed sum;
    const PhotonPass pass = photonPass(scene, Spectrum::continuous, 1, 0, 1 << 16);
    for (const Landed& group : tracePass(tracer, pass, Landed(), ledger)) {
      sum.all += group.all;
      sum.inGlass += group.inGlass;
    }
    // As of lines of sight, no more than a thousandth goes astray at edges.
    EXPECT_LT(sum.inGlass, 1e-3 * sum.all);
    EXPECT_GT(sum.all, 0);
  }
}

// Flux that meters on all six walls receive, direct and by way of casters.
SampleMean fluxOnWalls(const Scene& scene) {
  const RayScene rays(scene);
  SampleMean total;
  constexpr uint32_t kSeeds = 24;
  for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
    double lumens = 0;
    for (int wall = 0; wall < 6; ++wall) {
      const float side = wall % 2 ? 1.0f : -1.0f;
      vec3 normal(0), u(0);
      normal[wall / 2] = -side;  // into the room
      u[(wall / 2 + 1) % 3] = 4;
      const vec3 v = cross(u, normal);  // so that it faces cross(v, u)
      Sensor sensor{"wall", -2.0f * normal - 0.5f * (u + v), u, v, uvec2(16)};
      ReferenceSettings settings;
      settings.photons = 1 << 12;
      settings.seed = seed;
      ReferenceSensor meter(scene, rays, sensor, settings);
      meter.pass();
      const Image image = meter.image();
      for (const float lux : *image.find("G")) lumens += double(lux) * 16 / (16 * 16);
    }
    total.add(lumens);
  }
  return total;
}

TEST(Energy, OnTheWallsOfARoomIsThatOfTheLamp) {
  Scene scene = room();
  addNested(scene);
  add(scene, makeTorus(0.5f, 0.2f), mirror(), {1, 0.5f, 0.5f});
  const SampleMean lumens = fluxOnWalls(scene);
  EXPECT_LT(std::abs(lumens.mean() - kEmitted), 4 * lumens.standardError()) << lumens.mean();
  EXPECT_LT(lumens.standardError(), 0.002 * kEmitted);
}

TEST(Reference, OfASeedIsTheSameWhateverTheThreads) {
  Scene scene = room();
  addTintedBall(scene);
  addNested(scene);
  scene.medium = Medium{.extinction = 0.05f, .albedo = 0.9f};
  scene.camera.position = {1.5f, 0.5f, 1.8f};
  ReferenceSettings settings;
  settings.size = {64, 48};
  settings.photons = photonsOf(1 << 14);
  const Sensor sensor = floorSensor({0, -2, 0}, 2, 32);
  const auto bothWith = [&](std::size_t threads, uint64_t seed) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    settings.seed = seed;
    return std::pair(seen(scene, 2, settings), measured(scene, sensor, 2, settings));
  };
  const auto [picture, reading] = bothWith(1, 7);
  const auto [pictureOfMany, readingOfMany] = bothWith(4, 7);
  for (const ImageChannel& channel : picture.channels)
    EXPECT_EQ(channel.values, *pictureOfMany.find(channel.name)) << channel.name;
  for (const ImageChannel& channel : reading.channels)
    EXPECT_EQ(channel.values, *readingOfMany.find(channel.name)) << channel.name;
  const auto [otherPicture, otherReading] = bothWith(4, 8);
  EXPECT_NE(*picture.find("G"), *otherPicture.find("G"));
  EXPECT_NE(*reading.find("G"), *otherReading.find("G"));
}

}  // namespace
}  // namespace nephroid
