#pragma once
/// \file
/// The last step of a build.

#include "store/build/plan.h"
#include "store/build/work.h"

namespace roam::store {

/// Thrown for shards of the plan that are missing or damaged. The damaged ones then count as missing.
class Incomplete : public Error {
 public:
  explicit Incomplete(const Error& error) : Error(error) {}
};

/// Makes one store of the shards of the plan and puts it in force. Then removes files that no manifest in force names,
/// and the scratch folder. The store must be locked. Returns sentences for the user, which may be empty; the first is
/// about a manifest that takes more than `usual` bytes. Throws Incomplete; TooLarge, before anything is put in force,
/// for a manifest that takes more than the memory of the build.
[[nodiscard]] std::vector<std::string> merge(Work& work, const Plan& plan, std::uint64_t usual = Store::usual_memory);

/// The files that the manifests in the store's folder name, in force or not, and their codes. Reads manifests that take
/// at most `memory` bytes. Throws roam::Error if one cannot be read.
[[nodiscard]] std::set<std::string> files_of_manifests(const Folder& store, std::uint64_t memory);

/// Removes files that no manifest in force names, and the scratch folder. Reads manifests that take at most `memory`
/// bytes. With `keeps_versions` all manifests count as in force. The store must be locked. Returns the result of
/// remove_scratch.
[[nodiscard]] std::string tidy(const Folder& store, std::uint64_t memory, bool keeps_versions = false);

/// Removes the files with which a build could continue. On failure returns a sentence for the user, else an empty text.
std::string remove_scratch(const Folder& store);

}  // namespace roam::store
