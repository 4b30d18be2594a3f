#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>

#include "command.h"
#include "core/atomic_file.h"
#include "papers/paper_tables.h"

namespace nephroid {
namespace {

struct BenchOptions {
  std::vector<std::string> names;
  std::filesystem::path json;
  PaperBench bench;
  bool isQuiet = false;
};

void runBench(const BenchOptions& options) {
  if (!options.json.empty()) checkOutput(options.json, {});
  if (!options.bench.curves.empty()) checkOutput(options.bench.curves, {}, {".svg"});
  Progress progress(progressDisplay(options.isQuiet));
  std::vector<PaperTable> tables;
  std::vector<std::string> names;
  for (const std::string& name : options.names)
    std::ranges::copy(paperTablesNamed(name), std::back_inserter(names));
  for (const std::string& name : options.names.empty() ? paperTableNames() : names) {
    tables.push_back(measurePaperTable(name, options.bench, progress));
    std::cout << describe(tables.back()) << std::flush;
  }
  if (!options.json.empty()) writeFileAtomically(options.json, paperTablesJson(tables));
}

}  // namespace

Command addBench(CLI::App& program) {
  CLI::App* command = program.add_subcommand("bench",
                                             "Measures the papers' tables on this machine, beside the "
                                             "papers' own figures, and those of adaptive-beams");
  const auto options = std::make_shared<BenchOptions>();
  std::vector<std::string> known = paperTableNames();
  std::ranges::move(paperTableGroups(), std::back_inserter(known));
  command
      ->add_option("NAME", options->names,
                   "The tables: " + joined(paperTableNames()) + "; " + joined(paperTableGroups()) +
                       " is all whose names begin with it. Without a name: all")
      ->check(oneOf(known))
      ->type_name("");
  command->add_option("--json", options->json, "Where to write the figures as JSON, too")->type_name("FILE");
  command
      ->add_option("--scenes", options->bench.scenes,
                   "The folder of the scenes, with those of counted light in truth/. Without it: scenes/ of "
                   "the source tree that holds the "
                   "program, or the installed scenes")
      ->type_name("DIR");
  command
      ->add_option("--curves", options->bench.curves,
                   "Where to write a chart of paper-4 as SVG: error and time by the number of planes")
      ->type_name("FILE.svg");
  addDevice(*command, options->bench.device);
  addQuiet(*command, options->isQuiet);
  return {command, [options] { runBench(*options); }};
}

}  // namespace nephroid
