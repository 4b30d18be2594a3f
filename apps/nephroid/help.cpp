#include <iostream>
#include <memory>

#include "command.h"
#include "reference/settings.h"
#include "techniques/registry.h"

namespace nephroid {
namespace {

constexpr std::size_t kWidth = 100;  // columns
constexpr const char* kReferenceSummary =
    "Photon mapping and path tracing, with an estimate of the error: the reference for all techniques";

// Breaks a text between words, each line after the first behind `indent` columns.
void print(const std::string& text, std::size_t indent) {
  std::size_t column = indent;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (column + (end - begin) > kWidth) {
      std::cout << '\n' << std::string(indent, ' ');
      column = indent;
    }
    std::cout << (column > indent ? " " : "") << text.substr(begin, end - begin);
    column += end - begin + 1;
    begin = end + 1;
  }
  std::cout << '\n';
}

std::string defaultText(const Setting& setting, const void* owner) {
  return hasDefault(setting, owner) ? "; " + textOf(setting, owner) + " where not given" : std::string();
}

void printSettings(const SettingsView& view) {
  std::cout << '\n' << view.owner << '\n';
  for (const Setting& setting : view.settings) {
    std::cout << "  --" << setting.flag << " (" << rangeOf(setting) << defaultText(setting, view.values)
              << ")\n      ";
    print(setting.help, 6);
  }
}

void printReference() {
  std::cout << kReferenceName << "\n  " << kReferenceSummary << '\n';
  ReferenceChoices choices;
  printSettings({"Reference", referenceSettings(), &choices});
}

void printTechnique(const std::string& name) {
  if (name == kReferenceName) return printReference();
  const TechniqueInfo& info = techniqueNamed(name);
  std::cout << info.name << "\n  ";
  print(info.summary, 2);
  PictureSettings settings;
  settings.technique.technique = name;
  for (const SettingsView& view : usedSettings(settings)) printSettings(view);
  std::cout << "\nLeft out, compared with the reference\n";
  for (const Omission& omission : info.omissions) {
    std::cout << "  - ";
    print(omission.what, 4);
  }
}

void printList() {
  std::cout << "Techniques, for --technique; `nephroid help NAME` shows the settings of one\n";
  for (const TechniqueInfo* info : techniques()) {
    std::cout << "  " << info->name << "\n      ";
    print(info->summary, 6);
  }
  std::cout << "  " << kReferenceName << "\n      " << kReferenceSummary << '\n';
  std::cout << "\n`nephroid COMMAND --help` tells what a command takes.\n";
}

}  // namespace

Command addHelp(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("help", "Lists the techniques, or shows the settings and limits of one");
  const auto name = std::make_shared<std::string>();
  const std::vector<std::string> names = techniqueList();
  command->add_option("TECHNIQUE", *name, "The technique: " + joined(names))
      ->check(oneOf(names))
      ->type_name("");
  return {command, [name] { name->empty() ? printList() : printTechnique(*name); }};
}

}  // namespace nephroid
