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

 private:
  Connection connection_;
};

}  // namespace singulate
