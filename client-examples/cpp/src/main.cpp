// A cell controller in small: asks for a plan, does its first step, and goes on with the plan as long as it holds, until the
// goal is reached.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <utility>

#include "failure.hpp"
#include "scene.hpp"
#include "service.hpp"

namespace singulate {

namespace {

// Each round moves one object; a table that needs more is not what this gripper is for.
constexpr int most_rounds = 100;
// How far beside its place an object may be seen, m: the errors of this cell's robot and camera.
constexpr double position_tolerance = 0.005;

std::string environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr ? otherwise : value;
}

/// Three decimals, and no -0.000.
std::string decimals(double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.3f", std::abs(value) < 0.0005 ? 0.0 : value);
  return text.data();
}

/// The verdict alone where there are no ids.
void print_ids(const char* verdict, const std::vector<std::string>& ids, const char* rest) {
  std::cout << verdict;
  for (const std::string& id : ids) {
    std::cout << (&id == &ids.front() ? ": " : ", ") << id;
  }
  std::cout << (ids.empty() ? "" : rest) << '\n';
}

std::string place(const Pose& at) {
  return decimals(at.x) + ' ' + decimals(at.y) + (at.yaw ? ' ' + decimals(*at.yaw) : "");
}

std::string place(const Grip& at) { return place(Pose{at.x, at.y, at.yaw}); }

/// Stands for the robot: a real one picks and places here, and its camera says where the object came to lie.
struct CarryOut {
  Scene& scene;

  void operator()(const Relocation& step) const {
    scene.put(step.object, step.to);
    std::cout << "move " << step.object << " from " << place(step.from) << " to " << place(step.to)
              << (step.turn ? ", turned by " + decimals(*step.turn) : "") << ", grasp at " << place(step.grasp)
              << ", release at " << place(step.release) << '\n';
  }
  void operator()(const Removal& step) const {
    scene.take_away(step.object, step.drop_off);
    std::cout << "take " << step.object << " from " << place(step.from) << " away to " << step.drop_off << ", grasp at "
              << place(step.grasp) << '\n';
  }
};

/// The end of a plan without steps.
struct Finish {
  Exit operator()(const Grasp& grasp) const {
    std::cout << "grasp " << grasp.target << " at " << place(grasp.grip) << '\n';
    return Exit::reached;
  }
  Exit operator()(const AllAway&) const {
    std::cout << "all taken away\n";
    return Exit::reached;
  }
  Exit operator()(const Cleared&) const {
    std::cout << "cleared\n";
    return Exit::reached;
  }
  Exit operator()(const PartlyCleared& end) const {
    if (!end.stuck.empty()) {
      print_ids("stuck", end.stuck, " hold each other");
    }
    print_ids("partly cleared", end.left, end.proven ? " left" : " left, as far as is known");
    return Exit::partly_cleared;
  }
};

/// What comes too late is asked for once more, with ten times the time.
Answer planned(Service& service, const Scene& scene) {
  Answer answer = service.plan(scene);
  return std::holds_alternative<TimedOut>(answer) ? service.plan(scene.with_more_time()) : answer;
}

/// What to do about each verdict: the next answer to follow, or how the client ends.
struct Follow {
  using Next = std::variant<Answer, Exit>;

  Service& service;
  Scene& scene;

  Next operator()(const Plan& plan) const {
    if (plan.steps.empty()) {
      return std::visit(Finish{}, plan.end);
    }
    std::visit(CarryOut{scene}, plan.steps.front());
    const Plan left = plan.rest();
    const bool replan = !left.is_done() && service.replan(scene, left, position_tolerance);
    return replan ? planned(service, scene) : left;
  }
  Next operator()(const Deadlock& answer) const {
    print_ids("deadlock", answer.core, " hold each other");
    return Exit::deadlock;
  }
  Next operator()(const NoSpace& answer) const {
    print_ids("no space", answer.needed, " would have to go");
    return Exit::no_space;
  }
  Next operator()(const TimedOut& answer) const {
    print_ids("timed out", answer.needed, " would have to go");
    return Exit::timed_out;
  }
};

Exit run(const std::string& path) {
  const Library library;
  Service service(environment("SINGULATE_URL", "http://127.0.0.1:8080"), environment("SINGULATE_KEY", ""));
  Scene scene = Scene::read(path);
  Answer answer = planned(service, scene);
  for (int round = 0; round < most_rounds; ++round) {
    Follow::Next next = std::visit(Follow{service, scene}, answer);
    if (const auto* exit = std::get_if<Exit>(&next)) {
      return *exit;
    }
    answer = std::get<Answer>(std::move(next));
  }
  throw Failure(Exit::refused, "gave up: the goal is not reached after " + std::to_string(most_rounds) + " moves");
}

}  // namespace

}  // namespace singulate

int main(int count, char** arguments) {
  using singulate::Exit;
  if (count != 2) {
    std::cerr << "usage: singulate-client SCENE.json\n";
    return static_cast<int>(Exit::refused);
  }
  try {
    return static_cast<int>(singulate::run(arguments[1]));
  } catch (const singulate::Failure& failure) {
    std::cerr << failure.what() << '\n';
    return static_cast<int>(failure.exit());
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(Exit::refused);
  }
}
