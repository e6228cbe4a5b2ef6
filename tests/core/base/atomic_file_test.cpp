// SPDX-License-Identifier: Apache-2.0
#include "core/base/atomic_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <string>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace oikos::base {
namespace {

std::ptrdiff_t countFiles(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

TEST(AtomicFile, CreatesAndReplacesAndLeavesNothingBeside) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "report.json";
  writeFileAtomically(file, "one");
  EXPECT_EQ(readFile(file), "one");
  writeFileAtomically(file, std::string("two\0two", 7));
  EXPECT_EQ(readFile(file), std::string("two\0two", 7));
  EXPECT_EQ(countFiles(folder.path()), 1);
}

TEST(AtomicFile, FullDiskLeavesTheOldContent) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("report.json", "old");
  {
    const test::FileSizeLimit limit(1000);
    EXPECT_THROW(writeFileAtomically(file, std::string(5000, 'x')), Error);
  }
  EXPECT_EQ(readFile(file), "old");
  EXPECT_EQ(countFiles(folder.path()), 1);
}

TEST(AtomicFile, NamesTheFolderThatDoesNotExist) {
  try {
    writeFileAtomically("/no/such/folder/report.json", "x");
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kIo);
    EXPECT_NE(std::string(error.what()).find("/no/such/folder/"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos) << error.what();
  }
}

TEST(AtomicFile, FolderInItsPlaceIsAnError) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "taken");
  EXPECT_THROW(writeFileAtomically(folder.path() / "taken", "x"), Error);
  EXPECT_EQ(countFiles(folder.path()), 1);
}

TEST(TextFile, SaysWhyItCannotBeRead) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(readFile(folder.path()), Error);
  EXPECT_THROW(readFile(folder.path() / "missing"), Error);
}

}  // namespace
}  // namespace oikos::base
