#pragma once

#include "answer.hpp"
#include "connection.hpp"
#include "scene.hpp"

namespace singulate {

/// The planning service, asked until it answers.
class Service {
 public:
  Service(const std::string& url, const std::string& key);
  [[nodiscard]] Answer plan(const Scene& scene);
  /// Whether what is left of a plan can't be carried out any more on the table as it is now.
  [[nodiscard]] bool replan(const Scene& scene, const Plan& left, double position_tolerance);

 private:
  [[nodiscard]] nlohmann::json ask(const std::string& path, const nlohmann::json& body,
                                   std::chrono::milliseconds time_limit);

  Connection connection_;
};

}  // namespace singulate
