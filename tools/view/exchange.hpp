// What a browser asks and what it is answered, without sockets.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hmlfc::view {

/// Names and values, percent-decoded, in the order of the address.
using Query = std::vector<std::pair<std::string, std::string>>;

/// One request. Everything in it comes from outside.
struct Request {
  std::string method = "GET";
  std::string path;    ///< percent-decoded, from the first slash on
  Query query;         ///< behind the question mark
  std::string host;    ///< header Host, empty where missing
  std::string origin;  ///< header Origin, empty where missing
  std::string site;    ///< header Sec-Fetch-Site, empty where missing
};

/// One answer.
struct Response {
  int status = 200;
  std::string type = "application/json; charset=utf-8";
  std::string body{};
  std::vector<std::pair<std::string, std::string>> headers{};  ///< besides those of guard.hpp
  std::shared_ptr<const void> open{};  ///< unless null: the answer has no end, while it lives
};

}  // namespace hmlfc::view
