// SPDX-License-Identifier: Apache-2.0
// What a question costs in process, by the size of the home, and what loading one costs. Of each home three objects are blue cups.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "semantic/query/answer.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos;
using Clock = std::chrono::steady_clock;

constexpr int kObjectsOnATable = 20;
constexpr int kTablesInARoom = 50;

std::string smallObject(int number, const std::string& table, const char* type, const char* color) {
  const std::string pose = std::to_string(0.01 * (number % 50)) + " 0 0.75 0 0 0";
  return "<smallObject id=\"o" + std::to_string(number) + "\" type=\"" + type + "\" parent=\"" + table + "\" relation=\"on\" pose=\"" +
         pose + "\" graspable=\"true\">\n<property name=\"color\" value=\"" + color + "\"/>\n<defaultPlace parent=\"" + table +
         "\" relation=\"on\" pose=\"" + pose + "\"/>\n<graspingPoint pose=\"0 0 0.1 0 90 0\"/>\n</smallObject>\n";
}

std::string homeOf(int objects) {
  constexpr std::array<const char*, 6> kTypes{"cup", "bowl", "dish", "bottle", "container", "book"};
  constexpr std::array<const char*, 5> kColors{"red", "green", "yellow", "white", "black"};
  std::mt19937 random(1);
  std::string xml = "<apartment id=\"big\" name=\"big\" version=\"1\">\n";
  for (int i = 0; i < objects; ++i) {
    const int table = i / kObjectsOnATable;
    const std::string id = "t" + std::to_string(table);
    if (i % (kObjectsOnATable * kTablesInARoom) == 0) {
      const std::string room = std::to_string(table / kTablesInARoom);
      xml += "<room id=\"r" + room + "\" name=\"room " + room + "\">\n";
    }
    if (i % kObjectsOnATable == 0) {
      xml += "<largeObject id=\"" + id + "\" type=\"table\" pose=\"" + std::to_string(2 * table) +
             " 0 0 0 0 0\" movability=\"fixed\" graspable=\"false\">\n<parkingPose pose=\"-1 0 0 0 0 0\" default=\"true\"/>\n";
    }
    const bool blue = i == objects / 7 || i == objects / 2 || i == objects - 1;
    xml += smallObject(i, id, blue ? "cup" : kTypes[random() % kTypes.size()], blue ? "blue" : kColors[random() % kColors.size()]);
    const bool last = i + 1 == objects;
    xml += last || (i + 1) % kObjectsOnATable == 0 ? "</largeObject>\n" : "";
    xml += last || (i + 1) % (kObjectsOnATable * kTablesInARoom) == 0 ? "</room>\n" : "";
  }
  return xml + "</apartment>\n";
}

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double peakMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1000.0;
}

/// The median of many, in microseconds.
double questionUs(const semantic::HomeIndex& index, const char* question) {
  constexpr int kTimes = 301;
  std::vector<double> times;
  for (int i = 0; i < kTimes; ++i) {
    const auto start = Clock::now();
    const semantic::Answer answer = semantic::answerQuestion(index, question);
    times.push_back(1e6 * secondsSince(start));
    if (answer.status == semantic::AnswerStatus::kNotUnderstood) {
      std::printf("not understood: %s\n", question);
    }
  }
  std::nth_element(times.begin(), times.begin() + kTimes / 2, times.end());
  return times[kTimes / 2];
}

void measure(int objects) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("home.xml", homeOf(objects));
  auto start = Clock::now();
  const semantic::HomeReading reading = semantic::readHome(file);
  const double load_s = secondsSince(start);
  if (!reading.complete || !reading.findings.empty()) {
    std::printf("the generated home is not valid: %s\n", reading.findings.empty() ? "" : reading.findings[0].found.c_str());
    return;
  }
  start = Clock::now();
  const semantic::HomeIndex index(reading.home);
  const double index_s = secondsSince(start);
  std::printf("| %d | %.1f | %.2f | %.2f | %.1f | %.1f | %.1f | %.0f |\n", objects,
              static_cast<double>(std::filesystem::file_size(file)) / 1e6, load_s, index_s, questionUs(index, "where is the blue cup?"),
              questionUs(index, "what is on the table t7"), questionUs(index, "where is the bleu cup"), peakMb());
}

}  // namespace

int main() {
  std::printf(
      "| objects | file MB | load and validate s | index s | where is the blue cup us | what is on the table us | one typing error us | "
      "peak MB so far |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const int objects : {1000, 10000, 100000}) {
    measure(objects);
  }
}
