// SPDX-License-Identifier: Apache-2.0
#include "bench/mapping/mapping_run.h"

#include <array>
#include <cstdio>
#include <fstream>
#include <set>
#include <stdexcept>

namespace oikos::bench {

namespace {

namespace fs = std::filesystem;

std::uint64_t hashFile(const fs::path& file) {
  constexpr std::uint64_t kOffsetBasis = 14695981039346656037U;
  constexpr std::uint64_t kPrime = 1099511628211U;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw std::runtime_error("cannot read " + file.string());
  }
  std::uint64_t hash = kOffsetBasis;
  std::array<char, 65536> block{};
  while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
    for (std::streamsize i = 0; i < stream.gcount(); ++i) {
      hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * kPrime;
    }
  }
  return hash;
}

/// Names of files that are not the same in both, or in one only.
std::set<std::string> differences(const std::map<std::string, std::uint64_t>& a, const std::map<std::string, std::uint64_t>& b) {
  std::set<std::string> names;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const auto& [name, hash] : *one) {
      const auto found = other->find(name);
      if (found == other->end() || found->second != hash) {
        names.insert(name);
      }
    }
  }
  return names;
}

}  // namespace

ChildRun mapRecording(const MapCommand& command, const fs::path& recording, const fs::path& home) {
  std::vector<std::string> words{command.oikos.string(), "map", recording.string(), "--out", home.string(), "--json", "--quiet"};
  if (command.threads > 0) {
    words.insert(words.end(), {"--threads", std::to_string(command.threads)});
  }
  for (const std::string& setting : command.settings) {
    words.insert(words.end(), {"--set", setting});
  }
  ChildRun run = runChild(words, home.string() + ".out");
  if (run.exit_code != 0) {
    throw std::runtime_error("oikos map " + recording.string() + " ended with " + std::to_string(run.exit_code));
  }
  return run;
}

std::map<std::string, std::uint64_t> hashFiles(const fs::path& home) {
  std::map<std::string, std::uint64_t> hashes;
  for (const auto& entry : fs::recursive_directory_iterator(home)) {
    const std::string name = entry.path().lexically_relative(home).generic_string();
    if (entry.is_regular_file() && name != "map/timing.json") {
      hashes[name] = hashFile(entry.path());
    }
  }
  return hashes;
}

bool compareRuns(const MapCommand& command, const BenchRecording& recording, const fs::path& scratch) {
  const fs::path home = scratch / (recording.name + "-again");
  std::map<std::string, std::uint64_t> first;
  bool all_same = true;
  for (const int threads : {0, 0, 1, 2, 3}) {
    MapCommand other = command;
    other.threads = threads == 0 ? command.threads : threads;
    fs::remove_all(home);
    (void)mapRecording(other, recording.folder, home);
    const auto hashes = hashFiles(home);
    if (first.empty()) {
      first = hashes;
      continue;
    }
    const std::set<std::string> differing = differences(first, hashes);
    const std::string which = threads == 0 ? "second run" : std::to_string(threads) + (threads == 1 ? " thread" : " threads");
    std::printf("%s, %s: %zu files, %s\n", recording.name.c_str(), which.c_str(), hashes.size(),
                differing.empty() ? "all the same bytes" : "DIFFERENT:");
    for (const std::string& name : differing) {
      std::printf("  %s\n", name.c_str());
    }
    std::fflush(stdout);
    all_same = all_same && differing.empty();
  }
  fs::remove_all(home);
  return all_same;
}

}  // namespace oikos::bench
