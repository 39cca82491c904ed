// shadewright: the command line. Verbs are in files of their own; here errors become one sentence and an exit code.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>

#include "interrupt.h"
#include "shadewright/error.h"
#include "verbs.h"

namespace {

/// The verbs of the contract that are not there yet are refused by name, instead of being unknown words.
constexpr const char* later_verbs[] = {"view"};

int fail(const std::string& sentence, int code) {
  fmt::print(stderr, "shadewright: {}\n", sentence);
  return code;
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
  if (argc > 1)
    for (const char* verb : later_verbs)
      if (std::string_view(argv[1]) == verb)
        return fail(fmt::format("'{}' is not built yet; see shadewright --help for what is", verb), 2);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(
        fmt::format("{}; see shadewright {} --help", error.what(), argc > 1 && argv[1][0] != '-' ? argv[1] : ""), 2);
  } catch (const shadewright::InputError& error) {
    return fail(error.what(), 2);
  } catch (const shadewright::app::Interrupted&) {
    return fail("interrupted; nothing was written", 130);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; use a smaller scene or image", 1);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
