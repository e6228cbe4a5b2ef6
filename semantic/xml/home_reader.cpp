// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/home_reader.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/posix_file.h"
#include "semantic/model/home_check.h"
#include "semantic/xml/home_builder.h"
#include "semantic/xml/home_schema.h"
#include "semantic/xml/validating_reader.h"

namespace oikos::semantic {

namespace {

HomeReading read(std::istream& input, const std::string& where) {
  HomeBuilder builder;
  const XmlReading xml = readValidated(input, where, homeSchema(),
                                       {[&](const XmlElement& element) { builder.add(element); },
                                        [&](std::string_view name, const std::string& content) { builder.end(name, content); }});
  HomeReading reading{xml.complete, builder.take(), xml.findings};
  reading.findings.insert(reading.findings.end(), builder.findings().begin(), builder.findings().end());
  if (reading.complete) {
    const std::vector<Finding> checked = checkHome(reading.home);
    reading.findings.insert(reading.findings.end(), checked.begin(), checked.end());
  }
  std::stable_sort(reading.findings.begin(), reading.findings.end(), [](const Finding& a, const Finding& b) { return a.line < b.line; });
  return reading;
}

}  // namespace

HomeReading readHome(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  if (!input || std::filesystem::is_directory(file)) {
    throw base::Error(base::ErrorCode::kIo, "cannot be opened", file.string());
  }
  return read(input, file.string());
}

HomeReading readHomeText(const std::string& text, const std::string& where) {
  std::istringstream input(text);
  return read(input, where);
}

Home getHome(HomeReading reading, const std::filesystem::path& file) {
  for (const Finding& finding : reading.findings) {
    if (finding.severity == Severity::kError) {
      throw base::Error(base::ErrorCode::kInput,
                        finding.element + ": " + finding.found + (finding.expected.empty() ? "" : "; expected " + finding.expected) +
                            " (oikos check " + base::folderOf(file).string() + " lists everything)",
                        file.string() + ":" + std::to_string(finding.line));
    }
  }
  OIKOS_CHECK(reading.complete);
  return std::move(reading.home);
}

}  // namespace oikos::semantic
