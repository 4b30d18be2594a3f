// What is told of light that does not arrive.
#include "report/missing_light.h"

#include <gtest/gtest.h>

#include "support/scene_file.h"

namespace nephroid {
namespace {

const std::string kFloor = "[[object]]\nname = \"floor\"\nmaterial = \"white\"\nshape = \"plane\"\n";
const std::string kBall =
    "[[object]]\nname = \"ball\"\nmaterial = \"glass\"\nshape = \"sphere\"\nradius = 0.3\nvertices = 200\n"
    "translation = [0, 1, 0]\n";
const std::string kLamp =
    "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, 3, 0]\nintensity = 1\n";
const std::string kGood = kMaterials + kFloor + kBall;

class MissingLight : public SceneFile {
 protected:
  // The only line that is said; empty where there is none.
  std::string said(const std::string& toml, const std::optional<LightBudget>& budget = std::nullopt,
                   const Sensor* sensor = nullptr) const {
    const std::vector<std::string> lines = missingLight(load(toml), budget, sensor);
    EXPECT_LE(lines.size(), 1u);
    return lines.empty() ? std::string() : lines[0];
  }
  std::vector<std::string> warned(const std::string& toml) const { return meshWarnings(load(toml)); }
  static void expectPart(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks: " << part;
  }
};

TEST_F(MissingLight, AGoodSceneHasNothingToBeSaid) {
  EXPECT_EQ(said(kGood + kLamp), "");
  EXPECT_EQ(said(kGood + kLamp, LightBudget{.incident = 10, .landed = 9, .shaded = 1}), "");
  EXPECT_TRUE(warned(kGood + kLamp).empty());
}

TEST_F(MissingLight, LampsThatReachNothingAreNamed) {
  expectPart(said("light = []\n" + kGood), "no light");
  expectPart(said(kGood + "[[light]]\ntype = \"point\"\nposition = [0, 3, 0]\nintensity = 0\n"),
             "intensity of 0");
  const std::string spot =
      "[[light]]\nname = \"spot\"\ntype = \"spot\"\nposition = [0, 3, 0]\nintensity = 1\n";
  expectPart(said(kGood + spot + "direction = [1, 0, 0]\n"), "\"spot\" points away");
  EXPECT_EQ(said(kGood + spot + "direction = [0, -1, 0]\n"), "");
  EXPECT_EQ(said(kGood + spot + "direction = [1, 0, 0]\n" + kLamp), "");
  const std::string panel =
      "[[light]]\nname = \"panel\"\ntype = \"area\"\ncorner = [0, 3, 0]\nluminance = 1\n";
  expectPart(said(kGood + panel + "u = [1, 0, 0]\nv = [0, 0, 1]\n"), "\"panel\" shines to its other side");
  EXPECT_EQ(said(kGood + panel + "u = [0, 0, 1]\nv = [1, 0, 0]\n"), "");
}

TEST_F(MissingLight, ASceneWithoutCastersIsTold) {
  expectPart(said(kMaterials + kFloor + kLamp), "nothing makes caustics");
  EXPECT_EQ(said(kMaterials + kFloor + kLamp + "[medium]\nextinction = 0.1\n"), "");
}

TEST_F(MissingLight, ASensorThatFacesAwayIsNamed) {
  Sensor sensor;
  sensor.name = "meter";
  EXPECT_EQ(said(kGood + kLamp, std::nullopt, &sensor), "");
  std::swap(sensor.u, sensor.v);
  expectPart(said(kGood + kLamp, std::nullopt, &sensor), "\"meter\" faces away");
}

TEST_F(MissingLight, WhatBecameOfTheLightIsTheReason) {
  const auto of = [&](LightBudget budget) { return said(kGood + kLamp, budget); };
  expectPart(of({.incident = 0}), "no light reaches any caster");
  expectPart(of({.incident = 10, .shaded = 10}), "something opaque stands between");
  expectPart(of({.incident = 10, .lost = 9}), "stays in the casters");
  expectPart(of({.incident = 10, .missed = 9}), "does not land");
  expectPart(of({.incident = 10}), "absorb");
  expectPart(of({.incident = 10, .landed = 9, .lost = 0.5, .isLossTold = true}), "5 % of the light");
  EXPECT_EQ(of({.incident = 10, .landed = 9, .lost = 0.5}), "");
  EXPECT_EQ(of({.incident = 10, .landed = 9, .lost = 0.05, .isLossTold = true}), "");
}

TEST_F(MissingLight, MeshesThatWereMendedAreToldOnce) {
  write("inward.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  write("twice.obj", kTetrahedron + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto object = [](const std::string& file, const std::string& more = "") {
    return "[[object]]\nname = \"" + file + more + "\"\nmaterial = \"glass\"\nmesh = \"" + file + ".obj\"\n";
  };
  const auto lines =
      warned(kMaterials + object("inward") + object("inward", " 2") + object("open") + object("twice"));
  ASSERT_EQ(lines.size(), 3u);
  expectPart(lines[0], "\"inward\": 1 closed part of its mesh (4 triangles)");
  expectPart(lines[0], "as-given");
  expectPart(lines[1], "\"twice\": 4 triangles");
  expectPart(lines[2], "\"open\": its mesh is open (3 edges");
  // White things look the same from both sides.
  EXPECT_TRUE(warned(kMaterials + "[[object]]\nmaterial = \"white\"\nmesh = \"inward.obj\"\n").empty());
}

TEST_F(MissingLight, FacesThatAllLookInwardAsGivenAreTold) {
  const std::string inward = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
  write("inward.obj", inward);
  // With a part around it, it is a cavity.
  write("cavity.obj",
        inward + "v -1 -1 -1\nv 9 -1 -1\nv -1 9 -1\nv -1 -1 9\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n");
  const auto warnedOf = [&](const std::string& file) {
    return warned(kMaterials + "[[object]]\nmaterial = \"glass\"\nmesh = \"" + file +
                  ".obj\"\nfaces = \"as-given\"\n");
  };
  ASSERT_EQ(warnedOf("inward").size(), 1u);
  expectPart(warnedOf("inward")[0], "all its faces look inward");
  EXPECT_TRUE(warnedOf("cavity").empty());
}

}  // namespace
}  // namespace nephroid
