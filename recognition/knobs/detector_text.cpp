// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "recognition/knobs/knob_detector.h"
#include "recognition/knobs/shipped_detector.h"

namespace oikos::recognition {

namespace {

constexpr std::string_view kIdentifier = "oikos-knob-detector";
constexpr std::string_view kVersion = "1";
constexpr int kDecimals = 5;

/// Words one after the other, and the line that the last one stood in.
class WordReader {
 public:
  WordReader(std::string_view text, std::string where) : rest_(text), where_(std::move(where)) {}

  std::string_view next() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())) != 0) {
      line_ += rest_.front() == '\n' ? 1 : 0;
      rest_.remove_prefix(1);
    }
    const auto end = std::find_if(rest_.begin(), rest_.end(), [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
    const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(word.size());
    return word;
  }
  void expect(std::string_view wanted) {
    const std::string_view word = next();
    if (word != wanted) {
      refuse(word, "'" + std::string(wanted) + "'");
    }
  }
  float number() {
    const std::string_view word = next();
    const std::optional<double> value = base::findNumber(word);
    if (!value || !std::isfinite(*value) || std::abs(*value) > 1e6) {
      refuse(word, "a number between -1e6 and 1e6");
    }
    return static_cast<float>(*value);
  }
  [[noreturn]] void refuse(std::string_view found, const std::string& expected) const {
    const std::string what = found.empty() ? "the end of the file" : "'" + std::string(found.substr(0, 40)) + "'";
    throw base::Error(base::ErrorCode::kInput, "found " + what + ", expected " + expected, where_ + ":" + std::to_string(line_));
  }

 private:
  std::string_view rest_;
  std::string where_;
  int line_ = 1;
};

}  // namespace

DetectorModel parseDetector(std::string_view text, const std::string& where) {
  WordReader reader(text, where);
  reader.expect(kIdentifier);
  reader.expect(kVersion);
  reader.expect("weights");
  reader.expect(std::to_string(kDescriptorSize));
  reader.expect("bias");
  DetectorModel model;
  model.bias = reader.number();
  reader.expect("threshold");
  model.threshold = reader.number();
  for (int i = 0; i < kDescriptorSize; ++i) {
    model.weights.push_back(reader.number());
  }
  if (const std::string_view rest = reader.next(); !rest.empty()) {
    reader.refuse(rest, "the end of the file");
  }
  return model;
}

std::string writeDetector(const DetectorModel& model) {
  OIKOS_CHECK(static_cast<int>(model.weights.size()) == kDescriptorSize);
  std::string text = std::string(kIdentifier) + " " + std::string(kVersion) + "\nweights " + std::to_string(model.weights.size()) +
                     "\nbias " + base::toFixedText(model.bias, kDecimals) + "\nthreshold " + base::toFixedText(model.threshold, kDecimals) +
                     "\n";
  constexpr std::size_t kPerLine = 9;  // a cell
  for (std::size_t i = 0; i < model.weights.size(); ++i) {
    text += base::toFixedText(model.weights[i], kDecimals) + (i % kPerLine == kPerLine - 1 ? "\n" : " ");
  }
  return text;
}

const DetectorModel& shippedDetector() {
  static const DetectorModel model = parseDetector(kShippedDetector, "the detector that the program was built with");
  return model;
}

}  // namespace oikos::recognition
