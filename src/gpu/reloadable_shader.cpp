#include "gpu/reloadable_shader.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "core/error.h"

namespace nephroid::gpu {
namespace {

std::vector<ReloadableShader*>& allShaders() {
  static std::vector<ReloadableShader*> all;
  return all;
}

struct Answer {
  std::string text;
  bool isGood = false;
};

Answer run(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw RuntimeFailure("the shader compiler could not be started");
  Answer answer;
  std::array<char, 512> some{};
  while (const std::size_t count = std::fread(some.data(), 1, some.size(), pipe))
    answer.text.append(some.data(), count);
  answer.isGood = pclose(pipe) == 0;
  return answer;
}

// Compilers say first what they compile, and then what is wrong with it.
std::string firstError(const std::string& text) {
  std::istringstream lines(text);
  std::string line, last;
  while (std::getline(lines, line)) {
    if (line.find("ERROR") != std::string::npos || line.find("error") != std::string::npos) return line;
    if (!line.empty()) last = line;
  }
  return last;
}

std::vector<uint32_t> readWords(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
  std::copy_n(bytes.begin(), words.size() * sizeof(uint32_t), reinterpret_cast<char*>(words.data()));
  return words;
}

// None where the compiler has something to say, which goes into `error`.
std::optional<std::vector<uint32_t>> compiled(const std::string& compiler,
                                              const std::filesystem::path& source, std::string& error) {
  const std::filesystem::path made =
      std::filesystem::temp_directory_path() / ("nephroid-shader-" + std::to_string(getpid()) + ".spv");
  const Answer answer = run(compiler + " -o '" + made.string() + "' '" + source.string() + "'");
  if (!answer.isGood) {
    error = source.filename().string() + ": " + firstError(answer.text);
    return std::nullopt;
  }
  std::vector<uint32_t> words = readWords(made);
  std::filesystem::remove(made);
  return words;
}

}  // namespace

ReloadableShader::ReloadableShader(std::filesystem::path source, std::span<const uint32_t> spirv)
    : source_(std::move(source)), spirv_(spirv.begin(), spirv.end()) {
  allShaders().push_back(this);
}

ReloadableShader::~ReloadableShader() {
  std::erase(allShaders(), this);
}

ShaderChanges compileAgain(const std::string& compiler) {
  ShaderChanges made;
  for (ReloadableShader* shader : allShaders()) {
    auto words = compiled(compiler, shader->source(), made.error);
    if (!words) return {{}, made.error};
    if (!std::ranges::equal(*words, std::span<const uint32_t>(*shader)))
      made.changes.push_back({shader, std::move(*words)});
  }
  return made;
}

void exchange(ShaderChanges& changes) {
  for (ShaderChange& change : changes.changes) change.shader->exchange(change.spirv);
}

}  // namespace nephroid::gpu
