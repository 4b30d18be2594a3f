// A technique is a folder and a line in the list: what is built with one more has it everywhere. And
// techniques made of others pass everything on.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "beams/ray_mesh/ray_mesh.h"
#include "core/image_io.h"
#include "geometry/shapes.h"
#include "render/settings.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "support/run_program.h"
#include "techniques/composite.h"
#include "techniques/even_light/settings.h"

namespace nephroid {
namespace {

constexpr const char* kName = "even-light";

// A floor under a lamp, and a sensor on it.
Scene floorAndLamp() {
  Scene scene;
  scene.meshes = {makePlane({2, 2})};
  scene.materials.resize(1);
  scene.objects.resize(1);
  scene.lights.resize(1);
  scene.lights[0].position = {0, 2, 0};
  Sensor sensor;
  sensor.name = "floor";
  sensor.corner = {-1, 0, -1};
  sensor.u = {2, 0, 0};
  sensor.v = {0, 0, 2};
  sensor.resolution = {8, 8};
  scene.sensors = {sensor};
  return scene;
}

class PlugInGpuTest : public GpuTest {};

TEST_F(PlugInGpuTest, IsMeasuredWithItsSetting) {
  TechniqueSettings settings = settingsOf(kName);
  settings.own.of<EvenLightSettings>().lux = 7;
  const Scene scene = floorAndLamp();
  for (const vec3& lux : measuredBy(device(), scene, scene.sensors[0], settings)) EXPECT_EQ(lux, vec3(7));
}

TEST_F(PlugInGpuTest, IsListedWithItsSettings) {
  EXPECT_EQ(techniques().back()->name, std::string(kName));
  PictureSettings settings;
  settings.technique.technique = kName;
  const auto isThere = [](const std::vector<SettingsView>& views) {
    return std::ranges::any_of(views,
                               [](const SettingsView& view) { return view.owner == std::string(kName); });
  };
  EXPECT_TRUE(isThere(usedSettings(settings)));
  settings.technique.technique = defaultTechnique();
  EXPECT_FALSE(isThere(usedSettings(settings)));
  EXPECT_TRUE(isThere(allSettings(settings)));
}

TEST_F(PlugInGpuTest, IsKnownToTheProgram) {
  for (const std::vector<std::string>& asked : {std::vector<std::string>{"render", "--help"},
                                                {"measure", "--help"},
                                                {"help", kName},
                                                {"help"},
                                                {"info"}}) {
    const ProgramResult told = runProgram(asked);
    EXPECT_EQ(told.status, 0);
    EXPECT_NE(told.output.find(kName), std::string::npos) << asked[0];
    const bool tellsSettings = asked.size() > 1;
    EXPECT_EQ(told.output.find("--even-lux") != std::string::npos, tellsSettings) << asked[0];
  }
}

TEST_F(PlugInGpuTest, IsDrawnByTheProgramAndSaidByTheImage) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml")
      << "[[object]]\nshape = \"plane\"\nsize = [2, 2]\nmaterial = \"floor\"\n"
         "[[material]]\nname = \"floor\"\ntype = \"diffuse\"\n"
         "[[sensor]]\nname = \"s\"\ncorner = [-1, 0, -1]\nu = [2, 0, 0]\nv = [0, 0, 2]\n"
         "resolution = [4, 4]\n";
  const std::string output = (folder / "s.exr").string();
  const ProgramResult done = runProgram({"measure", (folder / "scene.toml").string(), "--sensor", "s", "-o",
                                         output, "--technique", kName, "--even-lux", "3"});
  ASSERT_EQ(done.status, 0) << done.errors;
  EXPECT_EQ(readExr(output).find("caustics.G")->front(), 3);
  const std::vector<ImageAttribute> attributes = readExrAttributes(output);
  const auto said = std::ranges::find(attributes, std::string("even-lux"), &ImageAttribute::name);
  ASSERT_NE(said, attributes.end());
  EXPECT_EQ(std::get<std::string>(said->value), "3");
  EXPECT_EQ(runProgram({"measure", (folder / "scene.toml").string(), "--sensor", "s", "-o", output,
                        "--technique", kName, "--even-lux", "-1"})
                .status,
            2);
}

// Says what it is asked.
class Asked final : public Technique {
 public:
  Asked(std::vector<std::string>& calls, const TechniqueTraits& traits, bool isDone,
        const RayMesh* mesh = nullptr)
      : calls_(calls), traits_(traits), isDone_(isDone), mesh_(mesh) {}
  TechniqueTraits traits() const override { return traits_; }
  void reserve(uvec2 size) override { note("reserve " + std::to_string(size.x)); }
  void update(GpuScene&) override { note("update"); }
  void record(gpu::CommandList&, GpuScene&) override { note("record"); }
  std::vector<Lattice> lattices() const override { return std::vector<Lattice>(2); }
  std::vector<PassOutput> outputs() const override { return std::vector<PassOutput>(3); }
  const RayMesh* rayMesh() const override { return mesh_; }
  bool finish() override {
    note("finish");
    return isDone_;
  }
  void shade(gpu::CommandList&, const ReceiverPoints&, const gpu::Image&) override { note("shade"); }
  void scatter(gpu::CommandList&, const WaysOfSight&, const gpu::Image&) override { note("scatter"); }

 private:
  void note(const std::string& call) const { calls_.push_back(call); }
  std::vector<std::string>& calls_;
  TechniqueTraits traits_;
  bool isDone_;
  const RayMesh* mesh_;
};

TEST_F(PlugInGpuTest, CompositesPassEverythingOn) {
  std::vector<std::string> calls;
  std::vector<CompositePart> parts;
  parts.push_back(
      {std::make_unique<Asked>(calls, TechniqueTraits{.followsCamera = true, .coversSquares = true}, false)});
  const RayMesh mesh;
  parts.push_back({std::make_unique<Asked>(calls, TechniqueTraits{.usesBeams = true}, true, &mesh)});
  CompositeTechnique both(std::move(parts));
  const Scene scene = floorAndLamp();
  GpuScene gpuScene(device(), scene);
  const gpu::Image image = gpu::createImage(device(), "image", {});
  both.reserve({5, 6});
  both.update(gpuScene);
  device().submitAndWait([&](gpu::CommandList& commands) {
    both.record(commands, gpuScene);
    both.shade(commands, {&image, &image}, image);
    both.scatter(commands, {&image, &image}, image);
  });
  EXPECT_FALSE(both.finish());
  std::vector<std::string> expected;
  for (const char* call : {"reserve 5", "update", "record", "shade", "scatter", "finish"})
    expected.insert(expected.end(), 2, call);
  EXPECT_EQ(calls, expected);
  EXPECT_EQ(both.lattices().size(), 4u);
  EXPECT_EQ(both.outputs().size(), 6u);
  EXPECT_EQ(both.rayMesh(), &mesh);
  EXPECT_TRUE(both.traits().followsCamera);
  EXPECT_TRUE(both.traits().usesBeams);
  EXPECT_FALSE(both.traits().coversSquares);
  EXPECT_TRUE(both.traits().drawsCaustics);
}

}  // namespace
}  // namespace nephroid
