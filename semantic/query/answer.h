// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "semantic/query/home_index.h"

namespace oikos::semantic {

enum class AnswerStatus { kAnswered, kNothingFits, kUnknownWord, kNotUnderstood };
constexpr auto enumTable(AnswerStatus) {
  return std::to_array<base::EnumName<AnswerStatus>>({{AnswerStatus::kAnswered, "answered"},
                                                      {AnswerStatus::kNothingFits, "nothing_fits"},
                                                      {AnswerStatus::kUnknownWord, "unknown_word"},
                                                      {AnswerStatus::kNotUnderstood, "not_understood"}});
}

struct JointReading {
  std::string id;
  JointType type = JointType::kRevolute;
  double value = 0.0;  ///< rad or m
};

/// All that is known of one thing in an answer.
struct FoundThing {
  std::string id;
  std::string name;
  std::string room;    ///< id
  std::string parent;  ///< id; empty: none
  std::optional<Relation> relation;
  Eigen::Isometry3d T_map_thing = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> T_parent_thing;
  std::vector<Eigen::Isometry3d> T_map_base;  ///< parking poses in the order to try them
  std::vector<JointReading> joints_to_move;   ///< closed ones in the way, outermost first
  std::vector<JointReading> joints;           ///< its own, where the question is of its state
  std::string setting;                        ///< of a knob
  std::optional<std::int64_t> last_seen_ns;
  std::optional<double> confidence;
};

struct Answer {
  AnswerStatus status = AnswerStatus::kNotUnderstood;
  std::string sentence;
  std::vector<FoundThing> found;  ///< the first 20
  std::size_t total = 0;          ///< of all that fit
  std::vector<std::string> corrected;
};

/// Answers one question from the home as it stands. Never throws on any text. Thread-safe.
[[nodiscard]] Answer answerQuestion(const HomeIndex& index, std::string_view question);

/// {"status", "sentence", "total", "found": […], "corrected"}; metres and degrees.
[[nodiscard]] std::string toJson(const Answer& answer);

}  // namespace oikos::semantic
