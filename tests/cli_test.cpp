#include <gtest/gtest.h>

#include "run_program.h"

namespace nephroid {
namespace {

// Wrong input ends with status 2 and one line that holds `expected`.
void expectWrong(const std::vector<std::string>& arguments, const std::string& expected) {
  const ProgramResult result = runProgram(arguments);
  EXPECT_EQ(result.status, 2) << result.errors;
  EXPECT_TRUE(result.hasOneLineOfErrors()) << result.errors;
  EXPECT_EQ(result.errors.rfind("nephroid: error: ", 0), 0u) << result.errors;
  EXPECT_NE(result.errors.find(expected), std::string::npos) << result.errors;
  EXPECT_EQ(result.output, "");
}

TEST(CommandLine, TellsItsVersionAndItsHelp) {
  const ProgramResult version = runProgram({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.output.rfind("nephroid ", 0), 0u);
  const ProgramResult help = runProgram({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.output.find("info"), std::string::npos);
}

TEST(CommandLine, NamesTheNearestOfWhatItDoesNotKnow) {
  expectWrong({}, "--help");
  expectWrong({"inof"}, "did you mean 'info'?");
  expectWrong({"--hepl"}, "did you mean '--help'?");
  expectWrong({"info", "--hepl"}, "did you mean '--help'?");
  expectWrong({"info", "a.toml", "b.toml"}, "toml");
}

}  // namespace
}  // namespace nephroid
