// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/home_writer.h"

#include "core/base/error.h"
#include "semantic/xml/home_nodes.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/node_text.h"

namespace oikos::semantic {

namespace {

/// Throws unless the text reads as the home.
void verify(const std::string& text, const Home& home, const std::string& where) {
  const HomeReading reading = readHomeText(text, where);
  for (const Finding& finding : reading.findings) {
    if (finding.severity == Severity::kError) {
      throw base::Error(base::ErrorCode::kInput,
                        "would not be valid, so the old one was kept: " + finding.element + ": " + finding.found +
                            (finding.expected.empty() ? "" : "; expected " + finding.expected),
                        where);
    }
  }
  OIKOS_CHECK(reading.complete);
  // Some angles have no text in degrees that gives the same bits; then it is the text that must not change any more.
  OIKOS_CHECK(reading.home == home || spliceXml(text, reading.home, home) == text);
}

}  // namespace

std::string toXml(const Home& home) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  appendElement(out, nodeOf(home, {}), "");
  return out + "\n";
}

std::string toXml(const LargeObject& object) {
  XmlNode node;
  node.name = object.articulation ? "largeArticulatedObject" : "largeObject";
  node.source = &object;
  std::string out;
  appendElement(out, node, "");
  return out;
}

std::string toXml(const SmallObject& object) {
  XmlNode node;
  node.name = "smallObject";
  node.source = &object;
  std::string out;
  appendElement(out, node, "");
  return out;
}

std::string spliceVerified(std::string_view bytes, const Home& before, const Home& after, const std::string& where) {
  std::string text = spliceXml(bytes, before, after);
  verify(text, after, where);
  return text;
}

}  // namespace oikos::semantic
