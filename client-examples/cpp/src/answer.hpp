#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

namespace singulate {

struct Point {
  double x = 0;
  double y = 0;
};

struct Relocation {
  std::string object;
  Point from;
  Point to;
  double grasp_yaw = 0;
  double release_yaw = 0;
};

/// What is left to do: the steps, then the grasp of the target.
struct Plan {
  std::vector<Relocation> steps;
  std::string target;
  double yaw = 0;
  nlohmann::json body;  // the same as the service has put it

  /// What is left after the first step.
  [[nodiscard]] Plan rest() const;
};

/// Nothing ever frees the target: these hold each other.
struct Deadlock {
  std::vector<std::string> core;
};

/// These would have to go, but no places for them were found.
struct NoSpace {
  std::vector<std::string> needed;
};

/// These would have to go as far as is known; time ran out.
struct TimedOut {
  std::vector<std::string> needed;
};

using Answer = std::variant<Plan, Deadlock, NoSpace, TimedOut>;

/// Refuses what it does not understand, above all verdicts and actions of later versions.
[[nodiscard]] Answer read_answer(const nlohmann::json& document);

/// Whether a verification asks for a new plan.
[[nodiscard]] bool read_replan(const nlohmann::json& document);

}  // namespace singulate
