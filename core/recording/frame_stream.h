// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/camera/rgbd_frame.h"
#include "core/recording/recording.h"

namespace oikos::recording {

struct FrameStreamConfig {
  Channels channels = Channels::kGray;
  int stride = 1;                     ///< every n-th frame of the list, the first included
  int capacity = 8;                   ///< decoded frames that may wait; about 1.5 MB each at 640x480
  int decode_threads = 1;             ///< the order of frames and all results are the same for any number
  double max_unreadable_share = 0.2;  ///< of the frames to be read; above it the recording is an error
  std::vector<std::string> validate() const;
};

struct StreamStatistics {
  ListingStatistics listing;
  int listed = 0;                           ///< frames to be read: pairs of colour and depth, after the stride
  int read = 0;                             ///< handed out so far
  int unreadable = 0;                       ///< skipped so far
  std::vector<std::string> first_messages;  ///< why, of the first few that were skipped
};

/// Decodes frames ahead of their consumer. Single frames that cannot be read are skipped and counted; too many are an error.
/// `next` and `statistics` are for one consumer thread; the recording must outlive the stream.
class FrameStream {
 public:
  /// Throws Error{kUsage} if the configuration is wrong.
  explicit FrameStream(const Recording& recording, const FrameStreamConfig& config = {});
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;
  /// Waits for the frames that are being decoded at this moment, not for the rest.
  ~FrameStream();

  /// The next readable frame, nothing at the end. Throws Error{kInput} with the first message once more than `max_unreadable_share` of all
  /// frames have turned out to be unreadable.
  [[nodiscard]] std::optional<camera::RgbdFrame> next();

  [[nodiscard]] const StreamStatistics& statistics() const { return statistics_; }

 private:
  /// A decoded frame or the reason why there is none.
  struct Slot {
    bool ready = false;
    std::optional<camera::RgbdFrame> frame;
    std::string unreadable;
    std::exception_ptr failure;  ///< anything but a bad file
  };

  void decodeAhead();
  [[nodiscard]] Slot decode(int position) const;
  [[nodiscard]] Slot takeNext();
  void countUnreadable(const std::string& message);

  const Recording& recording_;
  FrameStreamConfig config_;
  StreamStatistics statistics_;

  std::mutex mutex_;
  std::condition_variable slot_ready_;
  std::condition_variable slot_free_;
  std::vector<Slot> slots_;  ///< position p waits in slot p % capacity
  int next_to_decode_ = 0;
  int next_to_take_ = 0;
  bool stopping_ = false;
  std::vector<std::jthread> decoders_;
};

}  // namespace oikos::recording
