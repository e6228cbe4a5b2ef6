// SPDX-License-Identifier: Apache-2.0
// From a request to its response: one function a route, see routes.cpp and schemas/openapi.yaml.
#pragma once

#include "tools/daemon/routes.h"

namespace oikos::daemon {

// ask_handler.cpp
[[nodiscard]] Response answerAsk(const Call& call);

// home_handlers.cpp
[[nodiscard]] Response answerHome(const Call& call);
[[nodiscard]] Response answerRooms(const Call& call);
[[nodiscard]] Response answerObjects(const Call& call);
[[nodiscard]] Response answerObject(const Call& call);

// history_handlers.cpp
[[nodiscard]] Response answerObjectHistory(const Call& call);
[[nodiscard]] Response answerChanges(const Call& call);
[[nodiscard]] Response answerState(const Call& call);
[[nodiscard]] Response answerEvents(const Call& call);

// observation_handler.cpp
[[nodiscard]] Response takeObservations(const Call& call);

// status_handlers.cpp
[[nodiscard]] Response answerHealth(const Call& call);
[[nodiscard]] Response answerReadiness(const Call& call);
[[nodiscard]] Response answerMetrics(const Call& call);

}  // namespace oikos::daemon
