#pragma once

#include <chrono>
#include <curl/curl.h>
#include <memory>
#include <string>
#include <variant>

namespace singulate {

/// libcurl itself, for as long as connections are used; one in a program, made before there are threads.
class Library {
 public:
  Library();
  ~Library() { curl_global_cleanup(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

/// What the service said.
struct Reply {
  long status = 0;
  std::string body;
  std::chrono::seconds retry_after{};  // 0 where it named none
};

/// No complete reply came.
struct Lost {
  std::string reason;
};

/// Posts JSON to one service; the connection stays open from one call to the next.
class Connection {
 public:
  /// An empty key is not sent.
  Connection(const std::string& url, const std::string& key);
  [[nodiscard]] std::variant<Reply, Lost> post(const std::string& path, const std::string& body,
                                               std::chrono::milliseconds time_limit);

 private:
  struct Free {
    void operator()(CURL* handle) const noexcept { curl_easy_cleanup(handle); }
    void operator()(curl_slist* list) const noexcept { curl_slist_free_all(list); }
  };
  void add_header(const std::string& line);

  std::string url_;
  // The handle points at the list, and so goes first.
  std::unique_ptr<curl_slist, Free> headers_;
  std::unique_ptr<CURL, Free> handle_;
};

}  // namespace singulate
