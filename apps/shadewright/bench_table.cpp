#include "bench_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadewright::app {

std::string to_markdown(const std::vector<BenchTable>& tables) {
  std::string text;
  for (const BenchTable& table : tables) {
    std::vector<size_t> widths;
    for (const std::string& column : table.columns) widths.push_back(column.size());
    for (const auto& row : table.rows)
      for (size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    const auto line = [&](const std::vector<std::string>& cells) {
      for (size_t c = 0; c < cells.size(); ++c) text += fmt::format("| {:<{}} ", cells[c], widths[c]);
      text += "|\n";
    };
    text += fmt::format("## {}\n\n{}\n\n", table.title, table.note);
    line(table.columns);
    for (const size_t width : widths) text += fmt::format("|{:-<{}}", "", width + 2);
    text += "|\n";
    for (const auto& row : table.rows) line(row);
    text += "\n";
    for (const auto& picture : table.pictures)
      text += fmt::format("![{}]({}) {}\n\n", picture.caption, picture.file, picture.caption);
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<BenchTable>& tables) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const BenchTable& table : tables) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const auto& row : table.rows) {
      nlohmann::ordered_json object;
      for (size_t c = 0; c < row.size(); ++c) object[table.columns[c]] = row[c];
      rows.push_back(object);
    }
    nlohmann::ordered_json pictures = nlohmann::ordered_json::array();
    for (const auto& picture : table.pictures)
      pictures.push_back({{"caption", picture.caption}, {"file", picture.file}});
    json.push_back({{"title", table.title}, {"note", table.note}, {"rows", rows}, {"pictures", pictures}});
  }
  return json;
}

}  // namespace shadewright::app
