#pragma once
/// \file
/// Builds the store of a scene while a person roams in it.

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "roam/pager.h"
#include "roam/store_build.h"
#include "view/loading.h"
#include "view/store_choice.h"

namespace roam::app {

/// Builds in a thread of its own with low priority, what is near to the body first, and makes the pager that the body
/// can then change to. When it is cancelled, what is done is kept in the store's folder: another one goes on from
/// there.
class StoreBuilder {
 public:
  /// `memory`: bytes of the pager.
  StoreBuilder(const SceneAndStore& what, const WalkerSettings& walker, const Vec3& place, std::uint64_t memory);

  /// Lets the building come to its end; does not wait for that, as the destructor does.
  void cancel() { loading_.cancel(); }
  /// Reading, indexing (of the shards), looking (waiting for what is around the body), done or failed.
  [[nodiscard]] LoadState state() const { return loading_.state(); }
  /// Where the store is, or will be.
  [[nodiscard]] const std::filesystem::path& output() const { return output_; }
  /// Where the body is now.
  void follow(const Vec3& place);
  /// A pager with what is around the body, once, when it is done; else null. It belongs to the caller's thread from
  /// then on.
  [[nodiscard]] std::shared_ptr<Pager> take();
  /// What the builder says of the scene; of one that is done.
  [[nodiscard]] std::vector<std::string> notes();

 private:
  void build();
  bool goes_on(const StoreBuildProgress& progress);
  [[nodiscard]] Vec3 place();

  SceneAndStore what_;
  std::filesystem::path output_;
  WalkerSettings walker_;
  std::uint64_t memory_;
  Vec3 place_;
  std::shared_ptr<Pager> pager_;
  std::vector<std::string> notes_;
  Loading loading_;
};

}  // namespace roam::app
