#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/image_io.h"
#include "gpu/device.h"
#include "support/run_program.h"

namespace nephroid {
namespace {

constexpr const char* kScene = R"(
[camera]
position = [0, 1, 3]
target = [0, 0, 0]
[environment]
ambient = [1, 1, 1]
[[material]]
name = "white"
type = "diffuse"
[[object]]
name = "ground"
material = "white"
shape = "plane"
size = [4, 4]
)";

class RenderCommand : public ProgramTest {
 protected:
  void SetUp() override {
    try {
      gpu::listDevices();
    } catch (const RuntimeFailure& none) {
      GTEST_SKIP() << "there is no Vulkan driver: " << none.what();
    }
    write("scene.toml", kScene);
  }
  ProgramResult render(std::vector<std::string> changed, const std::string& environment = "") const {
    std::vector<std::string> arguments{"render", at("scene.toml"), "--technique", "none", "--size", "32x24"};
    arguments.insert(arguments.end(), changed.begin(), changed.end());
    return runProgram(arguments, environment);
  }
};

TEST_F(RenderCommand, WritesAPictureAndItsLayers) {
  ASSERT_EQ(render({"-o", at("a.png"), "--repeat", "3", "--stats", at("stats.json")}).status, 0);
  EXPECT_EQ(readPng(folder / "a.png").width, 32u);
  ASSERT_EQ(render({"-o", at("a.exr")}).status, 0);
  const Image layers = readExr(folder / "a.exr");
  for (const char* name :
       {"R", "G", "B", "direct.R", "caustics.B", "depth.Z", "normal.X", "normal.Y", "normal.Z"})
    EXPECT_NE(layers.find(name), nullptr) << name;
  const auto stats = nlohmann::json::parse(readAll(folder / "stats.json"));
  EXPECT_GT(stats["passes"].size(), 0u);
  EXPECT_GT(stats["memory_bytes"], 0);
}

TEST_F(RenderCommand, TheSameCommandWritesTheSameBytes) {
  for (const char* name : {"a.png", "b.png", "a.exr", "b.exr"}) ASSERT_EQ(render({"-o", at(name)}).status, 0);
  EXPECT_EQ(readAll(folder / "a.png"), readAll(folder / "b.png"));
  EXPECT_EQ(readAll(folder / "a.exr"), readAll(folder / "b.exr"));
}

TEST_F(RenderCommand, DrawsSixteenSamplesOrOneOfARepeatedFrame) {
  const auto samplesIn = [&] {
    return nlohmann::json::parse(readAll(folder / "stats.json"))["settings"]["samples"];
  };
  ASSERT_EQ(render({"-o", at("a.png"), "--stats", at("stats.json")}).status, 0);
  EXPECT_EQ(samplesIn(), "16");
  ASSERT_EQ(render({"-o", at("b.png"), "--samples", "16"}).status, 0);
  EXPECT_EQ(readAll(folder / "a.png"), readAll(folder / "b.png"));
  ASSERT_EQ(render({"-o", at("c.png"), "--repeat", "2", "--stats", at("stats.json")}).status, 0);
  EXPECT_EQ(samplesIn(), "1");
  ASSERT_EQ(render({"-o", at("d.png"), "--samples", "1"}).status, 0);
  EXPECT_EQ(readAll(folder / "c.png"), readAll(folder / "d.png"));
  EXPECT_NE(readAll(folder / "a.png"), readAll(folder / "c.png"));
  ASSERT_EQ(render({"-o", at("c.png"), "--repeat", "2", "--samples", "16"}).status, 0);
  EXPECT_EQ(readAll(folder / "c.png"), readAll(folder / "a.png"));
  ASSERT_EQ(render({"-o", at("a.png"), "--frames", "0:1", "--stats", at("stats.json")}).status, 0);
  EXPECT_EQ(samplesIn(), "16");
}

// A lamp that grows a hundredfold: the film has the exposure of its first frame, a picture its own.
TEST_F(RenderCommand, AFilmKeepsTheExposureOfItsFirstFrame) {
  write("scene.toml", std::string(kScene) +
                          "[[light]]\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = 10\n"
                          "dimmer = [[0, 0.01], [1, 1]]\n");
  const auto exposureOf = [&](const char* name) {
    for (const ImageAttribute& each : readExrAttributes(folder / name))
      if (each.name == "exposure") return std::get<float>(each.value);
    return 0.0f;
  };
  ASSERT_EQ(render({"-o", at("film.exr"), "--frames", "0:1", "--fps", "1"}).status, 0);
  ASSERT_EQ(render({"-o", at("last.exr"), "--time", "1"}).status, 0);
  EXPECT_GT(exposureOf("film.0000.exr"), 0);
  EXPECT_EQ(exposureOf("film.0001.exr"), exposureOf("film.0000.exr"));
  EXPECT_LT(exposureOf("last.exr"), 0.7f * exposureOf("film.0000.exr"));
  ASSERT_EQ(render({"-o", at("given.exr"), "--exposure", "0.25"}).status, 0);
  EXPECT_EQ(exposureOf("given.exr"), 0.25f);
}

TEST_F(RenderCommand, NumbersItsFrames) {
  ASSERT_EQ(render({"-o", at("a.png"), "--frames", "3:4"}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "a.0003.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "a.0004.png"));
  EXPECT_EQ(folder.fileCount(), 3u);
}

TEST_F(RenderCommand, WrongInputLeavesNothingBehind) {
  const std::vector<std::vector<std::string>> wrong = {
      {"-o", at("a.jpg")},
      {"-o", at("a.png"), "--size", "0x4"},
      {"-o", at("a.png"), "--size", "99999x99999"},
      {"-o", at("a.png"), "--size", "32"},
      {"-o", at("a.png"), "--frames", "4:3"},
      {"-o", at("a.png"), "--frames", "0:4294967295"},
      {"-o", at("a.png"), "--planes", "sensor"},
      {"-o", at("a.png"), "--technique", "illumination"},
      {"-o", at("a.png"), "--device", "no such device"},
      {"-o", at("a.png"), "--fps", "0"},
  };
  for (const std::vector<std::string>& arguments : wrong) {
    const ProgramResult result = render(arguments);
    EXPECT_EQ(result.status, 2) << arguments[2] << ": " << result.errors;
    EXPECT_TRUE(result.hasOneLineOfErrors()) << result.errors;
  }
  EXPECT_EQ(folder.fileCount(), 1u);
}

// A lit floor under a sensor and a glass ball: techniques differ from the reference in the ball's light
// alone.
TEST_F(RenderCommand, ComparesTechniquesWithTheReference) {
  std::ofstream(folder / "ball.toml") << kScene << R"(
[[material]]
name = "glass"
type = "dielectric"
[[object]]
name = "ball"
material = "glass"
shape = "sphere"
radius = 0.3
vertices = 2000
translation = [0, 0.8, 0]
[[light]]
type = "point"
position = [0, 3, 0]
intensity = 100
[[sensor]]
name = "floor"
corner = [-1, 0, -1]
u = [2, 0, 0]
v = [0, 0, 2]
resolution = [16, 16]
)";
  const ProgramResult result = runProgram({"compare", at("ball.toml"), "-o", at("report"), "--size", "32x24",
                                           "--techniques", "illumination-textures,none", "--passes", "2",
                                           "--paths", "transmission", "--source", "traced"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const auto json = nlohmann::json::parse(readAll(folder / "report/report.json"));
  EXPECT_EQ(json["view"]["reference"]["passes"], 2);
  EXPECT_NE(json["command"].get<std::string>().find("--paths transmission"), std::string::npos);
  ASSERT_EQ(json["view"]["techniques"].size(), 2u);
  const auto& sensor = json["sensors"][0]["techniques"];
  EXPECT_EQ(sensor[0]["name"], "illumination-textures");
  EXPECT_NEAR(sensor[0]["layers"]["caustics"]["flux_ratio"].get<double>(), 1, 0.05);
  EXPECT_NEAR(sensor[0]["layers"]["direct"]["flux_ratio"].get<double>(), 1, 0.05);
  EXPECT_EQ(sensor[1]["layers"]["caustics"]["flux_ratio"], 0);
  EXPECT_EQ(readExr(folder / "report/sensor1-floor.reference.exr").width, 16u);
  EXPECT_EQ(readPng(folder / "report/none.png").width, 32u);
}

constexpr const char* kWater = R"(
[camera]
position = [0, 2, 4]
target = [0, -1, 0]
[[material]]
name = "water"
type = "dielectric"
ior = 1.33
[[material]]
name = "white"
type = "diffuse"
[[object]]
name = "pool"
shape = "water"
material = "water"
size = [2, 2]
grid = [60, 60]
waves = [{amplitude = 0.02, wavelength = 0.5, direction = [1, 0.3], speed = 0, phase = 0}]
[[object]]
name = "bed"
shape = "plane"
material = "white"
size = [4, 4]
translation = [0, -0.9, 0]
[[light]]
type = "directional"
direction = [0, -1, 0]
illuminance = 1000
[[sensor]]
name = "bed"
corner = [-0.5, -0.9, -0.5]
u = [1, 0, 0]
v = [0, 0, 1]
resolution = [32, 32]
)";

// Mesa's software device has subgroups of as many threads as a vector register it is told of. Its cache takes
// programs made for one size for those of another.
TEST_F(RenderCommand, CountsTheSameBeamsWhateverTheSizeOfSubgroups) {
  write("water.toml", kWater);
  nlohmann::json counts[2];
  for (const int i : {0, 1}) {
    const std::string bits = std::to_string(128 << i);
    ASSERT_EQ(runProgram({"measure", at("water.toml"), "--sensor", "bed", "--technique", "light-volumes",
                          "-o", at("bed.exr"), "--stats", at("stats.json")},
                         "MESA_SHADER_CACHE_DISABLE=true LP_NATIVE_VECTOR_WIDTH=" + bits)
                  .status,
              0);
    counts[i] = nlohmann::json::parse(readAll(folder / "stats.json"))["counts"];
    EXPECT_GT(counts[i]["volumes_drawn"], 0);
  }
  EXPECT_EQ(counts[0], counts[1]);
}

TEST_F(RenderCommand, SaysWhatToInstallWhereThereIsNoDriver) {
  const ProgramResult result =
      render({"-o", at("a.png")}, "VK_ICD_FILENAMES=/none.json VK_DRIVER_FILES=/none.json");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(result.hasOneLineOfErrors()) << result.errors;
  EXPECT_NE(result.errors.find("mesa-vulkan-drivers"), std::string::npos) << result.errors;
  EXPECT_EQ(folder.fileCount(), 1u);
}

}  // namespace
}  // namespace nephroid
