#include "answer.hpp"

#include <nlohmann/json.hpp>

#include "failure.hpp"

namespace singulate {

using nlohmann::json;

namespace {

Point read_point(const json& point) { return {point.at("x").get<double>(), point.at("y").get<double>()}; }

double read_yaw(const json& grasp) { return grasp.at("yaw").get<double>(); }

/// Ids; none where there is null.
std::vector<std::string> read_ids(const json& ids) {
  return ids.is_null() ? std::vector<std::string>{} : ids.get<std::vector<std::string>>();
}

Relocation read_relocation(const json& relocation) {
  const auto action = relocation.at("action").get<std::string>();
  if (action != "pick_place") {
    throw Failure(Exit::refused, "unknown action: " + action);
  }
  return {relocation.at("object").get<std::string>(), read_point(relocation.at("from")), read_point(relocation.at("to")),
          read_yaw(relocation.at("grasp")), read_yaw(relocation.at("release"))};
}

/// Reads all steps, so that a plan with an unknown action is refused before its first one.
Plan read_plan(const json& document, bool with_steps) {
  Plan plan{{}, document.at("target").get<std::string>(), read_yaw(document.at("target_grasp")), document};
  for (const json& relocation : document.at("relocations")) {
    plan.steps.push_back(read_relocation(relocation));
  }
  if (plan.steps.empty() == with_steps) {
    throw Failure(Exit::refused, "the answer is not understood: the relocations do not go with the verdict");
  }
  return plan;
}

Answer read_verdict(const json& document) {
  const auto verdict = document.at("verdict").get<std::string>();
  if (verdict == "graspable" || verdict == "relocate") {
    return read_plan(document, verdict == "relocate");
  }
  if (verdict == "deadlock") {
    const json& deadlock = document.at("deadlock");
    return Deadlock{deadlock.is_null() ? std::vector<std::string>{} : read_ids(deadlock.at("core"))};
  }
  if (verdict == "no_space") {
    return NoSpace{read_ids(document.at("needed"))};
  }
  if (verdict == "timed_out") {
    return TimedOut{read_ids(document.at("needed"))};
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

Answer read_answer(const json& document) { return understood(read_verdict, document); }

bool read_replan(const json& document) {
  return understood([](const json& verification) { return verification.at("replan").get<bool>(); }, document);
}

}  // namespace singulate
