// SPDX-License-Identifier: Apache-2.0
#include "core/model/urdf_document.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>
#include <string>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "core/model/nesting_check.h"

namespace oikos::model {

namespace {

/// urdfdom reports through a global logger that prints by default: this keeps the first messages instead, the cause and where it is.
class CapturedMessages : public console_bridge::OutputHandler {
 public:
  CapturedMessages() { console_bridge::useOutputHandler(this); }
  ~CapturedMessages() override { console_bridge::restorePreviousOutputHandler(); }
  CapturedMessages(const CapturedMessages&) = delete;
  CapturedMessages& operator=(const CapturedMessages&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/, int /*line*/) override {
    if (count_ < kMaxMessages && level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) {
      text_ += (count_ == 0 ? "" : "; ") + text;
      ++count_;
    }
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  static constexpr int kMaxMessages = 3;
  std::string text_;
  int count_ = 0;
};

}  // namespace

std::shared_ptr<urdf::ModelInterface> parseUrdf(const std::filesystem::path& file) {
  static std::mutex logger_mutex;
  const std::string text = base::readFile(file);
  checkXmlNesting(text, file.string());
  const std::lock_guard lock(logger_mutex);
  const CapturedMessages messages;
  urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model) {
    throw base::Error(base::ErrorCode::kInput, "is not a valid URDF: " + messages.text(), file.string());
  }
  return model;
}

Eigen::Isometry3d toIsometry(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  result.translation() << pose.position.x, pose.position.y, pose.position.z;
  return result;
}

}  // namespace oikos::model
