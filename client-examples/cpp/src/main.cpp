// A cell controller in small: asks for a plan, does its first step, and asks again until the target can be grasped.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>

#include "failure.hpp"
#include "scene.hpp"
#include "service.hpp"

namespace singulate {

namespace {

// Each round moves one object; a table that needs more is not what this gripper is for.
constexpr int most_rounds = 100;

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

/// Stands for the robot: a real one picks and places here, and its camera says where the object came to lie.
void relocate(Scene& scene, const Relocation& step) {
  scene.place(step.object, step.to);
  std::cout << "move " << step.object << " from " << decimals(step.from.x) << ' ' << decimals(step.from.y) << " to "
            << decimals(step.to.x) << ' ' << decimals(step.to.y) << ", grasp at " << decimals(step.grasp_yaw)
            << ", release at " << decimals(step.release_yaw) << '\n';
}

/// What to do about each verdict. Says how the client ends, or nothing while there is more to do.
struct Follow {
  Scene& scene;

  std::optional<Exit> operator()(const Relocate& answer) const {
    relocate(scene, answer.first);
    return std::nullopt;
  }
  std::optional<Exit> operator()(const Graspable& answer) const {
    std::cout << "grasp " << answer.target << " at " << decimals(answer.yaw) << '\n';
    return Exit::graspable;
  }
  std::optional<Exit> operator()(const Deadlock& answer) const {
    print_ids("deadlock", answer.core, " hold each other");
    return Exit::deadlock;
  }
  std::optional<Exit> operator()(const NoSpace& answer) const {
    print_ids("no space", answer.needed, " would have to go");
    return Exit::no_space;
  }
  std::optional<Exit> operator()(const TimedOut& answer) const {
    print_ids("timed out", answer.needed, " would have to go");
    return Exit::timed_out;
  }
};

Exit run(const std::string& path) {
  const Library library;
  Service service(environment("SINGULATE_URL", "http://127.0.0.1:8080"), environment("SINGULATE_KEY", ""));
  Scene scene = Scene::read(path);
  for (int round = 0; round < most_rounds; ++round) {
    Answer answer = service.plan(scene);
    if (std::holds_alternative<TimedOut>(answer)) {
      answer = service.plan(scene.with_more_time());
    }
    if (const auto exit = std::visit(Follow{scene}, answer)) {
      return *exit;
    }
  }
  throw Failure(Exit::refused, "gave up: not graspable after " + std::to_string(most_rounds) + " moves");
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
