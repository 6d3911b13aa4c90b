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

/// Reads all of them, so that a plan with an unknown action is refused before its first step.
Relocate read_relocations(const json& relocations) {
  std::vector<Relocation> read;
  for (const json& relocation : relocations) {
    read.push_back(read_relocation(relocation));
  }
  return {read.at(0)};
}

Answer read_verdict(const json& document) {
  const auto verdict = document.at("verdict").get<std::string>();
  if (verdict == "graspable") {
    return Graspable{document.at("target").get<std::string>(), read_yaw(document.at("target_grasp"))};
  }
  if (verdict == "relocate") {
    return read_relocations(document.at("relocations"));
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

}  // namespace

Answer read_answer(const json& document) {
  try {
    return read_verdict(document);
  } catch (const json::exception& fault) {
    throw Failure(Exit::refused, std::string("the answer is not understood: ") + fault.what());
  } catch (const std::out_of_range&) {
    throw Failure(Exit::refused, "the answer is not understood: relocate without a relocation");
  }
}

}  // namespace singulate
