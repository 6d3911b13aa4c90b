#include "connection.hpp"

#include <cstdlib>
#include <exception>

#include "failure.hpp"

namespace singulate {

namespace {

/// Called by libcurl, which is C: nothing may be thrown through it. A short count ends the transfer.
std::size_t collect(char* bytes, std::size_t size, std::size_t count, void* body) noexcept {
  try {
    static_cast<std::string*>(body)->append(bytes, size * count);
    return size * count;
  } catch (const std::exception&) {
    return 0;
  }
}

template <typename Value>
void set(CURL* handle, CURLoption option, Value value) {
  if (const CURLcode code = curl_easy_setopt(handle, option, value); code != CURLE_OK) {
    throw Failure(Exit::refused, curl_easy_strerror(code));
  }
}

/// No address of HTTP, or a certificate that is not trusted: asking again changes neither.
bool is_for_good(CURLcode code) {
  return code == CURLE_UNSUPPORTED_PROTOCOL || code == CURLE_URL_MALFORMAT || code == CURLE_PEER_FAILED_VERIFICATION ||
         code == CURLE_SSL_CACERT_BADFILE;
}

}  // namespace

Library::Library() {
  if (const CURLcode code = curl_global_init(CURL_GLOBAL_DEFAULT); code != CURLE_OK) {
    throw Failure(Exit::refused, curl_easy_strerror(code));
  }
}

Connection::Connection(const std::string& url, const std::string& key) : url_(url), handle_(curl_easy_init()) {
  if (!handle_) {
    throw Failure(Exit::refused, "libcurl made no handle");
  }
  add_header("Content-Type: application/json");
  add_header("Accept: application/json");
  if (!key.empty()) {
    add_header("Authorization: Bearer " + key);
  }
  set(handle_.get(), CURLOPT_HTTPHEADER, headers_.get());
  set(handle_.get(), CURLOPT_WRITEFUNCTION, &collect);
  set(handle_.get(), CURLOPT_NOSIGNAL, 1L);
  // The key is for this address alone.
  set(handle_.get(), CURLOPT_FOLLOWLOCATION, 0L);
  // The program curl reads it; the library leaves that to who uses it.
  if (const char* authorities = std::getenv("CURL_CA_BUNDLE"); authorities != nullptr) {
    set(handle_.get(), CURLOPT_CAINFO, authorities);
  }
}

void Connection::add_header(const std::string& line) {
  curl_slist* longer = curl_slist_append(headers_.get(), line.c_str());
  if (longer == nullptr) {
    throw Failure(Exit::refused, "libcurl has no memory for headers");
  }
  // It is the same list but for the first time.
  static_cast<void>(headers_.release());
  headers_.reset(longer);
}

std::variant<Reply, Lost> Connection::post(const std::string& path, const std::string& body,
                                           std::chrono::milliseconds time_limit) {
  Reply reply;
  set(handle_.get(), CURLOPT_URL, (url_ + path).c_str());
  set(handle_.get(), CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
  set(handle_.get(), CURLOPT_POSTFIELDS, body.c_str());
  set(handle_.get(), CURLOPT_TIMEOUT_MS, static_cast<long>(time_limit.count()));
  set(handle_.get(), CURLOPT_WRITEDATA, &reply.body);
  if (const CURLcode code = curl_easy_perform(handle_.get()); code != CURLE_OK) {
    if (is_for_good(code)) {
      throw Failure(Exit::refused, curl_easy_strerror(code));
    }
    return Lost{curl_easy_strerror(code)};
  }
  curl_off_t seconds = 0;
  curl_easy_getinfo(handle_.get(), CURLINFO_RESPONSE_CODE, &reply.status);
  curl_easy_getinfo(handle_.get(), CURLINFO_RETRY_AFTER, &seconds);
  reply.retry_after = std::chrono::seconds(seconds);
  return reply;
}

}  // namespace singulate
