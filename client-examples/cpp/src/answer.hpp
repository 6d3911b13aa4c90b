#pragma once

#include <nlohmann/json_fwd.hpp>
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

/// The target can be grasped as the table stands.
struct Graspable {
  std::string target;
  double yaw = 0;
};

/// The first of the relocations that free the target. The others are asked for again once this one is done.
struct Relocate {
  Relocation first;
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

using Answer = std::variant<Graspable, Relocate, Deadlock, NoSpace, TimedOut>;

/// Refuses what it does not understand, above all verdicts and actions of later versions.
[[nodiscard]] Answer read_answer(const nlohmann::json& document);

}  // namespace singulate
