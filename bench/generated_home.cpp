// SPDX-License-Identifier: Apache-2.0
#include "bench/generated_home.h"

#include <array>
#include <random>

namespace oikos::bench {

namespace {

constexpr int kObjectsOnATable = 20;
constexpr int kTablesInARoom = 50;

std::string smallObject(int number, const std::string& table, const char* type, const char* color) {
  const std::string pose = std::to_string(0.01 * (number % 50)) + " 0 0.75 0 0 0";
  return "<smallObject id=\"o" + std::to_string(number) + "\" type=\"" + type + "\" parent=\"" + table + "\" relation=\"on\" pose=\"" +
         pose + "\" graspable=\"true\">\n<property name=\"color\" value=\"" + color + "\"/>\n<defaultPlace parent=\"" + table +
         "\" relation=\"on\" pose=\"" + pose + "\"/>\n<graspingPoint pose=\"0 0 0.1 0 90 0\"/>\n</smallObject>\n";
}

}  // namespace

std::string homeXmlOf(int objects) {
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

}  // namespace oikos::bench
