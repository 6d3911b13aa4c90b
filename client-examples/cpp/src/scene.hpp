#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>

#include "answer.hpp"

namespace singulate {

/// The table as the client knows it, in the words of the request.
class Scene {
 public:
  /// Any JSON will do: what makes a scene is for the service to say.
  static Scene read(const std::string& path);

  [[nodiscard]] const nlohmann::json& document() const { return document_; }
  [[nodiscard]] std::chrono::milliseconds time_limit() const;
  /// The same scene with ten times the time to plan, as far as the service gives it.
  [[nodiscard]] Scene with_more_time() const;
  /// Puts an object elsewhere.
  void put(const std::string& object, Pose to);
  /// Takes an object away to a drop-off. One that is then full is left out, and what is away is no longer wanted away.
  void take_away(const std::string& object, const std::string& drop_off);

 private:
  explicit Scene(nlohmann::json document) : document_(std::move(document)) {}
  nlohmann::json document_;
};

}  // namespace singulate
