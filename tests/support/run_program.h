#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace nephroid {

struct ProgramResult {
  int status = 0;
  std::string output;
  std::string errors;
  bool hasOneLineOfErrors() const {
    return std::count(errors.begin(), errors.end(), '\n') == 1 && errors.back() == '\n';
  }
};

// Runs the built program with `arguments`, none of which may hold a single quote; `environment` is as in "A=1
// B=2".
inline ProgramResult runProgram(const std::vector<std::string>& arguments,
                                const std::string& environment = "") {
  const TemporaryFolder folder;
  std::string command = "env " + environment + " '" NEPHROID_PROGRAM "'";
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  command += " >'" + (folder / "out").string() + "' 2>'" + (folder / "err").string() + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), readAll(folder / "out"),
          readAll(folder / "err")};
}

// Wrong input ends with status 2 and one line that holds `expected`.
inline void expectRefused(const ProgramResult& result, const std::string& expected) {
  EXPECT_EQ(result.status, 2) << result.errors;
  EXPECT_TRUE(result.hasOneLineOfErrors()) << result.errors;
  EXPECT_EQ(result.errors.rfind("nephroid: error: ", 0), 0u) << result.errors;
  EXPECT_NE(result.errors.find(expected), std::string::npos) << result.errors;
  EXPECT_EQ(result.output, "");
}
inline void expectWrong(const std::vector<std::string>& arguments, const std::string& expected) {
  expectRefused(runProgram(arguments), expected);
}

// A test that runs the program on files in a folder of its own.
class ProgramTest : public testing::Test {
 protected:
  std::string at(const char* name) const { return (folder / name).string(); }
  void write(const char* name, const std::string& text) const { std::ofstream(folder / name) << text; }
  TemporaryFolder folder;
};

}  // namespace nephroid
