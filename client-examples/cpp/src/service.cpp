#include "service.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "failure.hpp"

namespace singulate {

using namespace std::chrono_literals;
using nlohmann::json;
using std::chrono::milliseconds;

namespace {

// After a lost connection; neither question changes anything, so to ask again is safe. One pause less than there are tries.
constexpr std::array pauses{200ms, 400ms, 800ms, 1'600ms};
// A service that wants more patience than this is down, as far as a robot is concerned.
constexpr std::chrono::seconds longest_wait = 60s;
// For the way there and back, on top of the time to plan.
constexpr milliseconds transfer = 5s;

/// No answer this time, but perhaps the next.
struct Again {
  std::string reason;
  std::optional<milliseconds> wait;  // the next pause where the service names none
};

/// What a problem document calls itself; something between client and service may answer without one.
std::string title(const json& problem, long status) {
  return problem.is_object() && problem.contains("title") && problem["title"].is_string()
             ? problem["title"].get<std::string>()
             : "HTTP " + std::to_string(status);
}

/// Every fault of the scene on a line of its own.
std::string faults(const json& problem) {
  std::ostringstream lines;
  try {
    for (const json& fault : problem.at("errors")) {
      lines << (lines.tellp() > 0 ? "\n" : "") << fault.at("code").get<std::string>() << ' '
            << fault.at("pointer").get<std::string>() << ": " << fault.at("detail").get<std::string>();
    }
  } catch (const json::exception&) {
    return title(problem, 422);
  }
  return lines.tellp() > 0 ? lines.str() : title(problem, 422);
}

std::variant<json, Again> judge(const Reply& reply) {
  json document = json::parse(reply.body, nullptr, false);
  switch (reply.status) {
    case 200:
      if (document.is_discarded()) {
        return Again{"the answer is cut off", std::nullopt};
      }
      return document;
    case 401:
    case 403:
      throw Failure(Exit::key_refused, title(document, reply.status));
    case 422:
      throw Failure(Exit::invalid_scene, faults(document));
    case 408:
    case 429:
    case 502:
    case 503:
    case 504:
      return Again{title(document, reply.status), std::clamp(reply.retry_after, 1s, longest_wait)};
    default:
      throw Failure(Exit::refused, title(document, reply.status));
  }
}

std::variant<json, Again> judge(const Lost& lost) { return Again{lost.reason, std::nullopt}; }

std::string without_slash(std::string url) {
  while (url.ends_with('/')) {
    url.pop_back();
  }
  return url;
}

}  // namespace

Service::Service(const std::string& url, const std::string& key) : connection_(without_slash(url), key) {}

Answer Service::plan(const Scene& scene) { return read_answer(ask("/v1/plans", scene.document(), scene.time_limit())); }

bool Service::replan(const Scene& scene, const Plan& left, double position_tolerance) {
  const json body{{"scene", scene.document()},
                  {"plan", left.body},
                  {"partial", true},
                  {"position_tolerance", position_tolerance}};
  return read_replan(ask("/v1/plans/verify", body, scene.time_limit()));
}

json Service::ask(const std::string& path, const json& body, milliseconds time_limit) {
  const std::string text = body.dump();
  for (std::size_t failed = 0;; ++failed) {
    const auto reply = connection_.post(path, text, time_limit + transfer);
    auto result = std::visit([](const auto& each) { return judge(each); }, reply);
    if (auto* answer = std::get_if<json>(&result)) {
      return std::move(*answer);
    }
    const auto& again = std::get<Again>(result);
    if (failed == pauses.size()) {
      throw Failure(Exit::refused, "gave up: " + again.reason);
    }
    const milliseconds wait = again.wait.value_or(pauses.at(failed));
    std::cerr << again.reason << "; asking again in " << wait.count() << " ms\n";
    std::this_thread::sleep_for(wait);
  }
}

}  // namespace singulate
