// The program roam-bench, which `roam bench` starts. It links other people's engines; roam does not.
#include <CLI/CLI.hpp>
#include <string_view>

#include "bench_verbs.h"
#include "cli/command_line.h"
#include "row_process.h"

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == roam::bench::row_verb) return roam::bench::row_main(argc, argv);
  // The user typed `roam bench ...`, so messages use that name.
  CLI::App program{"roam bench: roam measured beside other engines.", "roam bench"};
  program.footer(
      "`roam bench VERB --help` explains a verb, with examples.\n\n"
      "Exit status: 0 done; 1 failed, the message says what, where and what to do; 2 wrong usage; 3 roam was wrong.\n");
  program.require_subcommand(1);
  roam::app::Run chosen;
  roam::bench::add_engines(program, chosen);
  roam::bench::add_paper(program, chosen);
  roam::bench::add_scale(program, chosen);
  roam::bench::add_labels(program, chosen);
  roam::bench::add_walkers(program, chosen);
  return roam::app::run_command_line(program, chosen, argc, argv);
}
