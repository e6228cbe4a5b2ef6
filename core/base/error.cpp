// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"

namespace oikos::base {

Error::Error(ErrorCode code, const std::string& what, const std::string& where)
    : std::runtime_error(where.empty() ? what : where + ": " + what), code_(code), where_(where) {}

void throwContractViolation(const char* condition, const char* file, int line) {
  throw ContractViolation(std::string(file) + ":" + std::to_string(line) + ": contract broken: " + condition);
}

}  // namespace oikos::base
