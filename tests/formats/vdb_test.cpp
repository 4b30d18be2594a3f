// OpenVDB files as density grids of the air, and broken ones.
#include <openvdb/openvdb.h>

#include "formats/load.h"
#include "formats/vdb.h"
#include "scene/density_grid.h"
#include "support/scratch_files.h"
#include "support/temporary_folder.h"

namespace nephroid {
namespace {

class VdbFile : public ScratchFiles {
 protected:
  // 4 x 2 x 3 voxels of 0.5 m from voxel (2, -1, 0) on, of the density 1 + x, and one in the middle of the
  // air.
  std::string written(bool isTurned = false) const {
    openvdb::initialize();
    auto grid = openvdb::FloatGrid::create(0);
    grid->setName("density");
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    if (isTurned) grid->transform().preRotate(0.3, openvdb::math::Y_AXIS);
    for (int z = 0; z < 3; ++z)
      for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x) grid->getAccessor().setValue({2 + x, y - 1, z}, float(1 + x));
    const auto file = write("smoke.vdb", "").string();
    openvdb::io::File(file).write({grid});
    return file;
  }
  std::string errorOf(const std::string& file, const std::string& name = "") const {
    return inputErrorOf([&] { loadVdb(file, name); });
  }
};

TEST_F(VdbFile, IsReadWhereItIsActive) {
  const DensityGrid grid = loadVdb(written(), "density");
  EXPECT_EQ(grid.cells, uvec3(4, 2, 3));
  EXPECT_LT(distance(grid.corner, vec3(0.75f, -0.75f, -0.25f)), 1e-6f);
  EXPECT_LT(distance(grid.size, vec3(2, 1, 1.5f)), 1e-6f);
  EXPECT_FLOAT_EQ(densityAt(grid, {1, -0.25f, 0.5f}), 0.25f);
  EXPECT_FLOAT_EQ(densityAt(grid, {2.5f, -0.25f, 0.5f}), 1);
  EXPECT_EQ(densityAt(grid, {3, -0.25f, 0.5f}), 0);
}

TEST_F(VdbFile, IsScaledAndMovedByTheScene) {
  written();
  const Scene scene = loadScene(write(
      "scene.toml",
      "[medium]\nextinction = 1\n[medium.grid]\nfile = \"smoke.vdb\"\nscale = 2\ntranslation = [1, 0, 0]\n"));
  EXPECT_LT(distance(scene.medium->grid->corner, vec3(2.5f, -1.5f, -0.5f)), 1e-6f);
  EXPECT_LT(distance(scene.medium->grid->size, vec3(4, 2, 3)), 1e-6f);
}

TEST_F(VdbFile, ThatIsBrokenSaysWhatIsWrong) {
  const std::string whole = readAll(written());
  EXPECT_NE(errorOf(write("text.vdb", "not a grid at all, but text")).find("text.vdb"), std::string::npos);
  EXPECT_NE(errorOf(write("empty.vdb", "")), "");
  EXPECT_NE(errorOf(write("cut.vdb", whole.substr(0, whole.size() / 2))), "");
  EXPECT_NE(errorOf("/nowhere/smoke.vdb"), "");
  EXPECT_NE(errorOf(written(), "heat").find("density"), std::string::npos);
  EXPECT_NE(errorOf(written(true)).find("turned"), std::string::npos);
  const std::string scene = "[medium]\nextinction = 1\n[medium.grid]\nfile = \"cut.vdb\"\n";
  EXPECT_NE(inputErrorOf([&] { loadScene(write("scene.toml", scene)); }).find("scene.toml:4"),
            std::string::npos);
}

}  // namespace
}  // namespace nephroid
