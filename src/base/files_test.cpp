#include "shadewright/files.h"

#include <gtest/gtest.h>

#include <iterator>
#include <set>
#include <stdexcept>

#include "base/temporary_folder_for_test.h"
#include "shadewright/error.h"

namespace shadewright {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

void write_page_and_frame(const fs::path& folder) {
  write_file(folder / "page", std::string_view("new"));
  fs::create_directory(folder / "frames");
  write_file(folder / "frames" / "0", std::string_view("new"));
}

TEST(Files, AFolderIsMadeHoweverItIsWritten) {
  for (const char* name : {"out", "out/", "a/b/out", "./out", "."}) {
    const TemporaryFolder outer;
    const fs::path folder = outer.path() / name;
    write_folder(folder, write_page_and_frame);
    EXPECT_EQ(names_in(folder), (std::set<std::string>{"frames", "page"})) << name;
    EXPECT_EQ(names_in(outer.path()).size(), std::string(name) == "." ? 2 : 1) << name;
  }
}

TEST(Files, AFolderKeepsWhatIsNotReplaced) {
  const TemporaryFolder folder;
  folder.write("page", "old");
  folder.write("notes", "old");
  fs::create_directory(folder.path() / "frames");
  folder.write("frames/1", "old");
  write_folder(folder.path(), write_page_and_frame);
  EXPECT_EQ(content(folder.file("page")), "new");
  EXPECT_EQ(content(folder.file("notes")), "old");
  EXPECT_EQ(names_in(folder.path() / "frames"), std::set<std::string>{"0"});
}

TEST(Files, WhatStandsBesideIsNotTouched) {
  const TemporaryFolder outer;
  fs::create_directory(outer.path() / "out.part");
  outer.write("out.part/thesis", "mine");
  outer.write("page.part", "mine");
  outer.write("page.part-2", "mine");
  write_folder(outer.path() / "out", write_page_and_frame);
  write_file(outer.path() / "page", std::string_view("new"));
  EXPECT_EQ(content(outer.file("out.part/thesis")), "mine");
  EXPECT_EQ(content(outer.file("page.part")), "mine");
  EXPECT_EQ(content(outer.file("page.part-2")), "mine");
  EXPECT_EQ(content(outer.file("page")), "new");
  EXPECT_EQ(names_in(outer.path()), (std::set<std::string>{"out", "out.part", "page", "page.part", "page.part-2"}));
}

TEST(Files, AFolderIsLeftAloneWhenWritingFails) {
  const TemporaryFolder outer;
  const auto fail = [](const fs::path& folder) {
    write_page_and_frame(folder);
    throw std::runtime_error("out of ink");
  };
  EXPECT_THROW(write_folder(outer.path() / "a/b", fail), std::runtime_error);
  EXPECT_TRUE(names_in(outer.path()).empty());
  outer.write("page", "old");
  EXPECT_THROW(write_folder(outer.path(), fail), std::runtime_error);
  EXPECT_EQ(names_in(outer.path()), std::set<std::string>{"page"});
  EXPECT_EQ(content(outer.file("page")), "old");
}

TEST(Files, AFolderThatCannotBeMadeIsRefusedBeforeTheWork) {
  const TemporaryFolder outer;
  outer.write("file", "old");
  for (const char* name : {"file", "file/out", "file/"}) {
    try {
      write_folder(outer.path() / name, [](const fs::path&) { ADD_FAILURE() << "the work was begun"; });
      ADD_FAILURE() << name << " was made";
    } catch (const FailureError& error) {
      EXPECT_NE(std::string(error.what()).find(outer.file("file")), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(content(outer.file("file")), "old");
}

}  // namespace
}  // namespace shadewright
