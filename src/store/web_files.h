#pragma once
/// \file
/// The bytes of a store on a web server, and of its cache on the disk.

#include <memory>
#include <stop_token>
#include <string>

#include "store/bytes.h"

namespace roam::store {

/// A store's files on a web server.
struct WebStore {
  std::shared_ptr<StoreBytes> bytes;
  std::string name;  ///< the address without its query
};

/// Throws roam::Error for values out of range.
void check(const WebAccess& access);

/// Requests nothing yet. `stop` ends requests for whole files. Throws roam::Error for addresses and caches that cannot
/// be used.
[[nodiscard]] WebStore web_store(const std::string& address, const WebAccess& access, std::stop_token stop = {});

}  // namespace roam::store
