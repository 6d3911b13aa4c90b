#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace singulate {

/// Of an object: its own frame, or the centre of a disc.
struct Pose {
  double x = 0;
  double y = 0;
  std::optional<double> yaw;  // none for a disc that may be grasped at every yaw
};

/// Of the gripper: its axis, and the direction of finger 0.
struct Grip {
  double x = 0;
  double y = 0;
  double yaw = 0;
};

/// To another place on the table.
struct Relocation {
  std::string object;
  Pose from;
  Pose to;
  Grip grasp;
  Grip release;
  std::optional<double> turn;  // how far the object turns on the way, if that is said, rad
};

/// Away from the table.
struct Removal {
  std::string object;
  Pose from;
  Grip grasp;
  std::string drop_off;
};

using Step = std::variant<Relocation, Removal>;

/// The target can be grasped.
struct Grasp {
  std::string target;
  Grip grip;
};

/// All that is wanted away is away.
struct AllAway {};

struct Cleared {};

/// These stay on the table.
struct PartlyCleared {
  std::vector<std::string> left;
  std::vector<std::string> stuck;  // those that lock themselves
  bool proven = false;             // false if more could perhaps be taken away
};

using End = std::variant<Grasp, AllAway, Cleared, PartlyCleared>;

/// What is left to do: the steps, then what comes of them.
struct Plan {
  std::vector<Step> steps;
  End end;
  nlohmann::json body;  // the same as the service has put it

  /// What is left after the first step.
  [[nodiscard]] Plan rest() const;
  /// Whether the robot has nothing left to do.
  [[nodiscard]] bool is_done() const;
};

/// Nothing ever reaches the goal: these hold each other.
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
