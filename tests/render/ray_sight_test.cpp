// The view through casters by rays: what is interpolated against every pixel traced, and trees of rays
// against the reference, which follows one way at a time, by chance.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "formats/load.h"
#include "geometry/bounds.h"
#include "geometry/mesh_checks.h"
#include "render/shadow_maps.h"
#include "render/sight/rays/seen_by_rays.h"
#include "render/tone_mapping.h"
#include "support/reference_scenes.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr vec3 kSky(0.3f, 0.5f, 0.8f);

// Every triangle a facet of its own, as of a cut gem or a ball of mirrors.
Mesh faceted(const Mesh& smooth) {
  Mesh mesh;
  mesh.name = "facets";
  for (const uvec3& t : smooth.triangles) {
    const vec3 a = smooth.positions[t.x], b = smooth.positions[t.y], c = smooth.positions[t.z];
    const uint32_t first = uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.normals.insert(mesh.normals.end(), 3, normalize(cross(b - a, c - a)));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  finishMesh(mesh, "facets");
  return mesh;
}

// Things on a floor, under an even sky.
Scene onFloor() {
  Scene scene;
  scene.environment.ambient = vec3(kPi);
  scene.environment.background = kSky;
  scene.camera = {.position = {0, 1.2f, 3}, .target = {0, 0.5f, 0}, .verticalFov = 30};
  add(scene, makePlane({8, 8}), diffuse(0.7f));
  add(scene, makeBox({3, 1, 0.2f}), diffuse(0.2f), {0.4f, 0.5f, -1.2f});
  return scene;
}

Scene ball() {
  Scene scene = onFloor();
  add(scene, makeSphere(0.5f, {.vertices = 1600}), glass(), {0, 0.6f, 0});
  return scene;
}

// Tinted, in glass with an air gap to the floor.
Scene wineGlass() {
  Scene scene = onFloor();
  add(scene, makeCylinder(0.4f, 1), glass(), {0, 0.55f, 0});
  Material wine = glass(1.34f);
  wine.attenuationColor = {0.7f, 0.1f, 0.2f};
  wine.attenuationDistance = 0.3f;
  add(scene, makeCylinder(0.34f, 0.7f), wine, {0, 0.5f, 0});
  return scene;
}

// Two blocks whose faces lie in the same place.
Scene joined() {
  Scene scene = onFloor();
  add(scene, makeBox(vec3(0.6f)), glass(1.33f), {-0.3f, 0.4f, 0});
  add(scene, makeBox(vec3(0.6f)), glass(1.6f), {0.3f, 0.4f, 0});
  return scene;
}

Scene gem() {
  Scene scene = onFloor();
  Material diamond = glass();
  diamond.ior = {2.40f, 2.42f, 2.45f};
  add(scene, faceted(makeSphere(0.4f, {.vertices = 42})), diamond, {0, 0.6f, 0});
  return scene;
}

Scene discoBall() {
  Scene scene = onFloor();
  add(scene, faceted(makeSphere(0.5f, {.vertices = 162})), mirror(0.9f), {0, 0.6f, 0});
  return scene;
}

Scene pane() {
  Scene scene = onFloor();
  Material sheet = glass();
  sheet.thinWalled = true;
  sheet.color = {0.6f, 0.9f, 0.7f};
  add(scene, makeBox({1, 1, 0.05f}), sheet, {0, 0.6f, 0.6f});
  add(scene, makeSphere(0.3f, {.vertices = 640}), mirror(0.8f), {0, 0.4f, -0.3f});
  return scene;
}

// Behind a pane a wall whose texture begins anew in the middle. Where it does so it is dark on both sides.
// Cells that mix coordinates across the seam are off in 0.4 % of the pixels.
Scene seam() {
  Scene scene = onFloor();
  Texture& texture = scene.textures.emplace_back();
  texture.width = 64;
  texture.height = 1;
  for (uint32_t x = 0; x < 64; ++x) texture.texels.emplace_back(vec3(x < 24 || x >= 40 ? 0.1f : 0.9f), 1.0f);
  Mesh wall;
  wall.name = "wall";
  for (const float left : {-1.0f, 0.0f}) {
    const uint32_t first = uint32_t(wall.positions.size());
    for (const vec2 at : {vec2(0), vec2(1, 0), vec2(1), vec2(0, 1)}) {
      wall.positions.emplace_back(left + at.x, 1.2f * at.y, -0.5f);
      wall.normals.emplace_back(0, 0, 1);
      wall.texcoords.push_back(at);
    }
    wall.triangles.insert(wall.triangles.end(),
                          {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  }
  finishMesh(wall, "wall");
  Material painted = diffuse(1);
  painted.colorTexture = 0;
  // At a slant, so that it goes through cells.
  add(scene, wall, painted).placement.rotation = glm::angleAxis(0.1f, vec3(0, 0, 1));
  Material sheet = glass();
  sheet.thinWalled = true;
  add(scene, makePlane({1, 1}, {.segments = 1}), sheet, {0, 0.6f, 0.6f}).placement.rotation =
      glm::angleAxis(kPi / 2, vec3(1, 0, 0));
  return scene;
}

Scene inGlass() {
  Scene scene = ball();
  scene.camera = {.position = {0, 0.65f, 0.2f}, .target = {0.1f, 0.3f, -1}, .verticalFov = 60};
  return scene;
}

Scene underWater() {
  Scene scene = onFloor();
  Water water;
  water.size = {4, 4};
  water.grid = {80, 80};
  water.waves = {{.amplitude = 0.02f, .wavelength = 0.7f, .direction = {1, 0.4f}}};
  Material sea = glass(1.33f);
  sea.attenuationColor = {0.5f, 0.8f, 0.9f};
  sea.attenuationDistance = 1.5f;
  add(scene, makeWater(water, 0), sea, {0, 1, 0}).water = water;
  scene.camera = {.position = {0, 0.5f, 1.5f}, .target = {0, 0.8f, 0}, .verticalFov = 60};
  return scene;
}

// A scene and all that its view depends on.
struct Looked {
  explicit Looked(const Scene& sceneOf, uvec2 sizeOf)
      : scene(sceneOf),
        size(sizeOf),
        rays(scene),
        materials(materialsOf(scene)),
        view(viewOf(scene.camera, size)) {
    for (const Object& object : scene.objects) {
      if (!scene.isCaster(object)) continue;
      const Box box = extentOf(scene.meshOf(object)).box;
      const gpu::Region region = regionOf(view, size, placedCorners(box, object.placement));
      if (region.size.x > 0) regions.push_back(region);
    }
  }

  SeenByRays seen(float leastWeight, bool interpolates) const {
    SeenByRays seen;
    const RaySightInput input{
        scene, rays,    materials,     view,        mediaAround(rays, materials, view.eye),
        size,  regions, {leastWeight}, interpolates};
    seeByRays(input, seen);
    return seen;
  }

  Scene scene;
  uvec2 size;
  RayScene rays;
  std::vector<const Material*> materials;
  View view;
  std::vector<gpu::Region> regions;
};

// What each pixel of the region shows where points are lit by a pattern that is finer than most caustics.
std::vector<vec3> lit(const SeenByRays& seen) {
  std::vector<vec3> pixels;
  for (std::size_t i = 0; i < seen.rest.size(); ++i) {
    vec3 sum(seen.rest[i]);
    for (uint32_t p = seen.ranges[i].x; p < seen.ranges[i].x + seen.ranges[i].y; ++p) {
      const vec3 at(seen.positions[p]);
      const float lux =
          std::abs(seen.normals[p].y) + std::exp(-dot(at, at)) * std::sin(20 * at.x) * std::sin(20 * at.z);
      sum += vec3(seen.factors[p]) * lux;
    }
    pixels.push_back(sum);
  }
  return pixels;
}

// The part of the pixels that show casters whose light is off by more than 2 % and by more than a gray level.
double offPart(const SeenByRays& seen, const SeenByRays& exact, const ToneMapping& toneMapping) {
  const std::vector<vec3> pixels = lit(seen), exactPixels = lit(exact);
  double all = 0, off = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (exact.rest[i].a == 0) continue;
    ++all;
    const vec3 levels =
        255.0f * glm::abs(displayed(pixels[i], toneMapping) - displayed(exactPixels[i], toneMapping));
    const vec3 error = glm::abs(pixels[i] - exactPixels[i]);
    for (int c = 0; c < 3; ++c)
      if (error[c] > 0.02f * exactPixels[i][c] && levels[c] > 1) {
        ++off;
        break;
      }
  }
  return off / all;
}

struct Case {
  const char* name;
  Scene (*make)();
  double mostOff = 0.005;  // as a part of the pixels that show casters
};
constexpr Case kCases[] = {{"ball", ball},        {"wine glass", wineGlass}, {"joined blocks", joined},
                           {"gem", gem},          {"disco ball", discoBall}, {"pane", pane},
                           {"seam", seam, 0.001}, {"in glass", inGlass},     {"under water", underWater}};

TEST(RaySight, ShowsWhatEveryPixelTracedShows) {
  for (const Case& one : kCases) {
    const Looked looked(one.make(), {320, 240});
    const SeenByRays seen = looked.seen(TreeSettings{}.leastWeight, true), exact = looked.seen(1e-5f, false);
    const double off = offPart(seen, exact, {1, kToneNeutral});
    RecordProperty(std::string("off_percent_") + one.name, std::to_string(100 * off));
    EXPECT_LT(off, one.mostOff) << one.name;
    EXPECT_LE(seen.counts.traced, exact.counts.traced) << one.name;
    EXPECT_LT(seen.counts.leftOut, 0.004) << one.name;
  }
}

TEST(RaySight, ShowsWhatEveryPixelTracedShowsInScenesOfTheRepository) {
  for (const char* name : {"glass-ball", "glass-teapot", "glass-bunny", "paper5-pool", "mirror-ring"}) {
    const auto file = std::filesystem::path(NEPHROID_SOURCE_DIR) / "scenes" / (std::string(name) + ".toml");
    const Looked looked(loadScene(file), {320, 240});
    const double off = offPart(looked.seen(TreeSettings{}.leastWeight, true), looked.seen(1e-4f, false),
                               {*looked.scene.camera.exposure, kToneNeutral});
    RecordProperty(std::string("off_percent_") + name, std::to_string(100 * off));
    EXPECT_LT(off, 0.005) << name;
  }
}

// Ambient light and sky alone, so that every pixel is the sum over its ways.
TEST(RaySight, IsWhatTheReferenceSees) {
  constexpr uint32_t kPixels = 32, kFiner = 6, kBlock = 8, kPasses = 32;
  for (const Case& one : kCases) {
    Scene scene = one.make();
    scene.camera.verticalFov = 14;  // no farther than the thing that is looked at
    const Looked looked(scene, uvec2(kPixels * kFiner));
    const SeenByRays seen = looked.seen(1e-4f, false);
    ReferenceSettings settings;
    settings.size = uvec2(kPixels);
    settings.photons = 1;
    settings.spectrum = Spectrum::channels;
    ReferenceImage image(scene, looked.rays, settings);
    const auto blocks = blockMeans(image, {"R", "G", "B"}, kPasses, kBlock);
    // Blocks that show casters everywhere.
    constexpr uint32_t kSide = kBlock * kFiner;
    int compared = 0;
    for (uint32_t block = 0; block < blocks[0].size(); ++block) {
      const ivec2 corner(kSide * uvec2(block % (kPixels / kBlock), block / (kPixels / kBlock)));
      const ivec2 first = corner - seen.region.corner;
      if (first.x < 0 || first.y < 0 || first.x + int(kSide) > int(seen.region.size.x) ||
          first.y + int(kSide) > int(seen.region.size.y))
        continue;
      glm::dvec3 sum(0);
      bool isCaster = true;
      for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
          const vec4& rest = seen.rest[(uint32_t(first.y) + y) * seen.region.size.x + uint32_t(first.x) + x];
          sum += glm::dvec3(vec3(rest));
          isCaster = isCaster && rest.a > 0;
        }
      if (!isCaster) continue;
      ++compared;
      for (int c = 0; c < 3; ++c) {
        const SampleMean& expected = blocks[std::size_t(c)][block];
        const double mean = sum[c] / (kSide * kSide);
        // Edges fall between the rays of a block: a part of their number.
        EXPECT_NEAR(mean, expected.mean(), 4.5 * expected.standardError() + 0.01 * expected.mean())
            << one.name << " block " << block << " channel " << c;
      }
    }
    EXPECT_GT(compared, 0) << one.name;
  }
}

TEST(RaySight, IsTheSameForAnyNumberOfThreads) {
  for (Scene (*make)() : {gem, ball}) {
    const Looked looked(make(), {160, 120});
    const SeenByRays all = looked.seen(TreeSettings{}.leastWeight, true);
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    const SeenByRays again = looked.seen(TreeSettings{}.leastWeight, true);
    EXPECT_EQ(all.positions, again.positions);
    EXPECT_EQ(all.normals, again.normals);
    EXPECT_EQ(all.factors, again.factors);
    EXPECT_EQ(all.ranges, again.ranges);
    EXPECT_EQ(all.rest, again.rest);
  }
}

// A smooth ball behind which there is little leaves most pixels to their neighbors.
TEST(RaySight, TracesAPartOfThePixels) {
  const Looked looked(ball(), {640, 480});
  const SeenByRays seen = looked.seen(TreeSettings{}.leastWeight, true);
  EXPECT_LT(2 * seen.counts.traced, looked.seen(TreeSettings{}.leastWeight, false).counts.traced);
}

}  // namespace
}  // namespace nephroid
