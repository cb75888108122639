#include "import/page_reader.h"

#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "import/display.h"
#include "import/find_reader.h"
#include "import/part_receiver.h"
#include "import/processor_budget.h"
#include "import/reader_process.h"
#include "import/reading.h"
#include "import/report_notes.h"
#include "import/stream.h"
#include "roam/error.h"

namespace roam {
namespace {

/// Most readers at a time; each file with pages needs its own. More such files are seldom near the eye together.
constexpr std::size_t reader_limit = 4;

}  // namespace

struct PageReader::Reader {
  std::uint32_t source = 0;
  reader::Reading reading;
  std::unique_ptr<reader::ReaderProcess> process{};
};

PageReader::PageReader(std::vector<std::filesystem::path> paths, const ImportOptions& options)
    : paths_(std::move(paths)), options_(options) {}

PageReader::~PageReader() = default;

PageReader::Reader& PageReader::reader_of(std::uint32_t source, const Vec3& origin) {
  for (auto at = readers_.begin(); at != readers_.end(); ++at) {
    if (at->source != source) continue;
    readers_.splice(readers_.begin(), readers_, at);
    return readers_.front();
  }
  if (readers_.size() == reader_limit) readers_.pop_back();
  Reader made;
  made.source = source;
  made.reading.program = reader::find_reader(options_.reader);
  made.reading.path = paths_.at(source);
  made.reading.scope = reader::scope_of(made.reading.path, options_);
  made.reading.options = &options_;
  made.reading.wanted = reader::Reading::Wanted::pages;
  made.reading.origin = origin;
  made.reading.report_progress = [this](std::uint64_t, std::uint64_t) {
    if (cancelled_) throw Cancelled();
  };
  return readers_.emplace_front(std::move(made));
}

DisplayPart PageReader::read(std::uint32_t source, const Vec3& origin, const std::string& page) {
  const std::lock_guard lock(mutex_);
  if (cancelled_) throw Cancelled();
  Reader& one = reader_of(source, origin);
  if (one.process == nullptr || one.process->has_ended()) one.process = reader::start(one.reading);

  DisplayReport report;
  std::optional<Vec3> known = origin;
  std::optional<DisplayPart> read;
  const std::function<bool(DisplayPart &&)> give = [&](DisplayPart&& part) {
    read = std::move(part);
    return report.parts == 1;
  };
  reader::PartReceiver receiver(report, known, options_.ignore.size(), options_.memory_limit, give);
  try {
    auto budget = reader::ProcessorBudget::from_now_on(one.process->id());
    one.process->request(page);
    reader::receive(one.reading, *one.process, receiver, std::move(budget));
  } catch (...) {
    // A reader that itself reported the error stays usable.
    if (!receiver.ended()) one.process.reset();
    throw;
  }
  if (!read) {
    one.process.reset();
    throw Error("the reader of a page sent none; it is not the roam-reader of this version. Install roam anew.");
  }
  read->source = source;
  read->missing = report.import.missing_pages;
  read->notes = std::move(report.import.notes);
  if (auto note = reader::note_of_missing_images(report.missing_textures, report.missing_texture_files)) {
    read->notes.push_back(std::move(*note));
  }
  return std::move(*read);
}

}  // namespace roam
