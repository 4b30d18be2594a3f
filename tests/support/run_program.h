#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
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

}  // namespace nephroid
