// SPDX-License-Identifier: Apache-2.0
#include "core/base/replace_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/posix_file.h"
#include "core/base/read_file.h"
#include "tests/support/file_calls.h"
#include "tests/support/temporary_folder.h"

namespace oikos::base {
namespace {

class ReplaceFileTest : public testing::Test {
 protected:
  ~ReplaceFileTest() override {
    const std::filesystem::directory_iterator files(folder_.path());
    EXPECT_EQ(std::distance(files, std::filesystem::directory_iterator()), 1);  // nothing is left beside it
  }
  [[nodiscard]] std::string text() const { return readFile(file_); }
  [[nodiscard]] bool replace() const { return replaceFileIfUnchanged(file_, "old", "new"); }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.write("home.xml", "old");
};

TEST_F(ReplaceFileTest, ReplacesWhatIsAsExpectedOnly) {
  EXPECT_FALSE(replaceFileIfUnchanged(file_, "other", "new"));
  EXPECT_EQ(text(), "old");
  EXPECT_TRUE(replace());
  EXPECT_EQ(text(), "new");
}

TEST_F(ReplaceFileTest, ALateEditByNameIsKept) {
  const test::RenameHook hook(file_, [&] {
    if (text() == "old") {
      writeFileAtomically(file_, "edited");
    }
    return 0;
  });
  EXPECT_FALSE(replace());
  EXPECT_EQ(text(), "edited");
}

TEST_F(ReplaceFileTest, ALateEditIntoTheFileIsKept) {
  const test::RenameHook hook(file_, [&] {
    if (text() == "old") {
      (void)folder_.write("home.xml", "edited in place");
    }
    return 0;
  });
  EXPECT_FALSE(replace());
  EXPECT_EQ(text(), "edited in place");
}

TEST_F(ReplaceFileTest, OfSeveralLateEditsTheLastIsKept) {
  std::vector<std::string> edits{"fourth", "third", "second", "first"};
  const test::RenameHook hook(file_, [&] {
    if (!edits.empty()) {
      writeFileAtomically(file_, edits.back());
      edits.pop_back();
    }
    return 0;
  });
  EXPECT_FALSE(replace());
  EXPECT_EQ(text(), "fourth");
}

TEST_F(ReplaceFileTest, WhatSomebodyIsAboutToWriteIntoIsLeftToHim) {
  const FileDescriptor writer = openFile(file_, O_WRONLY);
  EXPECT_FALSE(replace());
  ASSERT_EQ(::pwrite(writer.number(), "his", 3, 0), 3);
  EXPECT_EQ(text(), "his");
}

TEST_F(ReplaceFileTest, WhereFilesCannotBeExchangedItIsRenamed) {
  int calls = 0;
  const test::RenameHook hook(file_, [&] { return ++calls == 1 ? EINVAL : 0; });
  EXPECT_TRUE(replace());
  EXPECT_EQ(text(), "new");
}

TEST_F(ReplaceFileTest, AFailureLeavesTheFile) {
  const test::RenameHook hook(file_, [] { return EIO; });
  EXPECT_THROW((void)replace(), Error);
  EXPECT_EQ(text(), "old");
}

}  // namespace
}  // namespace oikos::base
