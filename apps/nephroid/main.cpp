// The command line: what was asked for is read here, done elsewhere, and ends as an exit status.
#include <algorithm>
#include <cctype>
#include <cstring>
#include <iostream>
#include <new>

#include "command.h"
#include "core/error.h"
#include "core/interrupt.h"

namespace nephroid {
namespace {

std::string typedCommand;

// A word that a shell would take apart is quoted.
std::string quoted(const std::string& word) {
  const auto isPlain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::strchr("_-+./,:=@%", c) != nullptr;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), isPlain)) return word;
  std::string text;
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + text + "'";
}

void rememberCommandLine(int argc, char** argv) {
  typedCommand = "nephroid";
  for (int i = 1; i < argc; ++i) typedCommand += " " + quoted(argv[i]);
}

enum ExitStatus { kDone = 0, kFailed = 1, kWrongInput = 2, kInterrupted = 130 };

// One line, whatever a file's own words brought into it.
ExitStatus fail(ExitStatus status, std::string message) {
  for (char& c : message)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  while (!message.empty() && message.back() == ' ') message.pop_back();
  std::cerr << "nephroid: error: " << message << '\n';
  return status;
}

// Long options of a command, or the commands where `app` is the program itself.
std::vector<std::string> knownWords(const CLI::App& app, bool isFlag) {
  std::vector<std::string> words;
  if (isFlag) {
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  } else {
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
      words.push_back(command->get_name());
  }
  return words;
}

std::string describeUnknown(const CLI::App& app, const std::string& word) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const bool isFlag = word.size() > 1 && word[0] == '-';
  if (!isFlag && !chosen.empty()) return "unexpected '" + word + "' after '" + command.get_name() + "'";
  const std::string nearest = nearestName(word.substr(0, word.find('=')), knownWords(command, isFlag));
  return "unknown " + std::string(isFlag ? "option '" : "command '") + word + "'" +
         (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

std::string describe(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  const std::string help =
      " (see 'nephroid " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help')";
  const std::vector<std::string> unknown = app.remaining(true);
  if (!unknown.empty()) return describeUnknown(app, unknown.front()) + help;
  return error.what() + help;
}

ExitStatus runProgram(int argc, char** argv) {
  rememberCommandLine(argc, argv);
  CLI::App app("Caustics: the light that glass, mirrors and water send on.", "nephroid");
  app.set_version_flag("--version", "nephroid " NEPHROID_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer("Exit status: 0 success; 1 the work could not be done; 2 the input is wrong; 130 interrupted.");
  const Command commands[] = {addRender(app), addMeasure(app), addCompare(app), addBake(app),
                              addBench(app),  addInfo(app),    addView(app),    addHelp(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    app.exit(asked);
    return kDone;
  } catch (const CLI::ParseError& error) {
    return fail(kWrongInput, describe(app, error));
  }
  for (const Command& command : commands)
    if (command.app->parsed()) command.run();
  return kDone;
}

ExitStatus runGuarded(int argc, char** argv) {
  try {
    return runProgram(argc, argv);
  } catch (const InputError& error) {
    return fail(kWrongInput, error.what());
  } catch (const Interrupted& error) {
    return fail(kInterrupted, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kFailed, "there is not enough memory for this; try fewer vertices, directions or texels");
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}

}  // namespace

const std::string& commandLine() {
  return typedCommand;
}

}  // namespace nephroid

int main(int argc, char** argv) {
  nephroid::catchInterrupts();
  return nephroid::runGuarded(argc, argv);
}
