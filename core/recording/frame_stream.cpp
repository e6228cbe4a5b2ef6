// SPDX-License-Identifier: Apache-2.0
#include "core/recording/frame_stream.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/error.h"

namespace oikos::recording {

namespace {

constexpr std::size_t kKeptMessages = 10;

void requireAtLeastOne(std::vector<std::string>& problems, const char* name, int value) {
  if (value < 1) {
    problems.push_back(std::string("recording.").append(name) + " = " + std::to_string(value) + ": must be >= 1");
  }
}

}  // namespace

std::vector<std::string> FrameStreamConfig::validate() const {
  std::vector<std::string> problems;
  requireAtLeastOne(problems, "stride", stride);
  requireAtLeastOne(problems, "capacity", capacity);
  requireAtLeastOne(problems, "decode_threads", decode_threads);
  if (!(max_unreadable_share >= 0.0 && max_unreadable_share <= 1.0)) {
    problems.push_back("recording.max_unreadable_share = " + std::to_string(max_unreadable_share) + ": must be from 0 to 1");
  }
  return problems;
}

FrameStream::FrameStream(const Recording& recording, const FrameStreamConfig& config) : recording_(recording), config_(config) {
  if (const auto problems = config.validate(); !problems.empty()) {
    throw base::Error(base::ErrorCode::kUsage, problems.front());
  }
  statistics_.listing = recording.listing();
  statistics_.listed = (recording.frameCount() + config.stride - 1) / config.stride;
  slots_.resize(static_cast<std::size_t>(config.capacity));
  for (int t = 0; t < config.decode_threads; ++t) {
    decoders_.emplace_back([this] { decodeAhead(); });
  }
}

FrameStream::~FrameStream() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  slot_free_.notify_all();
  decoders_.clear();  // joins
}

void FrameStream::decodeAhead() {
  std::unique_lock lock(mutex_);
  while (true) {
    slot_free_.wait(
        lock, [this] { return stopping_ || next_to_decode_ >= statistics_.listed || next_to_decode_ < next_to_take_ + config_.capacity; });
    if (stopping_ || next_to_decode_ >= statistics_.listed) {
      return;
    }
    const int position = next_to_decode_++;
    lock.unlock();
    Slot slot = decode(position);
    lock.lock();
    slots_[static_cast<std::size_t>(position % config_.capacity)] = std::move(slot);
    slot_ready_.notify_one();
  }
}

FrameStream::Slot FrameStream::decode(int position) const {
  Slot slot;
  slot.ready = true;
  try {
    slot.frame = recording_.read(position * config_.stride, config_.channels);
  } catch (const base::Error& error) {
    slot.unreadable = error.what();
  } catch (...) {
    slot.failure = std::current_exception();
  }
  return slot;
}

FrameStream::Slot FrameStream::takeNext() {
  std::unique_lock lock(mutex_);
  Slot& waiting = slots_[static_cast<std::size_t>(next_to_take_ % config_.capacity)];
  slot_ready_.wait(lock, [&waiting] { return waiting.ready; });
  Slot taken = std::exchange(waiting, Slot{});
  ++next_to_take_;
  slot_free_.notify_one();
  return taken;
}

void FrameStream::countUnreadable(const std::string& message) {
  ++statistics_.unreadable;
  if (statistics_.first_messages.size() < kKeptMessages) {
    statistics_.first_messages.push_back(message);
  }
  if (statistics_.unreadable > config_.max_unreadable_share * statistics_.listed) {
    throw base::Error(base::ErrorCode::kInput,
                      std::to_string(statistics_.unreadable) + " of the " + std::to_string(statistics_.listed) +
                          " frames are unreadable so far, more than are tolerated; the first: " + statistics_.first_messages.front());
  }
}

std::optional<camera::RgbdFrame> FrameStream::next() {
  while (next_to_take_ < statistics_.listed) {
    Slot slot = takeNext();
    if (slot.failure) {
      std::rethrow_exception(slot.failure);
    }
    if (slot.frame) {
      ++statistics_.read;
      return std::move(slot.frame);
    }
    countUnreadable(slot.unreadable);
  }
  return std::nullopt;
}

}  // namespace oikos::recording
