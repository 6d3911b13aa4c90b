#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "failure.hpp"

namespace singulate {

using std::chrono::milliseconds;

namespace {

// What the service takes where a scene says nothing, and the most that it gives unless configured otherwise.
constexpr milliseconds default_time_limit{1'000};
constexpr milliseconds longest_time_limit{60'000};

}  // namespace

Scene Scene::read(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw Failure(Exit::refused, path + " can't be read");
  }
  auto document = nlohmann::json::parse(file, nullptr, false);
  if (document.is_discarded()) {
    throw Failure(Exit::refused, path + " is not JSON");
  }
  return Scene(std::move(document));
}

milliseconds Scene::time_limit() const {
  static const nlohmann::json::json_pointer place("/settings/time_limit_ms");
  if (!document_.contains(place) || !document_.at(place).is_number()) {
    return default_time_limit;
  }
  // Clamped while it is a double: what the service will refuse need not fit any integer.
  const double most = static_cast<double>(longest_time_limit.count());
  return milliseconds(std::lround(std::clamp(document_.at(place).get<double>(), 0.0, most)));
}

Scene Scene::with_more_time() const {
  Scene scene = *this;
  scene.document_["settings"]["time_limit_ms"] = std::min(10 * time_limit(), longest_time_limit).count();
  return scene;
}

void Scene::place(const std::string& object, Point to) {
  auto& objects = document_.at("objects");
  const auto found = std::find_if(objects.begin(), objects.end(), [&](const auto& each) { return each.at("id") == object; });
  if (found == objects.end()) {
    throw Failure(Exit::refused, "the plan moves " + object + ", which is not in the scene");
  }
  (*found)["x"] = to.x;
  (*found)["y"] = to.y;
}

}  // namespace singulate
