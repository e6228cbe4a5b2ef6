// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/frame_choice.h"

#include <algorithm>
#include <cstdlib>

namespace oikos::tracking {

namespace {

constexpr double kSecond_ns = 1e9;

/// A frame that sees the piece.
struct Candidate {
  int index = 0;  ///< of the frames
  std::int64_t stamp_ns = 0;
  double worth = 0.0;
};

std::optional<Candidate> candidateOf(const SeenFrame& frame, int index, int piece) {
  const auto sight = std::find_if(frame.sights.begin(), frame.sights.end(), [&](const PieceSight& one) { return one.piece == piece; });
  return sight == frame.sights.end() ? std::nullopt : std::optional(Candidate{index, frame.stamp_ns, sight->worth});
}

/// The best of each of the equal times that a stay is cut into.
void chooseOfStay(const std::vector<Candidate>& stay, const FrameChoiceConfig& config, std::vector<int>& chosen) {
  const double length_s = static_cast<double>(stay.back().stamp_ns - stay.front().stamp_ns) / kSecond_ns;
  const double fitting = config.spacing_s > 0.0 ? length_s / config.spacing_s : static_cast<double>(config.most_frames);
  const int times = std::clamp(static_cast<int>(fitting) + 1, 1, config.most_frames);
  std::vector<const Candidate*> best(static_cast<std::size_t>(times), nullptr);
  for (const Candidate& one : stay) {
    const double share = length_s > 0.0 ? static_cast<double>(one.stamp_ns - stay.front().stamp_ns) / kSecond_ns / length_s : 0.0;
    const Candidate*& slot = best[std::min(static_cast<std::size_t>(share * times), static_cast<std::size_t>(times - 1))];
    if (slot == nullptr || one.worth > slot->worth) {
      slot = &one;
    }
  }
  for (const Candidate* const one : best) {
    if (one != nullptr) {
      chosen.push_back(one->index);
    }
  }
}

}  // namespace

std::vector<int> chooseFrames(const std::vector<SeenFrame>& frames, int piece, const FrameChoiceConfig& config) {
  std::vector<int> chosen;
  std::vector<Candidate> stay;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::optional<Candidate> candidate = candidateOf(frames[i], static_cast<int>(i), piece);
    if (!candidate) {
      continue;
    }
    if (!stay.empty() && static_cast<double>(candidate->stamp_ns - stay.back().stamp_ns) > config.gap_s * kSecond_ns) {
      chooseOfStay(stay, config, chosen);
      stay.clear();
    }
    stay.push_back(*candidate);
  }
  if (!stay.empty()) {
    chooseOfStay(stay, config, chosen);
  }
  return chosen;
}

std::optional<int> frameBetween(const std::vector<SeenFrame>& frames, int piece, int first, int last) {
  const auto stampOf = [&](int index) { return frames[static_cast<std::size_t>(index)].stamp_ns; };
  const std::int64_t middle_ns = stampOf(first) + (stampOf(last) - stampOf(first)) / 2;
  std::optional<int> nearest;
  for (int i = first + 1; i < last; ++i) {
    if (candidateOf(frames[static_cast<std::size_t>(i)], i, piece) &&
        (!nearest || std::abs(stampOf(i) - middle_ns) < std::abs(stampOf(*nearest) - middle_ns))) {
      nearest = i;
    }
  }
  return nearest;
}

std::optional<int> frameBeside(const std::vector<SeenFrame>& frames, int piece, const std::vector<int>& read, int frame) {
  constexpr std::int64_t kBeside_ns = 1'000'000'000;
  const std::int64_t stamp_ns = frames[static_cast<std::size_t>(frame)].stamp_ns;
  std::optional<int> nearest;
  std::int64_t nearest_ns = kBeside_ns;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::int64_t away_ns = std::abs(frames[i].stamp_ns - stamp_ns);
    const int index = static_cast<int>(i);
    if (away_ns < nearest_ns && std::find(read.begin(), read.end(), index) == read.end() && candidateOf(frames[i], index, piece)) {
      nearest = index;
      nearest_ns = away_ns;
    }
  }
  return nearest;
}

}  // namespace oikos::tracking
