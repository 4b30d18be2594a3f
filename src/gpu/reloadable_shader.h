// Shaders that are compiled again while the program runs (builds with NEPHROID_SHADER_RELOAD).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace nephroid::gpu {

// Known to compileAgain while it lives.
class ReloadableShader {
 public:
  // As it was built from `source`.
  ReloadableShader(std::filesystem::path source, std::span<const uint32_t> spirv);
  ~ReloadableShader();
  ReloadableShader(const ReloadableShader&) = delete;
  ReloadableShader& operator=(const ReloadableShader&) = delete;

  // What programs are made of from now on.
  operator std::span<const uint32_t>() const { return spirv_; }
  void exchange(std::vector<uint32_t>& spirv) { spirv_.swap(spirv); }
  const std::filesystem::path& source() const { return source_; }

 private:
  std::filesystem::path source_;
  std::vector<uint32_t> spirv_;
};

struct ShaderChange {
  ReloadableShader* shader = nullptr;
  std::vector<uint32_t> spirv;
};

struct ShaderChanges {
  std::vector<ShaderChange> changes;
  std::string error;  // what the compiler says of the first that is wrong, in one line; empty: nothing
};

// All shaders whose sources make another SPIR-V now, none where one of them is wrong. `compiler` is a command
// that takes "-o FILE SOURCE" after it. On any thread, while no shader is exchanged.
ShaderChanges compileAgain(const std::string& compiler);

// Puts these in use; what was in use before is in them then.
void exchange(ShaderChanges& changes);

}  // namespace nephroid::gpu
