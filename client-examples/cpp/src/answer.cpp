#include "answer.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "failure.hpp"

namespace singulate {

using nlohmann::json;

namespace {

/// What stands only where it says something.
std::optional<double> read_angle(const json& document, const char* name) {
  return document.contains(name) ? std::optional(document.at(name).get<double>()) : std::nullopt;
}

Pose read_pose(const json& pose) {
  return {pose.at("x").get<double>(), pose.at("y").get<double>(), read_angle(pose, "yaw")};
}

Grip read_grip(const json& grasp) {
  return {grasp.at("x").get<double>(), grasp.at("y").get<double>(), grasp.at("yaw").get<double>()};
}

std::vector<std::string> read_ids(const json& ids) { return ids.get<std::vector<std::string>>(); }

/// Ids; none where there is null.
std::vector<std::string> read_known(const json& ids) {
  return ids.is_null() ? std::vector<std::string>{} : read_ids(ids);
}

/// The core of a lock; no ids where there is none.
std::vector<std::string> read_core(const json& lock) {
  return lock.is_null() ? std::vector<std::string>{} : read_ids(lock.at("core"));
}

Step read_step(const json& step) {
  const auto action = step.at("action").get<std::string>();
  const auto object = step.at("object").get<std::string>();
  const Pose from = read_pose(step.at("from"));
  const Grip grasp = read_grip(step.at("grasp"));
  if (action == "pick_place") {
    return Relocation{object, from, read_pose(step.at("to")), grasp, read_grip(step.at("release")),
                      read_angle(step, "turn")};
  }
  if (action == "pick_drop") {
    return Removal{object, from, grasp, step.at("drop_off").get<std::string>()};
  }
  throw Failure(Exit::refused, "unknown action: " + action);
}

/// Reads all steps, so that a plan with an unknown action is refused before its first one.
Plan read_plan(const json& document, End end) {
  Plan plan{{}, std::move(end), document};
  for (const json& step : document.at("relocations")) {
    plan.steps.push_back(read_step(step));
  }
  return plan;
}

/// Without a target, objects are taken away and none is grasped in the end.
End read_end(const json& document) {
  if (document.at("target").is_null() && document.at("target_grasp").is_null()) {
    return AllAway{};
  }
  return Grasp{document.at("target").get<std::string>(), read_grip(document.at("target_grasp"))};
}

Plan read_plan_to_goal(const json& document, bool with_steps) {
  Plan plan = read_plan(document, read_end(document));
  if (plan.steps.empty() == with_steps) {
    throw Failure(Exit::refused, "the answer is not understood: the relocations do not go with the verdict");
  }
  return plan;
}

PartlyCleared read_remains(const json& document) {
  return {read_ids(document.at("left")), read_core(document.at("stuck")), document.at("proven").get<bool>()};
}

Answer read_verdict(const json& document) {
  const auto verdict = document.at("verdict").get<std::string>();
  if (verdict == "graspable" || verdict == "relocate") {
    return read_plan_to_goal(document, verdict == "relocate");
  }
  if (verdict == "cleared") {
    return read_plan(document, Cleared{});
  }
  if (verdict == "partly_cleared") {
    return read_plan(document, read_remains(document));
  }
  if (verdict == "deadlock") {
    return Deadlock{read_core(document.at("deadlock"))};
  }
  if (verdict == "no_space") {
    return NoSpace{read_known(document.at("needed"))};
  }
  if (verdict == "timed_out") {
    return TimedOut{read_known(document.at("needed"))};
  }
  throw Failure(Exit::refused, "unknown verdict: " + verdict);
}

/// Refuses what lacks a part.
template <typename Read>
auto understood(Read read, const json& document) {
  try {
    return read(document);
  } catch (const json::exception& fault) {
    throw Failure(Exit::refused, std::string("the answer is not understood: ") + fault.what());
  }
}

}  // namespace

Plan Plan::rest() const {
  Plan rest = *this;
  rest.steps.erase(rest.steps.begin());
  rest.body.at("relocations").erase(0);
  return rest;
}

bool Plan::is_done() const { return steps.empty() && !std::holds_alternative<Grasp>(end); }

Answer read_answer(const json& document) { return understood(read_verdict, document); }

bool read_replan(const json& document) {
  return understood([](const json& verification) { return verification.at("replan").get<bool>(); }, document);
}

}  // namespace singulate
