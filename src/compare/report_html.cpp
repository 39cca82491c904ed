// The report as one HTML page. page/ holds the page itself, assembled into one text by the build (embed_page.cmake);
// here its title and its data are filled in: the reports as JSON, and the pictures as data URIs. A technique's picture
// is mostly the truth's, so that only the pixels that differ are embedded: the page lays them over the truth.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "compare/changes.h"
#include "compare/delta.h"
#include "compare/page.h"
#include "shadewright/compare/report.h"
#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = std::vector<uint8_t>;

std::string base64(const Bytes& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

Bytes read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Bytes bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.good() && !file.eof()) throw InputError(path.string(), "cannot be read");
  return bytes;
}

/// One picture of the report on its way into the page.
struct Embedded {
  std::filesystem::path path;
  const Picture* base = nullptr;  ///< the truth's picture of the same kind, if there is one
  Bytes bytes;
  bool over_base = false;

  void encode() {
    const Picture picture = read_png(path);
    bytes = read_bytes(path);
    if (base == nullptr || !has_delta(picture, *base)) return;
    Bytes difference = encode_png(delta(picture, *base));
    if (difference.size() >= bytes.size()) return;
    bytes = std::move(difference);
    over_base = true;
  }

  Json json() const {
    if (path.empty()) return nullptr;
    return {{"uri", "data:image/png;base64," + base64(bytes)}, {"over_truth", over_base}};
  }
};

Json pictures_json(const Report& report, const std::filesystem::path& folder) {
  Picture truth_image, truth_mask;
  std::vector<Embedded> pictures;
  const auto add = [&](const std::string& name, const Picture* base) {
    pictures.push_back({name.empty() ? std::filesystem::path() : folder / name, base, {}, false});
  };
  add(report.reference_image, nullptr);
  add(report.reference_mask, nullptr);
  if (!report.reference_image.empty()) truth_image = read_png(folder / report.reference_image);
  if (!report.reference_mask.empty()) truth_mask = read_png(folder / report.reference_mask);
  for (const TechniqueResult& result : report.results) {
    add(result.image, report.reference_image.empty() ? nullptr : &truth_image);
    add(result.mask, report.reference_mask.empty() ? nullptr : &truth_mask);
    add(result.difference, nullptr);
  }
  tbb::parallel_for(size_t{0}, pictures.size(), [&](size_t i) {
    if (!pictures[i].path.empty()) pictures[i].encode();
  });

  Json results = Json::array();
  for (size_t i = 2; i < pictures.size(); i += 3)
    results.push_back(
        {{"image", pictures[i].json()}, {"mask", pictures[i + 1].json()}, {"difference", pictures[i + 2].json()}});
  return {{"truth", {{"image", pictures[0].json()}, {"mask", pictures[1].json()}}}, {"results", results}};
}

Json changes_json(const Report& before, const Report& after) {
  const auto index = [](const TechniqueResult* result, const Report& report) {
    return result == nullptr ? Json(nullptr) : Json(result - report.results.data());
  };
  Json pairs = Json::array();
  for (const Change& change : pair_results(before, after))
    pairs.push_back({{"before", index(change.before, before)}, {"after", index(change.after, after)}});
  return {
      {"before", Json::parse(to_json(before))}, {"pairs", pairs}, {"conditions", changed_conditions(before, after)}};
}

// Nothing in a string may end the script element that holds the data, or start a comment in it.
std::string script_safe(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<' || c == '>' || c == '&') {
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      text += c;
    }
  }
  return text;
}

std::string html_safe(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

/// `page` with each of `values` in the place of its mark; marks stand in the page once, in this order.
std::string fill(std::string_view page, const std::vector<std::pair<std::string_view, std::string>>& values) {
  std::string text;
  for (const auto& [mark, value] : values) {
    const size_t at = page.find(mark);
    text += page.substr(0, at);
    text += value;
    page.remove_prefix(at + mark.size());
  }
  return text += page;
}

}  // namespace

std::string to_html(const Report& report, const std::filesystem::path& folder, const Report* before) {
  const Json data = {{"report", Json::parse(to_json(report))},
                     {"pictures", pictures_json(report, folder)},
                     {"changes", before == nullptr ? Json(nullptr) : changes_json(*before, report)}};
  const std::string json = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  const std::string name = data["report"]["scene"]["name"].get<std::string>();
  return fill(page, {{"{{title}}", html_safe(name)}, {"{{data}}", script_safe(json)}});
}

}  // namespace shadewright::compare
