#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/image_io.h"
#include "support/run_program.h"

namespace nephroid {
namespace {

TEST(CommandLine, TellsItsVersionAndItsHelp) {
  const ProgramResult version = runProgram({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.output.rfind("nephroid ", 0), 0u);
  const ProgramResult help = runProgram({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.output.find("info"), std::string::npos);
}

TEST(CommandLine, NamesTheNearestOfWhatItDoesNotKnow) {
  expectWrong({}, "--help");
  expectWrong({"inof"}, "did you mean 'info'?");
  expectWrong({"--hepl"}, "did you mean '--help'?");
  expectWrong({"info", "--hepl"}, "did you mean '--help'?");
  expectWrong({"info", "a.toml", "b.toml"}, "toml");
  expectWrong({"bench", "light-transport-tabel"}, "did you mean 'light-transport-table'?");
  expectWrong({"bench", "papers-1-2", "--scenes", "nowhere"}, "nowhere/glass-ball.toml");
}

constexpr const char* kFloor = R"(
[[material]]
name = "white"
type = "diffuse"
[[object]]
name = "ground"
material = "white"
shape = "plane"
size = [2, 2]
[[light]]
type = "point"
position = [0, 2, 0]
intensity = 40
[[sensor]]
name = "floor"
corner = [-0.5, 0, -0.5]
u = [1, 0, 0]
v = [0, 0, 1]
resolution = [8, 8]
)";

class SceneCommand : public ProgramTest {
 protected:
  SceneCommand() { write("scene.toml", kFloor); }
};

TEST_F(SceneCommand, InfoSaysWhatASceneHolds) {
  const ProgramResult result = runProgram({"info", at("scene.toml")});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.output.find("sensor"), std::string::npos) << result.output;
}

TEST_F(SceneCommand, WhatWasMendedAndWhyLightIsMissingIsToldAndKept) {
  write("inward.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const std::string glass = std::string(kFloor) + R"([[material]]
name = "glass"
type = "dielectric"
[[object]]
name = "shard"
material = "glass"
mesh = "inward.obj"
translation = [0, 0.5, 0]
)";
  const auto measured = [&](const std::string& scene, const std::string& technique) {
    write("shard.toml", scene);
    const ProgramResult result =
        runProgram({"measure", at("shard.toml"), "--sensor", "floor", "-o", at("o.exr"), "--technique",
                    technique, "--passes", "1", "--stats", at("s.json")});
    EXPECT_EQ(result.status, 0) << result.errors;
    return result.errors;
  };
  const std::string turned =
      "nephroid: warning: \"shard\": 1 closed part of its mesh (4 triangles) looked inward";
  for (const char* technique : {"adaptive-beams", "reference"}) {
    const std::string errors = measured(glass, technique);
    EXPECT_EQ(errors.rfind(turned, 0), 0u) << errors;
    EXPECT_EQ(errors.find(turned, 1), std::string::npos) << errors;
    const auto stats = nlohmann::json::parse(std::ifstream(at("s.json")));
    EXPECT_EQ(stats["notes"][0].get<std::string>().rfind("\"shard\"", 0), 0u);
  }
  std::string dark = glass;
  dark.replace(dark.find("intensity = 40"), 14, "intensity = 0");
  EXPECT_NE(measured(dark, "adaptive-beams").find("nephroid: note: no light reaches any caster"),
            std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(at("s.json")))["notes"].size(), 2u);
}

TEST_F(SceneCommand, WorksWithinTheErrorAndTheMemoryAskedFor) {
  const auto measure = [&](std::initializer_list<std::string> more) {
    std::vector<std::string> arguments{"measure", at("scene.toml"), "--sensor", "floor",
                                       "-o",      at("floor.exr")};
    arguments.insert(arguments.end(), more);
    return runProgram(arguments);
  };
  for (const char* wrong : {"0", "-0.1", "1.5", "nan", "little"}) {
    const ProgramResult result = measure({"--error", wrong});
    EXPECT_EQ(result.status, 2) << wrong;
    EXPECT_TRUE(result.hasOneLineOfErrors()) << result.errors;
  }
  EXPECT_EQ(measure({"--error", "2%", "--memory", "16", "--stats", at("stats.json")}).status, 0);
  const auto stats = nlohmann::json::parse(std::ifstream(at("stats.json")));
  EXPECT_EQ(stats["technique"], "adaptive-beams");
  EXPECT_EQ(stats["settings"]["error"], "0.02");
  EXPECT_GE(stats["error"], 0);
  EXPECT_LE(stats["left_out"], 0.2 * 0.02);
}

TEST_F(SceneCommand, TooLittleMemoryIsAFailureThatSaysHowMuchWouldDo) {
  write("ball.toml", std::string(kFloor) + R"(
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "ball"
material = "glass"
shape = "sphere"
radius = 0.4
vertices = 100000
translation = [0, 1, 0]
)");
  const ProgramResult result =
      runProgram({"measure", at("ball.toml"), "--sensor", "floor", "--memory", "16", "-o", at("ball.exr")});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(result.hasOneLineOfErrors()) << result.errors;
  EXPECT_NE(result.errors.find("--memory 16"), std::string::npos) << result.errors;
  EXPECT_FALSE(std::filesystem::exists(at("ball.exr")));
}

TEST_F(SceneCommand, BakedTablesAreUsedForTheirSceneAndRefusedForAnother) {
  const std::string ball = R"(
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
[[object]]
name = "ball"
material = "glass"
shape = "sphere"
radius = 0.3
vertices = 200
translation = [0, 1, 0]
)";
  write("ball.toml", kFloor + ball);
  const std::string cache = "XDG_CACHE_HOME=" + folder.path().string();
  ASSERT_EQ(
      runProgram({"bake", at("ball.toml"), "-o", at("ball.tables"), "--directions", "33"}, cache).status, 0);
  const auto measure = [&](const char* directions) {
    return runProgram({"measure", at("ball.toml"), "--sensor", "floor", "-o", at("floor.exr"), "--technique",
                       "illumination-textures", "--planes", "sensor", "--source", "table", "--directions",
                       directions, "--baked", at("ball.tables")},
                      cache);
  };
  EXPECT_EQ(measure("33").status, 0) << measure("33").errors;
  const ProgramResult other = measure("129");
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(other.hasOneLineOfErrors()) << other.errors;
  EXPECT_NE(other.errors.find("ball.tables"), std::string::npos) << other.errors;
  EXPECT_EQ(runProgram({"bake", at("scene.toml"), "-o", at("none.tables")}, cache).status, 2);
}

TEST_F(SceneCommand, MeasureWritesWhatThePointLightSends) {
  const ProgramResult result =
      runProgram({"measure", at("scene.toml"), "--sensor", "floor", "-o", at("floor.exr"), "--source",
                  "traced", "--technique", "none", "--stats", at("stats.json")});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  const Image image = readExr(folder / "floor.exr");
  ASSERT_EQ(image.width, 8u);
  // I cos / d^2 in the middle of the four texels around the center, each 1/16 m from it in x and z.
  const double squared = 4 + 2.0 / 256;
  EXPECT_NEAR((*image.find("direct.R"))[3 * 8 + 3], 40 * 2 / std::pow(squared, 1.5), 0.01);
  EXPECT_EQ((*image.find("caustics.R"))[0], 0);
  const auto stats = nlohmann::json::parse(readAll(folder / "stats.json"));
  EXPECT_EQ(stats["technique"], "none");
  EXPECT_EQ(stats["source"], "traced");
  EXPECT_GT(stats["frame_ms"], 0);
}

TEST_F(SceneCommand, TheSameCommandWritesTheSameBytes) {
  for (const char* name : {"a.exr", "b.exr"})
    runProgram({"measure", at("scene.toml"), "--sensor", "floor", "-o", at(name), "--source", "traced",
                "--technique", "none"});
  EXPECT_EQ(readAll(folder / "a.exr"), readAll(folder / "b.exr"));
  EXPECT_GT(readAll(folder / "a.exr").size(), 0u);
}

TEST_F(SceneCommand, ASceneWithoutLightSaysWhatLightsIt) {
  std::string dark = kFloor;
  const std::size_t light = dark.find("[[light]]");
  dark.erase(light, dark.find("[[sensor]]") - light);
  const auto told = [&](const std::string& scene) {
    write("dark.toml", scene);
    const ProgramResult measured =
        runProgram({"measure", at("dark.toml"), "--sensor", "floor", "-o", at("out.exr"), "--quiet",
                    "--technique", "reference", "--passes", "1"});
    EXPECT_EQ(measured.status, 0) << measured.errors;
    const ProgramResult info = runProgram({"info", at("dark.toml")});
    constexpr auto kLine = "the scene has no light, so a clear sky and its sun light it";
    EXPECT_EQ(measured.errors.find(kLine) == std::string::npos, info.output.find(kLine) == std::string::npos);
    EXPECT_EQ(measured.errors.find(kLine), measured.errors.rfind(kLine));
    return measured.errors.find(kLine) != std::string::npos;
  };
  EXPECT_TRUE(told(dark));
  EXPECT_FALSE(told("light = []\n" + dark));
  EXPECT_FALSE(told(kFloor));
}

TEST_F(SceneCommand, AWrongSkyIsOneLine) {
  for (const char* keys :
       {"sun = [0, 100]", "sun = [0, 40]\nturbidity = 20", "sun = [0, 40]\nturbidty = 3", ""}) {
    write("sky.toml", std::string(kFloor) + "[[light]]\ntype = \"sky\"\nmodel = \"clear\"\n" + keys + "\n");
    const ProgramResult result = runProgram({"render", at("sky.toml"), "-o", at("out.png")});
    EXPECT_EQ(result.status, 2) << keys;
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
    EXPECT_NE(result.errors.find("sky.toml:"), std::string::npos) << result.errors;
  }
}

TEST_F(SceneCommand, WrongInputLeavesNothingBehind) {
  write("broken.toml", "[camera\nposition = 1");
  const auto measure = [&](std::vector<std::string> changed) {
    std::vector<std::string> arguments{"measure",  at("scene.toml"), "-o",          at("floor.exr"),
                                       "--source", "traced",         "--technique", "none"};
    arguments.insert(arguments.end(), changed.begin(), changed.end());
    return arguments;
  };
  expectWrong(measure({"--sensor", "flor"}), "did you mean 'floor'?");
  expectWrong(measure({"--sensor", "floor", "--repeat", "0"}), "--repeat");
  expectWrong(measure({"--sensor", "floor", "--texture-size", "1e9"}), "16 to 8192");
  expectWrong(measure({"--sensor", "floor", "--directions", "-3"}), "--directions");
  expectWrong(measure({"--sensor", "floor", "--time", "later"}), "--time");
  expectWrong(measure({"--sensor", "floor", "--time", "nan"}), "--time");
  expectWrong(measure({"--sensor", "floor", "--planse", "4"}), "did you mean '--planes'?");
  const auto render = [&](const char* option, const char* value) {
    return std::vector<std::string>{"render", at("scene.toml"), "-o", at("a.png"), option, value};
  };
  for (const char* exposure : {"automatic", "0", "-1", "nan", "1e20"})
    expectWrong(render("--exposure", exposure), "neither auto nor a number from 1e-12 to 1e12");
  expectWrong(render("--tone", "agxx"), "did you mean 'agx'?");
  for (const char* samples : {"0", "4097", "many"})
    expectWrong({"render", at("scene.toml"), "-o", at("a.png"), "--samples", samples}, "1 to 4096");
  expectWrong(measure({}), "--sensor");
  expectWrong({"measure", at("broken.toml"), "--sensor", "floor", "-o", at("floor.exr")}, "broken.toml");
  expectWrong({"measure", at("none.toml"), "--sensor", "floor", "-o", at("floor.exr")}, "none.toml");
  expectWrong({"measure", at("scene.toml"), "--sensor", "floor", "-o", at("floor.jpg")}, ".exr");
  expectWrong(
      {"measure", at("scene.toml"), "--sensor", "floor", "-o", at("a.exr"), "--stats", at("scene.toml")},
      "scene itself");
  EXPECT_EQ(folder.fileCount(), 2u);
}

TEST_F(SceneCommand, CompareRefusesWrongInputAndForeignFolders) {
  const auto compare = [&](std::vector<std::string> changed) {
    std::vector<std::string> arguments{"compare", at("scene.toml")};
    arguments.insert(arguments.end(), changed.begin(), changed.end());
    return arguments;
  };
  std::filesystem::create_directory(folder / "mine");
  std::ofstream(folder / "mine/notes.txt") << "mine";
  expectWrong(compare({"-o", at("mine")}), "notes.txt");
  expectWrong(compare({"-o", at("report"), "--techniques", "none,illumination-texture"}),
              "did you mean 'illumination-textures'?");
  expectWrong(compare({"-o", at("report"), "--passes", "0"}), "--passes");
  expectWrong(compare({"-o", at("report"), "--error", "small"}), "--error");
  expectWrong(compare({"-o", at("report"), "--size", "0x4"}), "--size");
  expectWrong({"compare", "--techniques", "none", at("none.toml"), "-o", at("report")}, "none.toml");
  expectWrong(compare({}), "--output");
  EXPECT_EQ(folder.fileCount(), 2u);
}

TEST_F(SceneCommand, WhatCannotBeWrittenIsAFailure) {
  const ProgramResult result =
      runProgram({"measure", at("scene.toml"), "--sensor", "floor", "-o", at("none/floor.exr")});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(result.hasOneLineOfErrors()) << result.errors;
}

}  // namespace
}  // namespace nephroid
