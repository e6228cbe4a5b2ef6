// SPDX-License-Identifier: Apache-2.0
// Files that are made to take the memory or the time of whoever reads them. Those that fit into a kilobyte lie in fuzz/corpus.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <istream>
#include <streambuf>
#include <string>

#include "semantic/query/home_index.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_schema.h"
#include "semantic/xml/validating_reader.h"

namespace oikos::semantic {
namespace {

constexpr std::size_t kGigabyte = 1'000'000'000;

/// A beginning, then one letter over and over, made as it is read.
class Endless : public std::streambuf {
 public:
  explicit Endless(std::string beginning) : beginning_(std::move(beginning)) { block_.fill('a'); }
  [[nodiscard]] std::size_t given() const { return given_; }

 protected:
  int_type underflow() override {
    if (given_ == 0) {
      setg(beginning_.data(), beginning_.data(), beginning_.data() + beginning_.size());
      given_ = beginning_.size();
    } else if (given_ < kGigabyte) {
      setg(block_.data(), block_.data(), block_.data() + block_.size());
      given_ += block_.size();
    } else {
      return traits_type::eof();
    }
    return traits_type::to_int_type(*gptr());
  }

 private:
  std::string beginning_;
  std::array<char, 65536> block_{};
  std::size_t given_ = 0;
};

TEST(HostileHome, AnAttributeOfAGigabyteIsGivenUpBeforeATenthOfItIsRead) {
  constexpr std::size_t kMost = kGigabyte / 10;
  for (const char* const beginning :
       {"<apartment name=\"", "<apartment id=\"a\" name=\"a\" version=\"1\"><room id=\"", "<", "<!--", "<apartment>"}) {
    Endless bytes(beginning);
    std::istream stream(&bytes);
    const ElementHandler nobody{[](const XmlElement&) {}, [](std::string_view, const std::string&) {}};
    const XmlReading reading = readValidated(stream, "home.xml", homeSchema(), nobody);
    EXPECT_FALSE(reading.complete) << beginning;
    EXPECT_FALSE(reading.findings.empty()) << beginning;
    EXPECT_LT(bytes.given(), kMost) << beginning;
  }
}

TEST(HostileHome, TenThousandLevelsAreGivenUpAtTheThirtySecond) {
  std::string text;
  for (int i = 0; i < 10'000; ++i) {
    text += "<a>";
  }
  const HomeReading reading = readHomeText(text, "home.xml");
  EXPECT_FALSE(reading.complete);
  EXPECT_LT(reading.findings.size(), 100U);
  EXPECT_TRUE(std::any_of(reading.findings.begin(), reading.findings.end(),
                          [](const Finding& finding) { return finding.found.find("nested 33 deep") != std::string::npos; }));
}

TEST(HostileHome, AHundredThousandRoomsAreAHome) {
  constexpr int kRooms = 100'000;
  std::string text = "<apartment id=\"a\" name=\"a\" version=\"1\">\n";
  for (int i = 0; i < kRooms; ++i) {
    text += "<room id=\"r" + std::to_string(i) + "\" name=\"room " + std::to_string(i) + "\"/>\n";
  }
  const HomeReading reading = readHomeText(text + "</apartment>\n", "home.xml");
  EXPECT_TRUE(reading.complete);
  EXPECT_TRUE(reading.findings.empty());
  ASSERT_EQ(reading.home.rooms.size(), static_cast<std::size_t>(kRooms));
  const HomeIndex index(reading.home);
  ASSERT_NE(index.findById("r99999"), nullptr);
  EXPECT_EQ(index.findById("r99999")->room->id.value, "r99999");
}

TEST(HostileHome, AHundredThousandErrorsAreReportedByTheFirstThousand) {
  std::string text = "<apartment id=\"a\" name=\"a\" version=\"1\">\n";
  for (int i = 0; i < 100'000; ++i) {
    text += "<room id=\"same\" name=\"\"/>\n";
  }
  const HomeReading reading = readHomeText(text + "</apartment>\n", "home.xml");
  EXPECT_GE(reading.findings.size(), 1000U);
  EXPECT_LE(reading.findings.size(), 1001U);
}

}  // namespace
}  // namespace oikos::semantic
