// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/token_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::daemon {
namespace {

using std::filesystem::perms;

TEST(TokenFile, IsMadeOnceForItsOwnerAlone) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / ".token";
  const std::string token = loadOrCreateToken(file);
  EXPECT_EQ(token.size(), 64U);
  EXPECT_EQ(std::filesystem::status(file).permissions(), perms::owner_read | perms::owner_write);
  EXPECT_EQ(loadOrCreateToken(file), token);
  EXPECT_NE(loadOrCreateToken(folder.path() / "other"), token);
}

TEST(TokenFile, IsRefusedIfOthersCanReadOrWriteIt) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("token", "0123456789abcdef0123\n");
  for (const perms others : {perms::group_read, perms::others_read, perms::group_write, perms::others_write}) {
    std::filesystem::permissions(file, perms::owner_read | others);
    test::expectError(base::ErrorCode::kInput, {file.string(), "chmod 600"}, [&] { (void)loadOrCreateToken(file); });
  }
  std::filesystem::permissions(file, perms::owner_read);
  EXPECT_EQ(loadOrCreateToken(file), "0123456789abcdef0123");
}

TEST(TokenFile, IsRefusedIfItHoldsNoTokenOrCannotBeMade) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("token", "\n0123456789abcdef0123");
  std::filesystem::permissions(file, perms::owner_read);
  test::expectError(base::ErrorCode::kInput, {file.string(), "at least 16"}, [&] { (void)loadOrCreateToken(file); });
  test::expectError(base::ErrorCode::kIo, {"nowhere"}, [&] { (void)loadOrCreateToken(folder.path() / "nowhere" / "token"); });
}

TEST(TokenFile, ComparesWholeTexts) {
  EXPECT_TRUE(equalInConstantTime("", ""));
  EXPECT_TRUE(equalInConstantTime("abc", "abc"));
  EXPECT_FALSE(equalInConstantTime("abc", "abd"));
  EXPECT_FALSE(equalInConstantTime("abcabc", "abc"));
  EXPECT_FALSE(equalInConstantTime("abc", "abcabc"));
  EXPECT_FALSE(equalInConstantTime("abc", ""));
  EXPECT_FALSE(equalInConstantTime("", "abc"));
}

}  // namespace
}  // namespace oikos::daemon
