#include "gpu/reloadable_shader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "support/temporary_folder.h"

namespace nephroid {
namespace {

constexpr uint32_t kSpirvMagic = 0x07230203;

std::string shaderThatWrites(const std::string& value) {
  return "#version 460\nlayout(local_size_x = 1) in;\nlayout(push_constant) uniform Constants { float "
         "factor; };\n"
         "layout(binding = 0, r32f) uniform image2D result;\n"
         "void main() { imageStore(result, ivec2(0), vec4(" +
         value + ")); }\n";
}

std::vector<uint32_t> wordsOf(const gpu::ReloadableShader& shader) {
  const std::span<const uint32_t> words = shader;
  return {words.begin(), words.end()};
}

class ReloadableShaders : public testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(shader_.source()) << text; }
  static gpu::ShaderChanges compileAgain() { return gpu::compileAgain(NEPHROID_SHADER_COMPILER); }

  TemporaryFolder folder_;
  gpu::ReloadableShader shader_{folder_ / "write.comp", {}};
};

TEST_F(ReloadableShaders, ChangeWithTheirSourcesAndBack) {
  write(shaderThatWrites("factor"));
  gpu::ShaderChanges made = compileAgain();
  ASSERT_EQ(made.changes.size(), 1u) << made.error;
  gpu::exchange(made);
  const std::vector<uint32_t> first = wordsOf(shader_);
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(first[0], kSpirvMagic);
  EXPECT_TRUE(compileAgain().changes.empty());

  write(shaderThatWrites("2 * factor"));
  made = compileAgain();
  ASSERT_EQ(made.changes.size(), 1u);
  gpu::exchange(made);
  EXPECT_NE(wordsOf(shader_), first);
  gpu::exchange(made);
  EXPECT_EQ(wordsOf(shader_), first);
}

TEST_F(ReloadableShaders, StayAsTheyWereWhereOneIsWrong) {
  const gpu::ReloadableShader other(folder_ / "other.comp", {});
  std::ofstream(other.source()) << shaderThatWrites("1");
  write(shaderThatWrites("factr"));
  const gpu::ShaderChanges made = compileAgain();
  EXPECT_TRUE(made.changes.empty());
  EXPECT_NE(made.error.find("write.comp"), std::string::npos) << made.error;
  EXPECT_NE(made.error.find("factr"), std::string::npos) << made.error;
  EXPECT_EQ(std::ranges::count(made.error, '\n'), 0);
}

}  // namespace
}  // namespace nephroid
