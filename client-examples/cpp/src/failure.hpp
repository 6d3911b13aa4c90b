#pragma once

#include <stdexcept>
#include <string>

namespace singulate {

/// How the client ends.
enum class Exit {
  reached = 0,
  refused = 1,
  invalid_scene = 2,
  deadlock = 3,
  no_space = 4,
  timed_out = 5,
  key_refused = 6,
  partly_cleared = 7,
};

/// Why there is no answer: words for stderr, and how the client ends.
class Failure : public std::runtime_error {
 public:
  Failure(Exit exit, const std::string& words) : std::runtime_error(words), exit_(exit) {}
  [[nodiscard]] Exit exit() const noexcept { return exit_; }

 private:
  Exit exit_;
};

}  // namespace singulate
