// shadewright: the command line. Verbs are in files of their own; here errors become one sentence and an exit code.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>

#include "interrupt.h"
#include "shadewright/error.h"
#include "shadewright/files.h"
#include "verbs.h"

namespace {

int fail(const std::string& sentence, int code) {
  fmt::print(stderr, "shadewright: {}\n", sentence);
  return code;
}

/// What is wrong with the first word, where a verb must stand; empty if nothing is. (CLI11 would speak of subcommands.)
std::string wrong_verb(const CLI::App& app, std::string_view word) {
  if (word.empty()) return "no verb is given; see shadewright --help";
  const auto named = [&](const CLI::App* verb) { return verb->get_name() == word; };
  if (app.get_option_no_throw(std::string(word)) || !app.get_subcommands(named).empty()) return "";
  return fmt::format("'{}' is not a verb; see shadewright --help", word);
}

/// Parses and runs. Whatever was printed is flushed.
void run(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    app.exit(help);
  }
  std::cout.flush();
  shadewright::write_standard_output(std::string_view());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Correct hard shadows: shadow techniques held against ray tracing.", "shadewright");
  app.require_subcommand(1);
  app.set_version_flag("--version", "shadewright 0.1.0");
  shadewright::app::add_render(app);
  shadewright::app::add_compare(app);
  shadewright::app::add_scenes(app);
  shadewright::app::add_bake(app);
  shadewright::app::add_bench(app);
  shadewright::app::add_info(app);
  shadewright::app::add_query(app);
  shadewright::app::add_devices(app);
  shadewright::app::add_view(app);
  const std::string_view verb = argc > 1 ? argv[1] : "";
  if (const std::string problem = wrong_verb(app, verb); !problem.empty()) return fail(problem, 2);
  try {
    run(app, argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    return fail(fmt::format("{}; see shadewright {} --help", error.what(), verb), 2);
  } catch (const shadewright::InputError& error) {
    return fail(error.what(), 2);
  } catch (const shadewright::app::Interrupted& interrupted) {
    return fail("interrupted; " + interrupted.left, 130);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; use a smaller scene or image", 1);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
