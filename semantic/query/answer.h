// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "semantic/history/event.h"
#include "semantic/history/history.h"
#include "semantic/history/recollection.h"
#include "semantic/query/found_thing.h"
#include "semantic/query/home_index.h"

namespace oikos::semantic {

/// What a question is put to.
struct Inquiry {
  const HomeIndex* index = nullptr;      ///< of the home as it stands; never null
  const History* history = nullptr;      ///< null: nothing is known of the past
  std::int64_t now_ns = 0;               ///< since 1970, UTC
  std::optional<RobotPlace> robot;       ///< orders parking poses and what is near
  Recollection* recollection = nullptr;  ///< of the same history; null: each question reads the history
};

enum class AnswerStatus { kAnswered, kNothingFits, kUnknownWord, kNotUnderstood };
constexpr auto enumTable(AnswerStatus) {
  return std::to_array<base::EnumName<AnswerStatus>>({{AnswerStatus::kAnswered, "answered"},
                                                      {AnswerStatus::kNothingFits, "nothing_fits"},
                                                      {AnswerStatus::kUnknownWord, "unknown_word"},
                                                      {AnswerStatus::kNotUnderstood, "not_understood"}});
}

enum class StepKind { kGoTo, kOpen, kLook, kGrasp };
constexpr auto enumTable(StepKind) {
  return std::to_array<base::EnumName<StepKind>>(
      {{StepKind::kGoTo, "go_to"}, {StepKind::kOpen, "open"}, {StepKind::kLook, "look"}, {StepKind::kGrasp, "grasp"}});
}

/// One thing that the robot does to fetch something.
struct PlanStep {
  StepKind kind = StepKind::kGoTo;
  std::string id;                        ///< of what is opened (a joint), looked at or grasped; of where it goes
  std::vector<Eigen::Isometry3d> T_map;  ///< of the base, the handle or the grasp, in the order to try them
  std::string text;
};

/// One line of what happened.
struct Change {
  Event event;
  std::string thing;  ///< id of what a person would say has changed: of a joint the part that it moves
  std::string text;
};

struct Answer {
  AnswerStatus status = AnswerStatus::kNotUnderstood;
  std::string sentence;
  std::optional<bool> yes;                  ///< of questions that ask whether
  std::optional<std::size_t> count;         ///< of "how many"
  std::vector<FoundThing> found;            ///< the first 20
  std::size_t total = 0;                    ///< of all that fit
  std::vector<PlanStep> steps;              ///< of "bring me" and "how do I open", in their order
  std::vector<Change> changes;              ///< of the history; the last 20
  std::optional<std::int64_t> at_ns;        ///< the moment that the answer is about; nothing: the present
  std::vector<std::string> corrected;       ///< "was -> taken for"
  std::vector<std::string> not_understood;  ///< the words
  std::vector<std::string> suggestions;     ///< known words that are nearest to them
};

/// Answers one question. Never throws on any text; throws Error{kIo} if the history cannot be read. Thread-safe.
[[nodiscard]] Answer answerQuestion(const Inquiry& inquiry, std::string_view question);

/// Longer questions are refused.
constexpr std::size_t kMostQuestionBytes = 2000;

/// Metres, degrees, RFC 3339; on one line if `indent` is negative.
[[nodiscard]] std::string toJson(const Answer& answer, int indent = -1);

}  // namespace oikos::semantic
