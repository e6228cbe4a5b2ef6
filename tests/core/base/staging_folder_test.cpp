// SPDX-License-Identifier: Apache-2.0
#include "core/base/staging_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "tests/support/temporary_folder.h"

namespace oikos::base {
namespace {

namespace fs = std::filesystem;

TEST(StagingFolder, IsMadeAndRemoved) {
  const test::TemporaryFolder home;
  const fs::path path = home.path() / ".staging";
  {
    const StagingFolder staging(path);
    EXPECT_TRUE(fs::is_directory(path));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(StagingFolder, StaleContentOfAKilledRunIsRemoved) {
  const test::TemporaryFolder home;
  home.write(".staging/map/half.ply", "half");
  const StagingFolder staging(home.path() / ".staging");
  EXPECT_TRUE(fs::is_empty(staging.path()));
}

TEST(StagingFolder, SecondWriterIsRefusedUntilTheFirstEnds) {
  const test::TemporaryFolder home;
  const fs::path path = home.path() / ".staging";
  {
    const StagingFolder first(path);
    try {
      const StagingFolder second(path);
      FAIL() << "two writers were let in";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kIo);
      EXPECT_EQ(error.what(), home.path().string() + ": another process is writing here; wait until it has finished");
    }
    EXPECT_TRUE(fs::exists(path));
  }
  const StagingFolder third(path);
}

TEST(StagingFolder, MissingParentIsAnError) {
  EXPECT_THROW(StagingFolder("/no/such/home/.staging"), Error);
}

TEST(StagingFolder, FileInItsPlaceIsAnError) {
  const test::TemporaryFolder home;
  EXPECT_THROW(StagingFolder(home.write(".staging", "a file")), Error);
}

TEST(StagingFolder, DiscardWinsAgainstAThreadThatKeepsWriting) {
  const test::TemporaryFolder home;
  StagingFolder staging(home.path() / ".staging");
  std::atomic<bool> writing = true;
  std::atomic<int> written = 0;
  std::jthread writer([&] {
    for (int i = 0; writing; ++i) {
      std::ofstream(staging.path() / std::to_string(i % 100)) << i;
      ++written;
    }
  });
  while (written < 50) {
    std::this_thread::yield();
  }
  staging.discard();
  EXPECT_FALSE(fs::exists(staging.path()));
  writing = false;
}

TEST(PublishFolder, NewFolderAppears) {
  const test::TemporaryFolder home;
  const StagingFolder staging(home.path() / ".staging");
  home.write(".staging/map/grid.pgm", "new");
  syncTree(staging.path());
  publishFolder(staging.path() / "map", home.path() / "map");
  EXPECT_EQ(readFile(home.path() / "map/grid.pgm"), "new");
  EXPECT_FALSE(fs::exists(staging.path() / "map"));
}

TEST(PublishFolder, ExistingFolderChangesPlaces) {
  const test::TemporaryFolder home;
  home.write("map/grid.pgm", "old");
  home.write("map/only_in_old", "old");
  {
    const StagingFolder staging(home.path() / ".staging");
    home.write(".staging/map/grid.pgm", "new");
    publishFolder(staging.path() / "map", home.path() / "map");
    EXPECT_EQ(readFile(staging.path() / "map/grid.pgm"), "old");
  }
  EXPECT_EQ(readFile(home.path() / "map/grid.pgm"), "new");
  EXPECT_FALSE(fs::exists(home.path() / "map/only_in_old"));
  EXPECT_FALSE(fs::exists(home.path() / ".staging"));
}

TEST(PublishFolder, StagingFolderItselfMayBecomeTheTarget) {
  const test::TemporaryFolder parent;
  {
    const StagingFolder staging(parent.path() / ".home.staging");
    parent.write(".home.staging/home.xml", "<apartment/>");
    publishNewFolder(staging.path(), parent.path() / "home");
  }
  EXPECT_EQ(readFile(parent.path() / "home/home.xml"), "<apartment/>");
}

TEST(PublishNewFolder, DoesNotReplace) {
  const test::TemporaryFolder home;
  home.write("map/grid.pgm", "old");
  const StagingFolder staging(home.path() / ".staging");
  home.write(".staging/map/grid.pgm", "new");
  EXPECT_THROW(publishNewFolder(staging.path() / "map", home.path() / "map"), Error);
  EXPECT_EQ(readFile(home.path() / "map/grid.pgm"), "old");
}

TEST(PublishFolder, MissingParentOfTheTargetIsAnErrorAndKeepsTheStaged) {
  const test::TemporaryFolder home;
  const StagingFolder staging(home.path() / ".staging");
  home.write(".staging/map/grid.pgm", "new");
  EXPECT_THROW(publishFolder(staging.path() / "map", home.path() / "missing/map"), Error);
  EXPECT_EQ(readFile(staging.path() / "map/grid.pgm"), "new");
}

TEST(PublishFile, ReplacesAndCreates) {
  const test::TemporaryFolder home;
  const auto staged = home.write(".staging/home.xml", "new");
  home.write("home.xml", "old");
  publishFile(staged, home.path() / "home.xml");
  EXPECT_EQ(readFile(home.path() / "home.xml"), "new");
  EXPECT_FALSE(fs::exists(staged));
}

TEST(SyncTree, MissingFolderIsAnError) {
  EXPECT_ANY_THROW(syncTree("/no/such/folder"));
}

TEST(FolderOf, IgnoresASlashAtTheEnd) {
  EXPECT_EQ(folderOf("a/b"), "a");
  EXPECT_EQ(folderOf("a/b/"), "a");
  EXPECT_EQ(folderOf("b"), ".");
  EXPECT_EQ(folderOf("/b"), "/");
}

}  // namespace
}  // namespace oikos::base
