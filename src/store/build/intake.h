#pragma once
/// \file
/// Reads a part of the scene into runs and a part file.

#include <string>
#include <vector>

#include "roam/import.h"
#include "store/build/work.h"
#include "store/manifest.h"
#include "store/part.h"

namespace roam::store {

/// What is known of a part.
struct PartRecord {
  PartInfo info;
  std::string id;  ///< names its files in the scratch folder; says of which part, and of which state of it
  struct Run {
    CurveKey first = 0, last = 0;  ///< keys
  };
  std::vector<Run> runs;
  bool has_runs = false;           ///< they are in the scratch folder
  std::vector<std::string> notes;  ///< of the import, each begins with the name of the part
};

/// How PartRecord::id follows from the part.
[[nodiscard]] std::string record_id(const std::string& name, const std::string& fingerprint);

/// The record that read_part left in the scratch folder, with the same key, when all that it tells of is there.
[[nodiscard]] std::optional<PartRecord> find_record(const Work& work, const std::string& id);

/// Reads the part, as one of so many `readers` at once, publishes its runs, its part file and, last, its record.
PartRecord read_part(Work& work, const ScenePart& part, const std::string& fingerprint, int readers);

// Keys in JSON: 32 hexadecimal digits.
[[nodiscard]] std::string key_text(CurveKey key);
/// Throws std::invalid_argument.
[[nodiscard]] CurveKey parse_key(const std::string& text);

}  // namespace roam::store
