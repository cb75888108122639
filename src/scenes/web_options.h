#pragma once
/// \file
/// The options of verbs that take a store on a web server.

#include <memory>
#include <string>

#include "roam/store.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace roam::app {

/// Adds --cache and --redirects. An address given to `store` loses its query, which `web` keeps: messages and reports
/// show what is left.
void add_web_options(CLI::App& verb, CLI::Option& store, WebAccess& web);
/// The same for one more option that may take an address.
void take_query_of(CLI::Option& store, WebAccess& web);

}  // namespace roam::app
