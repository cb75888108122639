#pragma once
/// \file
/// Reads a part of the scene into runs and a part file.

#include <string>
#include <vector>

#include "import/parts.h"
#include "import/processor_budget.h"
#include "store/build/fingerprint.h"
#include "store/build/references.h"
#include "store/build/work.h"
#include "store/json_reader.h"
#include "store/manifest.h"
#include "store/part.h"

namespace roam::store {

/// The known facts of a part.
struct PartRecord {
  PartInfo info;
  std::string id;  ///< names its runs in the scratch folder
  struct Run {
    CurveKey first = 0, last = 0;  ///< keys
    std::uint64_t hash = 0;        ///< of write_run
  };
  std::vector<Run> runs;
  bool has_runs = false;           ///< the runs are in the scratch folder
  std::vector<std::string> notes;  ///< of the import; each begins with the name of the part
  // Only of a part that was read just now:
  std::uint64_t content = 0;                 ///< XXH3 of what was read
  std::optional<std::string> confinement{};  ///< see note_of_confinement; of this machine, so no note of the store
};

/// For the files of the scratch folder. Leaves out has_runs, content and confinement.
[[nodiscard]] Json json_of(const PartRecord& record);
/// The reverse. Throws an exception if the JSON does not hold a record.
[[nodiscard]] PartRecord record_of(const Json& json);

/// Computes PartRecord::id. `fingerprint`: of what is known of the part before it is read.
[[nodiscard]] std::string record_id(const std::string& name, const std::string& fingerprint);

/// A record in the scratch folder, and the files that its part was read from.
struct RecordOfFiles {
  PartRecord record;
  SceneFiles files;
};
/// Reads the record that publish_record, perhaps on another machine, wrote with the same key. Returns nothing if the
/// part file is incomplete, if a run is missing or has another end, or if the record is too large for one.
[[nodiscard]] std::optional<RecordOfFiles> find_record(Work& work, const std::string& name);
void publish_record(const Work& work, const PartRecord& record, const SceneFiles& files);

/// Reads the part, as one of `readers` that run at once. Publishes its runs and its part file. The record lacks
/// fingerprint and references. `budget`: of all parts.
PartRecord read_part(Work& work, const ScenePart& part, const std::string& id, int readers, LookUps& look_ups,
                     reader::SceneBudget& budget);

// Keys in JSON: 32 hexadecimal digits.
[[nodiscard]] std::string key_text(CurveKey key);
/// Throws std::invalid_argument.
[[nodiscard]] CurveKey parse_key(const std::string& text);

}  // namespace roam::store
