// The page of report_html.cpp: src/compare/page/, assembled by embed_page.cmake.
#pragma once

#include <string_view>

namespace shadewright::compare {

extern const std::string_view page;

}  // namespace shadewright::compare
