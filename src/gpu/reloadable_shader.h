// Shaders that are compiled again while the program runs (builds with NEPHROID_SHADER_RELOAD).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace nephroid::gpu {

// A shader that compileAgain compiles, as long as this object exists.
class ReloadableShader {
 public:
  // `spirv`: as it was built from the file `source`.
  ReloadableShader(std::filesystem::path source, std::span<const uint32_t> spirv);
  ~ReloadableShader();
  ReloadableShader(const ReloadableShader&) = delete;
  ReloadableShader& operator=(const ReloadableShader&) = delete;

  // The SPIR-V from which new programs are made.
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
  std::string
      error;  // the compiler's message for the first shader with an error, in one line; empty: no error
};

// Compiles all shaders, and returns those whose SPIR-V has changed; none where one of them has an error.
// `compiler` is a command to which "-o FILE SOURCE" is added. May run on any thread, but not during
// `exchange`.
ShaderChanges compileAgain(const std::string& compiler);

// Exchanges the new SPIR-V with the present one. A second call undoes it.
void exchange(ShaderChanges& changes);

}  // namespace nephroid::gpu
