#include <gtest/gtest.h>

#include "compare/report_fixture.h"

namespace shadewright::compare {
namespace {

/// RFC 4180, read strictly: rows of fields.
std::vector<std::vector<std::string>> parse(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    std::string& field = rows.back().back();
    if (quoted) {
      if (text[i] != '"') {
        field += text[i];
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        field += text[i++];
      } else {
        quoted = false;
      }
    } else if (text[i] == '"') {
      quoted = true;
    } else if (text[i] == ',') {
      rows.back().emplace_back();
    } else if (text.compare(i, 2, "\r\n") == 0) {
      rows.push_back({""});
      ++i;
    } else {
      field += text[i];
    }
  }
  rows.pop_back();
  return rows;
}

std::string cell(const std::vector<std::vector<std::string>>& rows, size_t row, const std::string& column) {
  for (size_t c = 0; c < rows[0].size(); ++c)
    if (rows[0][c] == column) return rows[row][c];
  return "no column " + column;
}

TEST(ReportCsv, OneRowAResultUnderAHeader) {
  const auto rows = parse(to_csv(example_report()));
  ASSERT_EQ(rows.size(), 3u);
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_EQ(rows[0][0], "scene");
  EXPECT_EQ(cell(rows, 1, "technique"), "sm@2048");
  EXPECT_EQ(cell(rows, 1, "fraction"), "0.1");
  EXPECT_EQ(cell(rows, 1, "oracle_fraction"), "");
  EXPECT_EQ(cell(rows, 2, "oracle_fraction"), "0.0005");
  EXPECT_EQ(cell(rows, 2, "milliseconds"), "1.5");
  EXPECT_EQ(cell(rows, 2, "stage look-up"), "0.5");
  EXPECT_EQ(cell(rows, 1, "counter effective_resolution"), "");
  EXPECT_EQ(cell(rows, 2, "counter effective_resolution"), "4096 2048");
}

TEST(ReportCsv, CommasQuotesAndLineBreaksAreQuoted) {
  Report report = example_report();
  report.scene_name = "a \"great\", big\r\nscene";
  report.results[0].technique = "perspective@1024,warp=lispsm";
  const std::string text = to_csv(report);
  EXPECT_NE(text.find("\"a \"\"great\"\", big\r\nscene\","), std::string::npos);
  const auto rows = parse(text);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(cell(rows, 1, "scene"), report.scene_name);
  EXPECT_EQ(cell(rows, 1, "technique"), report.results[0].technique);
}

TEST(ReportCsv, NoResultsIsTheHeaderAlone) {
  const auto rows = parse(to_csv(Report{}));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].back(), "memory_bytes");
}

}  // namespace
}  // namespace shadewright::compare
