#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "base/temporary_folder_for_test.h"
#include "compare/report_fixture.h"
#include "shadewright/error.h"
#include "shadewright/image/picture.h"

namespace shadewright::compare {
namespace {

using Json = nlohmann::ordered_json;

/// A report whose pictures are in `folder`: 40 x 30, the technique's differ from the truth's in one pixel.
Report report_with_pictures(const TemporaryFolder& folder) {
  Report report = example_report();
  Picture truth{40, 30, {}};
  for (uint32_t i = 0; i < 1200; ++i) truth.pixels.emplace_back(i * 7 % 256, i * 13 % 256, i * 29 % 256, 255);
  Picture answer = truth;
  answer.pixels[77] = glm::u8vec4(255, 255, 255, 255);
  Picture difference{40, 30, std::vector<glm::u8vec4>(1200, glm::u8vec4(0))};
  difference.pixels[77] = glm::u8vec4(255, 0, 0, 255);
  write_png(truth, folder.file("truth.png"));
  write_png(truth, folder.file("truth_mask.png"));
  write_png(answer, folder.file("rtw.png"));
  write_png(answer, folder.file("rtw_mask.png"));
  write_png(difference, folder.file("rtw_difference.png"));
  return report;
}

Json data(const std::string& html) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const size_t begin = html.find(open) + open.size();
  return Json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

std::vector<uint8_t> from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<uint8_t> bytes;
  uint32_t bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<uint32_t>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<uint8_t>(bits >> count));
  }
  return bytes;
}

TEST(ReportHtml, HoldsTheReportAndItsPictures) {
  const TemporaryFolder folder;
  const Report report = report_with_pictures(folder);
  const Json json = data(to_html(report, folder.path()));
  EXPECT_EQ(json["report"], Json::parse(to_json(report)));
  EXPECT_TRUE(json["changes"].is_null());
  ASSERT_EQ(json["pictures"]["results"].size(), 2u);
  EXPECT_TRUE(json["pictures"]["results"][0]["image"].is_null());
  EXPECT_EQ(json["pictures"]["truth"]["image"]["over_truth"], false);

  const Json& image = json["pictures"]["results"][1]["image"];
  EXPECT_EQ(image["over_truth"], true);
  const std::string uri = image["uri"], head = "data:image/png;base64,";
  ASSERT_TRUE(uri.starts_with(head));
  const auto bytes = from_base64(uri.substr(head.size()));
  folder.write("embedded.png", std::string(bytes.begin(), bytes.end()));
  const Picture embedded = read_png(folder.path() / "embedded.png");
  EXPECT_EQ(embedded.pixels[76], glm::u8vec4(0));
  EXPECT_EQ(embedded.pixels[77], glm::u8vec4(255));
}

TEST(ReportHtml, RefersToNothingOutside) {
  const TemporaryFolder folder;
  std::string html = to_html(report_with_pictures(folder), folder.path());
  for (const char* mark : {"src=\"", "href=\"", "@import", "url(", "fetch(", "{{title}}", "{{data}}"})
    EXPECT_EQ(html.find(mark), std::string::npos) << mark;
  html = std::regex_replace(html, std::regex("http://www\\.w3\\.org/2000/svg"), "");
  EXPECT_EQ(html.find("http://"), std::string::npos);
  EXPECT_EQ(html.find("https://"), std::string::npos);
}

TEST(ReportHtml, NamesAreNeverMarkup) {
  const TemporaryFolder folder;
  Report report = report_with_pictures(folder);
  const std::string attack = "</script><script>alert(1)</script><!--<img src=x onerror=alert(1)>&";
  report.scene_name = report.device_name = report.results[0].technique = attack;
  report.results[0].counters[attack] = {1};
  report.notes = {attack};
  const std::string html = to_html(report, folder.path(), &report);
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("<img"), std::string::npos);
  EXPECT_NE(html.find("<title>&lt;/script&gt;"), std::string::npos);
  EXPECT_EQ(data(html)["report"]["notes"][0], attack);
}

TEST(ReportHtml, ChangesAreIndicesIntoBothReports) {
  const TemporaryFolder folder;
  const Report report = report_with_pictures(folder);
  Report before = example_report();
  before.device_name = "another";
  before.results = {report.results[1], example_result("gone", "paged@32768", 5)};
  const Json changes = data(to_html(report, folder.path(), &before))["changes"];
  EXPECT_EQ(changes["pairs"], Json::parse(R"([{"before": null, "after": 0}, {"before": 0, "after": 1},
                                              {"before": 1, "after": null}])"));
  EXPECT_EQ(changes["conditions"].size(), 1u);
}

TEST(ReportHtml, IsTheSameEveryTime) {
  const TemporaryFolder folder;
  const Report report = report_with_pictures(folder);
  EXPECT_EQ(to_html(report, folder.path()), to_html(report, folder.path()));
}

TEST(ReportHtml, AnEmptyReportIsAPage) {
  const std::string html = to_html(Report{}, ".");
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(data(html)["pictures"]["truth"]["image"].is_null());
}

TEST(ReportHtml, AMissingPictureIsNamed) {
  const TemporaryFolder folder;
  const Report report = report_with_pictures(folder);
  std::filesystem::remove(folder.path() / "rtw_mask.png");
  EXPECT_THROW(to_html(report, folder.path()), InputError);
}

}  // namespace
}  // namespace shadewright::compare
