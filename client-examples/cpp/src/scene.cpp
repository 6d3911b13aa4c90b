#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <utility>

#include "failure.hpp"

namespace singulate {

using nlohmann::json;
using std::chrono::milliseconds;

namespace {

// What the service takes where a scene says nothing, and the most that it gives unless configured otherwise.
constexpr milliseconds default_time_limit{1'000};
constexpr milliseconds longest_time_limit{60'000};

/// Where the item with this id is in a list of the scene.
json::iterator find(json& document, const std::string& list, const std::string& id) {
  json& items = document[list];
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& each) { return each.at("id") == id; });
  if (found == items.end()) {
    throw Failure(Exit::refused, "the plan names " + id + ", which is not among the " + list + " of the scene");
  }
  return found;
}

}  // namespace

Scene Scene::read(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw Failure(Exit::refused, path + " can't be read");
  }
  auto document = json::parse(file, nullptr, false);
  if (document.is_discarded()) {
    throw Failure(Exit::refused, path + " is not JSON");
  }
  return Scene(std::move(document));
}

milliseconds Scene::time_limit() const {
  static const json::json_pointer place("/settings/time_limit_ms");
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

void Scene::put(const std::string& object, Pose to) {
  const auto found = find(document_, "objects", object);
  (*found)["x"] = to.x;
  (*found)["y"] = to.y;
  if (to.yaw) {
    (*found)["yaw"] = *to.yaw;
  }
}

void Scene::take_away(const std::string& object, const std::string& drop_off) {
  const auto gone = find(document_, "objects", object);
  const auto filled = find(document_, "drop_offs", drop_off);
  document_["objects"].erase(gone);
  if (filled->contains("capacity")) {
    const auto capacity = filled->at("capacity").get<std::int64_t>() - 1;
    if (capacity > 0) {
      (*filled)["capacity"] = capacity;
    } else {
      document_["drop_offs"].erase(filled);
    }
  }
  static const json::json_pointer wanted("/goal/all_of");
  if (document_.contains(wanted)) {
    auto& ids = document_.at(wanted);
    ids.erase(std::remove(ids.begin(), ids.end(), json(object)), ids.end());
  }
}

}  // namespace singulate
