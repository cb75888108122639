#pragma once
/// \file
/// Source of the bytes of a part file of an open store, for visit_part.

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "roam/error.h"
#include "store/files.h"
#include "store/opened.h"
#include "store/part.h"

namespace roam::store {

/// Thrown when bytes of a part file cannot be read.
struct PartUnread : Error {
  PartUnread(const std::string& name, const char* reason)
      : Error(Error::at(name, fmt::format("{} cannot be used: {}", name, reason))), why(reason) {}
  const char* why;  ///< the cause alone
};

/// Returns the bytes of a part file piece by piece and hashes them. Throws Cancelled once `stop` is requested.
class PartBytes {
 public:
  PartBytes(const Store::State& store, const PartInfo& part, std::stop_token stop = {})
      : store_(store), part_(part), file_(part_file(part.file)), stop_(std::move(stop)) {}

  std::size_t operator()(std::span<std::byte> out) {
    out = out.first(static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), part_.bytes - at_)));
    if (out.empty()) return 0;
    const char* const problem = store_.bytes->read(file_, at_, out, stop_);
    if (stop_.stop_requested()) throw Cancelled();
    if (problem) throw PartUnread(name(), problem);
    hash_.add(out);
    at_ += out.size();
    return out.size();
  }
  /// Visits the content. Throws PartDamage, also if the counts are not those of the manifest.
  void visit(PartVisitor visitor) {
    visitor.counts = [&](const PartCounts& counts) {
      if (counts.triangles != part_.triangles || counts.objects != part_.objects) {
        throw PartDamage(name(), "its counts are not those of the manifest");
      }
    };
    visit_part([&](std::span<std::byte> out) { return (*this)(out); }, part_.bytes, name(), visitor);
  }
  /// Whether the file is as it was written. Reads the rest of it.
  [[nodiscard]] bool is_whole() {
    std::vector<std::byte> rest(std::min<std::uint64_t>(part_.bytes - at_, 1U << 17));
    while ((*this)(rest) > 0) {
    }
    return hash_.digits() == part_.file;
  }
  [[nodiscard]] std::string name() const { return store_.name + "/" + file_; }

 private:
  const Store::State& store_;
  const PartInfo& part_;
  std::string file_;
  std::uint64_t at_ = 0;
  Sha256 hash_;
  std::stop_token stop_;
};

}  // namespace roam::store
