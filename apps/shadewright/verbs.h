// The verbs of the command line: each adds its subcommand with what it runs.
#pragma once

namespace CLI {
class App;
}

namespace shadewright::app {

void add_render(CLI::App& app);
void add_compare(CLI::App& app);
void add_scenes(CLI::App& app);
void add_devices(CLI::App& app);
void add_bake(CLI::App& app);
void add_bench(CLI::App& app);
void add_info(CLI::App& app);
void add_query(CLI::App& app);
void add_view(CLI::App& app);

}  // namespace shadewright::app
