// SPDX-License-Identifier: Apache-2.0
#include "bench/articulated/sequence.h"

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>

namespace oikos::bench {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A joint and where it goes; none, if no draw moves one far enough.
struct Move {
  std::size_t joint = 0;
  double value = 0.0;
};
std::optional<Move> drawMove(const World& world, Random& random) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const std::vector<double> other = randomState(world.real, world.believed, random);
    for (std::size_t j = 0; j < other.size(); ++j) {
      const bool is_turn = world.real.joints[j].type == model::MotionType::kRevolute;
      const bool is_basket = world.real.joints[j].name.find("basket") != std::string::npos;
      const bool is_knob = world.real.joints[j].name.find("knob") != std::string::npos;
      if (!is_basket && !is_knob && std::abs(other[j] - world.values[j]) > (is_turn ? 10.0 * kDegree : 0.05)) {
        return Move{j, other[j]};
      }
    }
  }
  return std::nullopt;
}

/// The first sighting from `begin` on that sees the joint, of those that fuse() takes.
std::size_t firstSeeing(const std::vector<registration::JointSighting>& sightings, std::size_t begin) {
  std::size_t i = begin;
  while (i < sightings.size() && sightings[i].status == registration::JointStatus::kNotInView) {
    ++i;
  }
  return i;
}

JointSequence judged(const std::vector<registration::JointSighting>& sightings, const std::vector<registration::JointSpan>& spans,
                     std::size_t change, double true_value) {
  JointSequence sequence;
  sequence.spans = spans.size();
  if (spans.empty()) {
    return sequence;
  }
  sequence.status = spans.back().status;
  sequence.error = std::abs(spans.back().value - true_value);
  sequence.variance = spans.back().variance;
  for (std::size_t i = change; i < sightings.size(); ++i) {
    if (sightings[i].status == registration::JointStatus::kFound) {
      ++sequence.found;
      sequence.mean_error += std::abs(sightings[i].evidence.value - true_value);
    }
  }
  sequence.mean_error /= std::max(1, sequence.found);
  sequence.is_split_right = change == 0 ? spans.size() == 1 : spans.size() == 2 && spans[1].first == firstSeeing(sightings, change);
  return sequence;
}

}  // namespace

std::vector<JointSequence> runSequence(int number, const SequenceSettings& settings) {
  Random random(settings.trial.seed * 1'000'003 + static_cast<std::uint64_t>(number));
  World world = makeWorld(number, settings.trial.world, random);
  const double distance_m = world.distance_m;
  const double first_rad = world.off_axis_rad;
  const std::optional<Move> move = drawMove(world, random);
  const auto change = static_cast<int>(random() % static_cast<std::uint64_t>(settings.frames / 2)) + settings.frames / 4;
  const registration::Standing believed = believedAnywhere(world, settings.trial.world, random);
  const std::uint64_t contents_seed = random();
  registration::ArticulatedRegistration registration(world.believed, settings.trial.config);
  std::vector<std::vector<registration::JointSighting>> sightings;
  std::vector<registration::JointEstimate> last;
  for (int frame = 0; frame < settings.frames; ++frame) {
    if (move && frame == change) {
      world.values[move->joint] = move->value;
    }
    lookFrom(distance_m, first_rad - std::copysign(settings.arc_deg * kDegree, first_rad) * frame / settings.frames, world);
    Random same_contents(contents_seed);
    const Picture picture =
        takePicture(world, settings.trial.world,
                    static_cast<std::uint64_t>(number) * static_cast<std::uint64_t>(settings.frames) + static_cast<std::uint64_t>(frame),
                    same_contents);
    last = registration.run(registration::makeScan(picture.depth_m, picture.camera, {}), world.T_map_camera, believed).joints;
    sightings.resize(last.size());
    for (std::size_t j = 0; j < last.size(); ++j) {
      sightings[j].push_back({.stamp_ns = frame * 100'000'000LL,
                              .T_map_camera = world.T_map_camera,
                              .status = last[j].status,
                              .confidence = last[j].confidence,
                              .evidence = last[j].evidence});
    }
  }
  std::vector<JointSequence> sequences;
  for (std::size_t j = 0; j < last.size(); ++j) {
    const auto index = static_cast<std::size_t>(last[j].joint);
    const bool has_moved = move && move->joint == index;
    sequences.push_back(judged(sightings[j], registration::fuse(sightings[j], settings.fusion),
                               has_moved ? static_cast<std::size_t>(change) : 0, world.values[index]));
    sequences.back().kind = world.kind;
    sequences.back().joint = last[j].name;
    sequences.back().is_turn = last[j].evidence.is_turn;
    sequences.back().has_moved = has_moved;
  }
  return sequences;
}

}  // namespace oikos::bench
