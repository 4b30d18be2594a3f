// Scenes that a test writes, and what is said of wrong ones.
#pragma once

#include "formats/load.h"
#include "support/scratch_files.h"

namespace nephroid {

inline const std::string kMaterials = R"([[material]]
name = "glass"
type = "dielectric"
[[material]]
name = "white"
type = "diffuse"
)";

// A tetrahedron that is closed and looks outward.
inline const std::string kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class SceneFile : public ScratchFiles {
 protected:
  Scene load(const std::string& toml, double time = 0) const {
    return loadScene(write("scene.toml", toml), time);
  }
  std::string errorOf(const std::string& toml) const {
    return inputErrorOf([&] { load(toml); });
  }
  void expectError(const std::string& toml, const std::vector<std::string>& parts) const {
    const std::string error = errorOf(toml);
    EXPECT_FALSE(error.empty()) << "accepted: " << toml;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    for (const std::string& part : parts)
      EXPECT_NE(error.find(part), std::string::npos) << error << "\nlacks: " << part;
  }
};

}  // namespace nephroid
