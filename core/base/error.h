// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace oikos::base {

/// What kind of thing went wrong outside the program; the command line turns it into its exit code.
enum class ErrorCode {
  kUsage = 2,  ///< the user asked for something that does not exist or makes no sense
  kInput = 3,  ///< a file, key or value that was read is wrong
  kIo = 4,     ///< the operating system refused: no such file, no space, no permission
};

/// A failure of the outside world. `what()` is one line for a person: "WHERE: WHAT", where WHERE is a path (with ":line" or
/// ":key") and WHAT says what was found and what would be right.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& what, const std::string& where = {});

  [[nodiscard]] ErrorCode code() const { return code_; }
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  ErrorCode code_;
  std::string where_;
};

/// A broken contract between two pieces of this program: a bug, never the user's fault.
class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void throwContractViolation(const char* condition, const char* file, int line);

}  // namespace oikos::base

/// Active in every build.
#define OIKOS_CHECK(condition)                                               \
  do {                                                                       \
    if (!(condition)) {                                                      \
      ::oikos::base::throwContractViolation(#condition, __FILE__, __LINE__); \
    }                                                                        \
  } while (false)
