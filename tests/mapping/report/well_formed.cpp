// SPDX-License-Identifier: Apache-2.0
#include "tests/mapping/report/well_formed.h"

#include <cstddef>
#include <regex>
#include <vector>

namespace oikos::mapping::test {

namespace {

std::string at(const std::string& text, std::size_t position, const std::string& what) {
  return what + " at: " + text.substr(position, 60);
}

/// Every '&' has to begin a reference that XML knows without a document type.
std::string referenceProblem(const std::string& text) {
  static const std::regex reference("^&(amp|lt|gt|quot|apos|#[0-9]+);");
  for (std::size_t i = text.find('&'); i != std::string::npos; i = text.find('&', i + 1)) {
    if (!std::regex_search(text.substr(i, 12), reference)) {
      return at(text, i, "bare &");
    }
  }
  return "";
}

class Tags {
 public:
  std::string read(const std::string& tag) {
    static const std::regex closing("/([a-z0-9]+)");
    static const std::regex opening("([a-z0-9]+)(\\s+[a-zA-Z-]+=\"[^\"<]*\")*\\s*(/?)");
    std::smatch match;
    if (std::regex_match(tag, match, closing)) {
      if (open_.empty() || open_.back() != match[1]) {
        return "</" + match[1].str() + "> closes nothing";
      }
      open_.pop_back();
      return "";
    }
    if (!std::regex_match(tag, match, opening)) {
      return "not a tag: <" + tag.substr(0, 60) + ">";
    }
    if (match[3].length() == 0) {
      open_.push_back(match[1]);
    }
    return "";
  }
  [[nodiscard]] std::string unclosed() const { return open_.empty() ? "" : "<" + open_.back() + "> is not closed"; }

 private:
  std::vector<std::string> open_;
};

}  // namespace

std::string xmlProblem(const std::string& text) {
  const std::string doctype = "<!DOCTYPE html>";
  std::size_t position = text.starts_with(doctype) ? doctype.size() : 0;
  Tags tags;
  while (true) {
    const std::size_t begin = text.find('<', position);
    if (begin == std::string::npos) {
      break;
    }
    const std::size_t end = text.find('>', begin);
    if (end == std::string::npos) {
      return at(text, begin, "unended tag");
    }
    std::string tag = text.substr(begin + 1, end - begin - 1);
    if (const std::size_t data = tag.find("base64,"); data != std::string::npos) {
      tag.erase(data, tag.find('"', data) - data);  // long enough to exhaust the stack of std::regex
    }
    if (const std::size_t path = tag.find(" d=\""); path != std::string::npos) {
      tag.erase(path, tag.find('"', path + 4) + 1 - path);
    }
    if (const std::string problem = tags.read(tag); !problem.empty()) {
      return problem;
    }
    position = end + 1;
  }
  const std::string problem = tags.unclosed();
  return problem.empty() ? referenceProblem(text) : problem;
}

}  // namespace oikos::mapping::test
