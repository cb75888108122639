#include "store/build/fingerprint.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <tbb/parallel_for.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string_view>

#include "roam/error.h"
#include "store/authentic.h"
#include "store/build/layout.h"
#include "store/files.h"
#include "store/json_reader.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Nanoseconds. A file that is changed twice within what the file system's clock can tell apart (2 s on FAT) has the
/// same time, but not the same content.
constexpr std::int64_t clock_steps = 3'000'000'000;
/// Of what is remembered of files: some 100,000 of them. More is forgotten.
constexpr std::uint64_t sources_memory = 128u << 20;

std::uint64_t hash_of_file(const fs::path& file, const std::function<void()>& tick) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const auto fail = [&] { throw Error(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno))); };
  if (descriptor < 0) fail();
  const std::unique_ptr<const int, void (*)(const int*)> closer(&descriptor, [](const int* d) { ::close(*d); });
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
  XXH3_64bits_reset(state.get());
  std::vector<std::byte> piece(1 << 20);
  for (;;) {
    const ssize_t got = ::read(descriptor, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail();
    if (got == 0) return XXH3_64bits_digest(state.get());
    XXH3_64bits_update(state.get(), piece.data(), static_cast<std::size_t>(got));
    tick();
  }
}

/// The name of a file of a part, the same wherever the scene lies.
std::string name_in(const ScenePart& part, const fs::path& file) {
  const fs::path inside = file.lexically_relative(part.path);
  const bool outside = inside.empty() || inside == "." || *inside.begin() == "..";
  return outside ? file.filename().string() : inside.string();
}

}  // namespace

std::string text_of(const ImportOptions& options) {
  Json json = {{"up", nullptr}, {"metres_per_unit", metres_per(options.unit)}, {"ignore", options.ignore}};
  if (options.up) json["up"] = std::string(1, "xyz"[static_cast<int>(*options.up)]);
  if (!options.allow.empty()) {
    json["allow"] = Json::array();
    for (const fs::path& folder : options.allow)
      json["allow"].push_back(fs::absolute(folder).lexically_normal().string());
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void read_as(const std::string& text, ImportOptions& options) {
  ImportOptions read = options;
  bool known = false;
  try {
    const Json json = Json::parse(text);
    read.up.reset();
    for (const UpAxis up : {UpAxis::x, UpAxis::y, UpAxis::z}) {
      if (json.at("up") == std::string(1, "xyz"[static_cast<int>(up)])) read.up = up;
    }
    for (const LengthUnit unit : {LengthUnit::m, LengthUnit::cm, LengthUnit::mm, LengthUnit::ft, LengthUnit::in}) {
      if (json.at("metres_per_unit") == metres_per(unit)) read.unit = unit;
    }
    read.ignore = json.at("ignore").get<std::vector<std::string>>();
    // Which folders a scene may refer to is the user's word, never a store's.
    if (json.value("allow", Json::array()) != Json::parse(text_of(options)).value("allow", Json::array())) {
      throw Error("the store was built with other folders allowed (--allow): repair it with the same");
    }
    known = text_of(read) == text;
  } catch (const Json::exception&) {
    known = false;
  }
  if (!known) {
    throw Error("the store was read in a way that this program does not know (" + text +
                "): repair it with the program that built it, or build it again");
  }
  options = std::move(read);
}

Sources::Sources(fs::path store, const std::optional<StoreKey>& key) : store_(std::move(store)), key_(key) {
  if (!size_of(store_, sources_file)) return;
  if (*size_of(store_, sources_file) > sources_memory / 4) return;
  const std::optional<std::string> text = read_coded(store_, sources_file, sources_memory / 4, key_);
  if (!text) return;
  try {
    check_json(*text, sources_file, sources_memory);
  } catch (const Error&) {
    return;
  }
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object()) return;
  for (const auto& [name, item] : json.items()) {
    if (!item.is_array() || item.size() != 3 || !item[0].is_number_unsigned() || !item[1].is_number_integer() ||
        !item[2].is_number_unsigned()) {
      continue;
    }
    known_[name] = {item[0].get<std::uint64_t>(), item[1].get<std::int64_t>(), item[2].get<std::uint64_t>(), true};
  }
}

Sources::Seen Sources::status(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    throw Error(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)));
  }
  std::timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  const auto ns = [](const std::timespec& t) { return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec; };
  return {static_cast<std::uint64_t>(status.st_size), ns(status.st_mtim), 0,
          ns(now) - ns(status.st_mtim) > clock_steps};
}

void Sources::look(const std::vector<ScenePart>& parts, const std::function<void()>& tick) {
  std::vector<std::pair<std::string, Seen>> files;
  for (const ScenePart& part : parts) {
    for (const fs::path& file : part.files) files.push_back({fs::absolute(file).lexically_normal().string(), {}});
  }
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    auto& [name, seen] = files[i];
    seen = status(name);
    const auto known = known_.find(name);
    if (known != known_.end() && known->second.size == seen.size && known->second.changed_ns == seen.changed_ns) {
      seen.hash = known->second.hash;
      seen.settled = true;
    } else {
      seen.hash = hash_of_file(name, tick);
    }
    tick();
  });
  seen_.insert(files.begin(), files.end());
}

std::string Sources::fingerprint(const ScenePart& part, const std::string& options) const {
  std::string text = fmt::format("roam part 1\n{}\n{}\n{}\n", options, part.name, part.tile);
  if (part.frame) {
    const Vec3& o = part.frame->origin;
    text += fmt::format("{} {} {} {}\n", part.frame->srs, o.x, o.y, o.z);
  }
  for (const fs::path& file : part.files) {
    const Seen& seen = seen_.at(fs::absolute(file).lexically_normal().string());
    text += fmt::format("{:016x} {} {}\n", seen.hash, seen.size, name_in(part, file));
  }
  return sha256(std::as_bytes(std::span(text)));
}

void Sources::check_unchanged(const ScenePart& part) const {
  for (const fs::path& file : part.files) {
    const std::string name = fs::absolute(file).lexically_normal().string();
    const Seen before = seen_.at(name), now = status(name);
    if (before.size != now.size || before.changed_ns != now.changed_ns) {
      throw Error(fmt::format("{} was changed while the scene was read; build again when it is finished", name));
    }
  }
}

void Sources::save() const {
  std::map<std::string, Seen> settled;
  for (const auto& [name, seen] : seen_) {
    if (seen.settled) settled.insert({name, seen});
  }
  if (settled == known_) return;
  Json json = Json::object();
  for (const auto& [name, seen] : settled) json[name] = {seen.size, seen.changed_ns, seen.hash};
  // A path that is no UTF-8 is not found again, and its file read again.
  write_coded(store_, sources_file, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n", key_);
}

}  // namespace roam::store
