# cmake -DPAGE=FILE.html -DOUTPUT=FILE.cpp -P embed_page.cmake
# Makes one text of a page: its local style sheets and scripts take the place of the elements that refer to them, so that in the
# source they are files of their own. The text is written as a C++ array of bytes, since compilers limit string literals.
cmake_minimum_required(VERSION 3.25)
get_filename_component(folder "${PAGE}" DIRECTORY)
file(READ "${PAGE}" text)

string(REGEX MATCHALL "<link rel=\"stylesheet\" href=\"[a-z_.]+\">|<script src=\"[a-z_.]+\"></script>" elements "${text}")
foreach(element IN LISTS elements)
  string(REGEX REPLACE ".*(href|src)=\"([a-z_.]+)\".*" "\\2" name "${element}")
  file(READ "${folder}/${name}" content)
  if(element MATCHES "^<link")
    string(REPLACE "${element}" "<style>\n${content}</style>" text "${text}")
  else()
    string(REPLACE "${element}" "<script>\n${content}</script>" text "${text}")
  endif()
endforeach()

# By way of a file: the only way CMake has to the bytes of a text.
file(WRITE "${OUTPUT}.html" "${text}")
file(READ "${OUTPUT}.html" bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
file(WRITE "${OUTPUT}" "#include \"compare/page.h\"
namespace shadewright::compare {
namespace {
constexpr char bytes[] = {${bytes}};
}
const std::string_view page(bytes, sizeof(bytes));
}
")
