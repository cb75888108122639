#pragma once
/// \file
/// The parts of a scene, what is known of each, and the reading of those that have changed.

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "import/parts.h"
#include "import/processor_budget.h"
#include "store/build/fingerprint.h"
#include "store/build/intake.h"
#include "store/build/work.h"
#include "store/manifest.h"

namespace roam::store {

/// The parts of the scene. Throws as scene_parts.
[[nodiscard]] std::vector<ScenePart> listed_parts(Work& work);

class SceneReader {
 public:
  /// `records` becomes that of all parts, in order. Files whose SHA-256 is in `damaged` count as missing. Throws
  /// roam::Error for options that are too long.
  SceneReader(Work& work, std::vector<ScenePart> parts, const std::set<std::string>& damaged, StoreBuildReport& report,
              std::vector<PartRecord>& records);

  /// text_of(ImportOptions)
  [[nodiscard]] const std::string& options() const { return options_; }
  /// The numbers of all parts.
  [[nodiscard]] std::vector<std::size_t> all() const;
  /// Those of one of `shares` shares, which take about equally long to read. The same scene gives the same shares.
  [[nodiscard]] std::vector<std::size_t> share(std::uint64_t i, std::uint64_t shares) const;

  /// Collects the known facts of these parts without reading them: from the scratch folder, then from the store in
  /// force.
  void take_records(const std::optional<Manifest>& in_force, const std::vector<std::size_t>& numbers);
  /// Parts among them that must be read in any case.
  [[nodiscard]] const std::vector<std::size_t>& unknown() const { return unknown_; }

  /// Those of these parts whose triangles are not in the scratch folder.
  [[nodiscard]] std::vector<std::size_t> without_runs(std::vector<std::size_t> numbers) const;

  /// Reads these parts, several at once if memory allows. Returns false if there are none.
  bool read(const std::vector<std::size_t>& numbers);
  /// Keeps the references of all parts within the limit of a manifest.
  void limit_references();
  /// See Sources.
  void save() const { sources_.save(); }

 private:
  /// A part as it was read, and the files that decide whether it has changed since.
  struct Earlier {
    std::size_t part;
    PartRecord record;
    SourcePart sources;
  };
  std::vector<Earlier> earlier_parts(const std::optional<Manifest>& in_force, const std::vector<std::size_t>& numbers);
  void look(const std::vector<SourcePart>& parts);
  void read_one(std::size_t i, int readers);
  [[nodiscard]] bool is_there(const PartInfo& info) const;

  Work& work_;
  std::vector<ScenePart> parts_;
  const std::set<std::string>& damaged_;
  StoreBuildReport& report_;
  std::vector<PartRecord>& records_;
  std::string options_;
  Sources sources_;
  reader::SceneBudget budget_;
  std::vector<std::size_t> unknown_;
};

}  // namespace roam::store
