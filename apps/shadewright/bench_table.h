// A paper's table beside ours: printed, and written as Markdown and JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace shadewright::app {

struct BenchTable {
  std::string title;  ///< which table or figure of which paper
  std::string note;   ///< what is the same and what is not, one or two sentences
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  struct Picture {
    std::string caption, file;  ///< the file's name in the bench's folder
  };
  std::vector<Picture> pictures = {};
};

/// GitHub's Markdown, one section a table.
std::string to_markdown(const std::vector<BenchTable>& tables);
nlohmann::ordered_json to_json(const std::vector<BenchTable>& tables);

}  // namespace shadewright::app
