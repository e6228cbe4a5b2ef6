// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/evidence_folder.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

TEST(IsEvidencePath, OnlyWhatStaysBelowEvidence) {
  for (const char* path : {"evidence/a.jpg", "evidence/monday/a.jpg", "evidence/..a"}) {
    EXPECT_TRUE(isEvidencePath(path)) << path;
  }
  for (const std::string path : {"", "evidence", "evidence/", "evidence/a/", "home.xml", "/evidence/a.jpg", "evidence/../home.xml",
                                 "./evidence/a.jpg", "evidence/./a.jpg", "../evidence/a.jpg", "evidence2/a.jpg"}) {
    EXPECT_FALSE(isEvidencePath(path)) << path;
  }
  EXPECT_FALSE(isEvidencePath(std::string("evidence/a\0b", 12)));
}

TEST(EvidenceFolder, RemovesFilesAndNothingElse) {
  const test::TemporaryFolder home;
  const test::TemporaryFolder elsewhere;
  const auto secret = elsewhere.write("secret.jpg", "x");
  (void)home.write("evidence/monday/a.jpg", "x");
  (void)home.write("home.xml", "x");
  std::filesystem::create_symlink(secret, home.path() / "evidence/link.jpg");
  std::filesystem::create_directory_symlink(elsewhere.path(), home.path() / "evidence/folder");
  const EvidenceFolder folder(home.path());
  using Image = EvidenceFolder::Image;
  EXPECT_EQ(folder.look("evidence/monday/a.jpg"), Image::kFile);
  EXPECT_EQ(folder.remove("evidence/monday/a.jpg"), Image::kFile);
  EXPECT_FALSE(std::filesystem::exists(home.path() / "evidence/monday/a.jpg"));
  EXPECT_EQ(folder.remove("evidence/monday/a.jpg"), Image::kMissing);
  EXPECT_EQ(folder.remove("evidence/tuesday/a.jpg"), Image::kMissing);
  for (const char* path : {"evidence/link.jpg", "evidence/folder/secret.jpg", "evidence/monday", "evidence/../home.xml"}) {
    EXPECT_EQ(folder.look(path), Image::kOther) << path;
    EXPECT_EQ(folder.remove(path), Image::kOther) << path;
  }
  EXPECT_TRUE(std::filesystem::exists(secret));
  EXPECT_TRUE(std::filesystem::exists(home.path() / "home.xml"));
}

TEST(EvidenceFolder, ItselfIsNoLink) {
  const test::TemporaryFolder home;
  const test::TemporaryFolder elsewhere;
  const auto secret = elsewhere.write("secret.jpg", "x");
  std::filesystem::create_directory_symlink(elsewhere.path(), home.path() / "evidence");
  EXPECT_EQ(EvidenceFolder(home.path()).remove("evidence/secret.jpg"), EvidenceFolder::Image::kOther);
  EXPECT_TRUE(std::filesystem::exists(secret));
}

}  // namespace
}  // namespace oikos::semantic
