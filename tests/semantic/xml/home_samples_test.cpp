// SPDX-License-Identifier: Apache-2.0
// Every file of schemas/samples: the valid ones without a finding, the invalid ones with those that their comments announce
// (<!-- expect LINE: TEXT -->) and no other error.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "core/base/read_file.h"
#include "semantic/xml/home_reader.h"

namespace oikos::semantic {
namespace {

using Path = std::filesystem::path;

std::vector<Path> samples(const char* kind) {
  std::vector<Path> files;
  for (const auto& entry : std::filesystem::directory_iterator(Path(OIKOS_SOURCE_DIR) / "schemas/samples" / kind)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct Announced {
  int line;
  std::string text;
};

std::vector<Announced> announcedIn(const Path& file) {
  const std::string content = base::readFile(file);
  const std::regex comment("<!-- expect (\\d+): (.*) -->");
  std::vector<Announced> all;
  for (std::sregex_iterator i(content.begin(), content.end(), comment), end; i != end; ++i) {
    all.push_back({std::stoi((*i)[1]), (*i)[2]});
  }
  return all;
}

std::string textOf(const Finding& f) {
  return f.element + ": " + f.found + "; expected " + f.expected;
}

TEST(HomeSamples, ValidOnesHaveNoFinding) {
  std::vector<Path> files = samples("valid");
  files.push_back(Path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml");
  ASSERT_GE(files.size(), 3U);
  for (const Path& file : files) {
    const HomeReading reading = readHome(file);
    EXPECT_TRUE(reading.complete) << file;
    for (const Finding& finding : reading.findings) {
      ADD_FAILURE() << file << ":" << finding.line << ": " << textOf(finding);
    }
  }
}

class InvalidHome : public testing::TestWithParam<Path> {};

TEST_P(InvalidHome, SaysWhatItsCommentsAnnounce) {
  const std::vector<Announced> announced = announcedIn(GetParam());
  ASSERT_FALSE(announced.empty());
  const HomeReading reading = readHome(GetParam());
  std::string all;
  std::size_t errors = 0;
  for (const Finding& f : reading.findings) {
    all += std::to_string(f.line) + ": " + textOf(f) + "\n";
    errors += f.severity == Severity::kError ? 1 : 0;
  }
  EXPECT_EQ(errors, announced.size()) << all;
  for (const Announced& a : announced) {
    EXPECT_TRUE(std::any_of(reading.findings.begin(), reading.findings.end(),
                            [&](const Finding& f) { return f.line == a.line && textOf(f).find(a.text) != std::string::npos; }))
        << "announced: " << a.line << ": " << a.text << "\nfound:\n"
        << all;
  }
}

INSTANTIATE_TEST_SUITE_P(HomeSamples, InvalidHome, testing::ValuesIn(samples("invalid")),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

}  // namespace
}  // namespace oikos::semantic
