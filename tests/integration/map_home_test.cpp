// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "core/base/read_file.h"
#include "tests/integration/process.h"
#include "tests/integration/short_recording.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr int kFrames = 40;

/// The content of every file of a folder by its path; without `timing.json`, which may differ between two runs.
std::map<std::string, std::string> contentOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename() != "timing.json") {
      files[fs::relative(entry.path(), folder).string()] = base::readFile(entry.path());
    }
  }
  return files;
}

/// The names of files that differ: what a failing comparison of megabytes should print.
std::vector<std::string> differences(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b) {
  std::vector<std::string> names;
  for (const auto& [name, content] : a) {
    if (!b.contains(name) || b.at(name) != content) {
      names.push_back(name);
    }
  }
  for (const auto& [name, content] : b) {
    if (!a.contains(name)) {
      names.push_back(name);
    }
  }
  return names;
}

bool hasHiddenEntry(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with('.')) {
      return true;
    }
  }
  return false;
}

class MapHome : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto recording = findShortRecording(folder_, kFrames);
    if (!recording) {
      GTEST_SKIP() << "SKIPPED LOUDLY: OIKOS_DATA names no folder with the recording 'kitchen'; the home was not tested against kill -9, "
                      "Ctrl-C, a full disk and different thread counts";
    }
    recording_ = *recording;
    home_ = folder_.path() / "home";
  }

  [[nodiscard]] std::vector<std::string> command(const fs::path& home, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {oikosBinary(), "map", recording_.string(), "--out", home.string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  [[nodiscard]] ProcessResult map(const fs::path& home, const std::vector<std::string>& more = {}) const {
    return Process(command(home, more)).finish();
  }
  void mapOrFail(const fs::path& home, const std::vector<std::string>& more = {}) const {
    const ProcessResult result = map(home, more);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  /// Ends with the process stopped by a signal after it has begun to write.
  static void waitUntilStaged(Process& process, const fs::path& staged_map) {
    while (!fs::exists(staged_map)) {
      ASSERT_FALSE(process.hasEndedWithin(milliseconds(1))) << "ended before anything was staged";
    }
  }

  TemporaryFolder folder_;
  fs::path recording_;
  fs::path home_;
};

TEST_F(MapHome, NewHomeIsComplete) {
  const ProcessResult result = map(home_, {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "") << "progress was shown without a terminal";
  EXPECT_EQ(nlohmann::json::parse(result.out).at("frames"), kFrames);
  for (const char* file : {"home.xml", "map/config.toml", "map/trajectory.txt", "map/report.json", "map/timing.json", "map/grid.yaml"}) {
    EXPECT_TRUE(fs::exists(home_ / file)) << file;
  }
  EXPECT_FALSE(hasHiddenEntry(home_));
  EXPECT_FALSE(hasHiddenEntry(folder_.path()));
}

TEST_F(MapHome, ExistingHomeKeepsAllButItsMap) {
  mapOrFail(home_);
  const auto before = contentOf(home_ / "map");
  folder_.write("home/home.xml", "<apartment id=\"mine\"/>");
  folder_.write("home/models/cup.ply", "ply");
  const ProcessResult mapped = map(home_, {"--resolution", "0.1"});
  EXPECT_EQ(mapped.exit_code, 0) << mapped.err;
  EXPECT_NE(mapped.err.find("no clouds of their own"), std::string::npos) << mapped.err;
  EXPECT_EQ(base::readFile(home_ / "home.xml"), "<apartment id=\"mine\"/>");
  EXPECT_EQ(base::readFile(home_ / "models/cup.ply"), "ply");
  EXPECT_FALSE(differences(before, contentOf(home_ / "map")).empty());
  EXPECT_FALSE(hasHiddenEntry(home_));
}

TEST_F(MapHome, MapIsTheSameForAnyNumberOfThreads) {
  mapOrFail(folder_.path() / "one", {"--threads", "1"});
  const auto one = contentOf(folder_.path() / "one/map");
  EXPECT_GE(one.size(), 5U);
  for (const char* threads : {"1", "2", "3"}) {
    const fs::path again = folder_.path() / ("again" + std::string(threads));
    mapOrFail(again, {"--threads", threads});
    EXPECT_EQ(differences(one, contentOf(again / "map")), std::vector<std::string>{}) << threads << " threads";
  }
}

TEST_F(MapHome, SavedConfigurationGivesTheSameMap) {
  mapOrFail(home_, {"--resolution", "0.1"});
  const fs::path again = folder_.path() / "again";
  mapOrFail(again, {"--config", (home_ / "map/config.toml").string()});
  EXPECT_EQ(differences(contentOf(home_ / "map"), contentOf(again / "map")), std::vector<std::string>{});
}

TEST_F(MapHome, FolderThatIsNoMapIsNotReplaced) {
  folder_.write("home/map/holiday.jpg", "photo");
  const ProcessResult result = map(home_);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("no map that oikos made"), std::string::npos) << result.err;
  EXPECT_EQ(base::readFile(home_ / "map/holiday.jpg"), "photo");
  EXPECT_FALSE(hasHiddenEntry(home_));
}

TEST_F(MapHome, WrongInputExitsWith3AndChangesNothing) {
  const fs::path config = folder_.write("map.toml", "\n[volume]\nresolution = 0.1\n");
  const ProcessResult unknown_key = map(home_, {"--config", config.string()});
  EXPECT_EQ(unknown_key.exit_code, 3);
  EXPECT_NE(unknown_key.err.find("map.toml:3: unknown key 'volume.resolution'"), std::string::npos) << unknown_key.err;

  fs::remove(recording_ / "camera.toml");
  const ProcessResult no_camera = map(home_);
  EXPECT_EQ(no_camera.exit_code, 3);
  EXPECT_NE(no_camera.err.find("camera.toml"), std::string::npos) << no_camera.err;
  EXPECT_FALSE(fs::exists(home_));
  EXPECT_FALSE(hasHiddenEntry(folder_.path()));
}

TEST_F(MapHome, WrongUsageExitsWith2) {
  EXPECT_EQ(map(home_, {"--resolution", "0"}).exit_code, 2);
  EXPECT_EQ(map(home_, {"--features", "surf"}).exit_code, 2);
  EXPECT_EQ(map(home_, {"--set", "nonsense"}).exit_code, 2);
  EXPECT_EQ(map(home_, {"--robot", "robot.urdf"}).exit_code, 2);
  EXPECT_EQ(map(recording_ / "camera.toml").exit_code, 2);
  EXPECT_EQ(runOikos({"map"}).exit_code, 2);
  EXPECT_EQ(runOikos({"map", recording_.string()}).exit_code, 2);
  EXPECT_FALSE(fs::exists(home_));
}

TEST_F(MapHome, InterruptEndsWithinASecondAndLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Process process(command(home_));
    waitUntilStaged(process, folder_.path() / ".home.staging/map");
    process.send(signal);
    ASSERT_TRUE(process.hasEndedWithin(seconds(1)));
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(result.err, "\noikos: interrupted; " + home_.string() + " was not made\n");
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(home_));
    EXPECT_FALSE(hasHiddenEntry(folder_.path()));
  }
}

TEST_F(MapHome, InterruptLeavesTheOldMap) {
  mapOrFail(home_);
  const auto before = contentOf(home_);
  Process process(command(home_, {"--resolution", "0.1"}));
  waitUntilStaged(process, home_ / ".staging/map");
  process.send(SIGINT);
  ASSERT_TRUE(process.hasEndedWithin(seconds(1)));
  EXPECT_EQ(process.finish().err, "\noikos: interrupted; " + home_.string() + " is unchanged\n");
  EXPECT_EQ(differences(before, contentOf(home_)), std::vector<std::string>{});
}

TEST_F(MapHome, SecondWriterIsRefused) {
  mapOrFail(home_);
  Process first(command(home_));
  waitUntilStaged(first, home_ / ".staging/map");
  const ProcessResult second = map(home_);
  EXPECT_EQ(second.exit_code, 4);
  EXPECT_NE(second.err.find("another process is writing here"), std::string::npos) << second.err;
  EXPECT_EQ(first.finish().exit_code, 0);
}

/// Ten moments in a run of this length, five of them near its end, where the map is put in place.
std::vector<microseconds> killMoments(microseconds run) {
  std::mt19937 random(20260101);
  std::vector<microseconds> moments;
  for (int i = 0; i < 10; ++i) {
    const double share = static_cast<double>(random()) / 4294967296.0;
    moments.emplace_back(static_cast<std::int64_t>(static_cast<double>(run.count()) * (i % 2 == 0 ? share : 0.9 + 0.12 * share)));
  }
  return moments;
}

TEST_F(MapHome, KillAtAnyTimeLeavesTheOldOrTheNewMap) {
  const std::vector<std::string> other_map = {"--resolution", "0.1"};
  mapOrFail(home_);
  const auto old_map = contentOf(home_ / "map");
  const auto begin = steady_clock::now();
  mapOrFail(folder_.path() / "reference", other_map);
  const auto run = std::chrono::duration_cast<microseconds>(steady_clock::now() - begin);
  const auto new_map = contentOf(folder_.path() / "reference/map");
  ASSERT_FALSE(differences(old_map, new_map).empty());

  for (const microseconds moment : killMoments(run)) {
    SCOPED_TRACE("killed after " + std::to_string(moment.count()) + " us");
    {
      Process process(command(home_, other_map));
      process.hasEndedWithin(moment);
      process.send(SIGKILL);
      process.finish();
    }
    const auto found = contentOf(home_ / "map");
    EXPECT_TRUE(differences(found, old_map).empty() || differences(found, new_map).empty());
    EXPECT_TRUE(fs::exists(home_ / "home.xml"));
    mapOrFail(home_);
    EXPECT_EQ(differences(old_map, contentOf(home_ / "map")), std::vector<std::string>{});
    EXPECT_FALSE(hasHiddenEntry(home_));
  }
}

TEST_F(MapHome, KillAtAnyTimeLeavesNoHomeOrAWholeOne) {
  const auto begin = steady_clock::now();
  mapOrFail(folder_.path() / "reference");
  const auto run = std::chrono::duration_cast<microseconds>(steady_clock::now() - begin);
  const auto whole = contentOf(folder_.path() / "reference");
  for (const microseconds moment : killMoments(run)) {
    SCOPED_TRACE("killed after " + std::to_string(moment.count()) + " us");
    fs::remove_all(home_);
    Process process(command(home_));
    process.hasEndedWithin(moment);
    process.send(SIGKILL);
    process.finish();
    if (fs::exists(home_)) {
      EXPECT_EQ(differences(whole, contentOf(home_)), std::vector<std::string>{});
    }
  }
  fs::remove_all(home_);
  mapOrFail(home_);
  EXPECT_FALSE(hasHiddenEntry(folder_.path()));
}

TEST_F(MapHome, FileSizeLimitIsAnIoErrorAndKeepsTheOldMap) {
  mapOrFail(home_);
  const auto before = contentOf(home_);
  std::string words = "ulimit -f 8; exec \"$@\"";  // in units of 512 or 1024 bytes, as the shell likes
  std::vector<std::string> limited = {"sh", "-c", words, "sh"};
  const auto wanted = command(home_);
  limited.insert(limited.end(), wanted.begin(), wanted.end());
  const ProcessResult result = Process(limited).finish();
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.err, "");
  EXPECT_EQ(differences(before, contentOf(home_)), std::vector<std::string>{});
  EXPECT_FALSE(hasHiddenEntry(home_));
}

/// A small disk of its own; only root may make one.
class SmallDisk {
 public:
  explicit SmallDisk(fs::path folder) : folder_(std::move(folder)) {
    fs::create_directory(folder_);
    mounted_ = ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=64m") == 0;
  }
  ~SmallDisk() {
    if (mounted_) {
      ::umount2(folder_.c_str(), MNT_DETACH);
    }
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  [[nodiscard]] bool isMounted() const { return mounted_; }
  /// Leaves this much free.
  void shrink(std::uintmax_t free_bytes) const {
    const fs::space_info space = fs::space(folder_);
    const std::string size = "size=" + std::to_string(space.capacity - space.free + free_bytes);
    ASSERT_EQ(::mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT, size.c_str()), 0) << std::strerror(errno);
  }

 private:
  fs::path folder_;
  bool mounted_ = false;
};

TEST_F(MapHome, FullDiskIsAnIoErrorAndKeepsTheOldMap) {
  const SmallDisk disk(folder_.path() / "disk");
  if (!disk.isMounted()) {
    GTEST_SKIP() << "SKIPPED LOUDLY: no tmpfs may be mounted here (" << std::strerror(errno) << "); a full disk was tested by a limit only";
  }
  const fs::path home = folder_.path() / "disk/home";
  mapOrFail(home);
  const auto before = contentOf(home);
  for (const std::uintmax_t free_bytes : {0U, 16384U, 131072U}) {
    SCOPED_TRACE(std::to_string(free_bytes) + " bytes free");
    disk.shrink(free_bytes);
    const ProcessResult result = map(home);
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(result.err, "");
    EXPECT_EQ(differences(before, contentOf(home)), std::vector<std::string>{});
    EXPECT_FALSE(hasHiddenEntry(home));
  }
}

}  // namespace
}  // namespace oikos::test
