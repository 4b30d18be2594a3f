// The reference on the command line: stopping, keeping, going on.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "core/image_io.h"
#include "support/run_program.h"

namespace nephroid {
namespace {

constexpr const char* kScene = R"(
[camera]
position = [0, 1, 2]
target = [0, 0.3, 0]
[[material]]
name = "white"
type = "diffuse"
[[material]]
name = "glass"
type = "dielectric"
[[object]]
name = "ground"
material = "white"
shape = "plane"
size = [4, 4]
[[object]]
name = "ball"
material = "glass"
shape = "sphere"
radius = 0.3
vertices = 400
translation = [0, 0.5, 0]
[[light]]
type = "point"
position = [0.5, 2, 0]
intensity = 40
[[sensor]]
name = "floor"
corner = [-0.5, 0, -0.5]
u = [1, 0, 0]
v = [0, 0, 1]
resolution = [8, 8]
)";

class ReferenceCommand : public ProgramTest {
 protected:
  ReferenceCommand() { write("scene.toml", kScene); }
  ProgramResult run(const std::string& command, const char* output, std::vector<std::string> more) const {
    std::vector<std::string> arguments{command,     at("scene.toml"), "--technique", "reference",
                                       "--photons", "2000",           "-o",          at(output)};
    if (command == "measure") arguments.insert(arguments.end(), {"--sensor", "floor"});
    if (command == "render") arguments.insert(arguments.end(), {"--size", "32x24"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments);
  }
};

void expectSamePixels(const Image& a, const Image& b) {
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (const ImageChannel& channel : a.channels) {
    const std::vector<float>* other = b.find(channel.name);
    ASSERT_NE(other, nullptr) << channel.name;
    EXPECT_EQ(channel.values, *other) << channel.name;
  }
}

TEST_F(ReferenceCommand, WhatIsResumedIsWhatNeverStopped) {
  for (const char* command : {"render", "measure"}) {
    ASSERT_EQ(run(command, "parts.exr", {"--passes", "3"}).status, 0);
    ASSERT_EQ(run(command, "parts.exr", {"--passes", "9", "--resume"}).status, 0);
    ASSERT_EQ(run(command, "whole.exr", {"--passes", "9"}).status, 0);
    expectSamePixels(readExr(folder / "parts.exr"), readExr(folder / "whole.exr"));
    std::filesystem::remove(folder / "parts.exr");
  }
}

TEST_F(ReferenceCommand, TheSameCommandWritesTheSameBytes) {
  ASSERT_EQ(run("render", "a.exr", {"--passes", "3"}).status, 0);
  const std::string first = readAll(folder / "a.exr");
  ASSERT_EQ(run("render", "a.exr", {"--passes", "3"}).status, 0);
  EXPECT_EQ(readAll(folder / "a.exr"), first);
  ASSERT_EQ(run("render", "b.exr", {"--passes", "3", "--seed", "2"}).status, 0);
  EXPECT_NE(*readExr(folder / "a.exr").find("R"), *readExr(folder / "b.exr").find("R"));
}

TEST_F(ReferenceCommand, TheFileSaysHowItWasMade) {
  ASSERT_EQ(run("measure", "a.exr", {"--passes", "4", "--seed", "7"}).status, 0);
  const std::vector<ImageAttribute> attributes = readExrAttributes(folder / "a.exr");
  const auto text = [&](const std::string& name) -> std::string {
    for (const ImageAttribute& attribute : attributes)
      if (attribute.name == name)
        return std::holds_alternative<int>(attribute.value) ? std::to_string(std::get<int>(attribute.value))
                                                            : std::get<std::string>(attribute.value);
    return "missing";
  };
  EXPECT_EQ(text("software").rfind("nephroid ", 0), 0u);
  EXPECT_NE(text("commandLine").find("--seed 7"), std::string::npos);
  EXPECT_EQ(text("seed"), "7");
  EXPECT_EQ(text("passes"), "4");
  EXPECT_EQ(text("paths"), "all");
  EXPECT_EQ(text("unit"), "lux");
}

TEST_F(ReferenceCommand, AnErrorAskedForIsReached) {
  ASSERT_EQ(run("measure", "a.exr", {"--error", "10%"}).status, 0);
  const Image image = readExr(folder / "a.exr");
  // White light: any channel will do.
  std::vector<std::pair<float, float>> texels;
  double light = 0;
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    texels.emplace_back((*image.find("caustics.G"))[i], (*image.find("caustics.standard_error.G"))[i]);
    light += double(texels.back().first);
  }
  std::sort(texels.rbegin(), texels.rend());
  double values = 0, errors = 0;
  for (std::size_t i = 0; values < 0.95 * light; ++i) {
    values += double(texels[i].first);
    errors += double(texels[i].second);
  }
  EXPECT_LE(errors / values, 0.1 * 1.0001);
  EXPECT_GT(errors, 0);
}

TEST_F(ReferenceCommand, InterruptedItKeepsWhatThereIs) {
  const std::string command =
      "timeout --foreground --preserve-status -s INT 2 '" NEPHROID_PROGRAM "' render '" + at("scene.toml") +
      "' --technique reference --photons 2000 --size 32x24 --passes 100000000 -o '" + at("a.exr") + "' 2>'" +
      at("errors") + "'";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_NE(readAll(folder / "errors").find("--resume"), std::string::npos) << readAll(folder / "errors");
  EXPECT_EQ(readExr(folder / "a.exr").width, 32u);
}

TEST_F(ReferenceCommand, SaysWhatItCannotGoOnWith) {
  ASSERT_EQ(run("render", "a.exr", {"--passes", "2"}).status, 0);
  const std::string before = readAll(folder / "a.exr");
  expectRefused(run("render", "a.exr", {"--resume", "--seed", "5"}), "seed");
  EXPECT_EQ(readAll(folder / "a.exr"), before);
  expectRefused(run("render", "a.png", {"--resume"}), ".exr");
  Image foreign;
  foreign.width = foreign.height = 2;
  foreign.channel("R");
  writeExr(folder / "foreign.exr", foreign);
  expectRefused(run("render", "foreign.exr", {"--resume"}), "foreign.exr");
  expectRefused(run("render", "b.exr", {"--error", "0"}), "--error");
  expectRefused(run("render", "b.exr", {"--passes", "0"}), "--passes");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.exr"));
}

}  // namespace
}  // namespace nephroid
