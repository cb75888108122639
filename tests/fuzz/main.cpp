// The entries that libFuzzer calls, and what the targets share.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fuzz.h"
#include "roam/error.h"

namespace {

namespace fs = std::filesystem;

const fuzz::Target* chosen = nullptr;

void save(const fs::path& file, std::string_view content) {
  std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

/// Seeds in the folder, and a dictionary in the form of libFuzzer and AFL, which must not be empty.
void write_seeds(const fs::path& folder) {
  fs::create_directories(folder);
  int number = 0;
  for (const std::string& seed : chosen->seeds()) {
    save(folder / (std::string("seed-") + std::to_string(number++)), seed);
  }
  std::string words = "\"\\x00\"\n";
  for (const std::string_view word : chosen->words) {
    words += '"';
    for (const char c : word) {
      std::array<char, 5> code{};
      std::snprintf(code.data(), code.size(), "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      words += code.data();
    }
    words += "\"\n";
  }
  save(folder.string() + ".words", words);
}

}  // namespace

namespace fuzz {

std::vector<Target>& targets() {
  static std::vector<Target> all;
  return all;
}

void fail(const std::string& what) {
  std::fprintf(stderr, "%s: %s\n", std::string(chosen->name).c_str(), what.c_str());
  std::abort();
}

std::string complaint_of(void (*use)(const void*), const void* context) {
  std::string said;
  try {
    use(context);
    return {};
  } catch (const roam::Error& error) {
    said = error.what();
  } catch (const std::exception& error) {
    fail(std::string("an exception that is no roam::Error: ") + error.what());
  }
  demand(!said.empty(), "an error without a message");
  const bool printable = std::none_of(said.begin(), said.end(), [](unsigned char c) { return c < 32 || c == 127; });
  if (!printable) fail("a message with control characters: " + said);
  return said;
}

const std::string& folder() {
  struct Folder {
    std::string name;
    Folder() {
      name = (fs::temp_directory_path() / "roam-fuzz-XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr) fail("no folder for files");
    }
    // A finding ends the process before: fuzz.sh and check.sh remove the folder above.
    ~Folder() {
      std::error_code ignored;
      fs::remove_all(name, ignored);
    }
  };
  static const Folder own;
  return own.name;
}

std::string write(const std::string& name, std::string_view content) {
  std::string file = folder() + '/' + name;
  save(file, content);
  return file;
}

}  // namespace fuzz

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  constexpr std::string_view target = "--target=", seeds = "--seeds=";
  std::string folder;
  for (int i = 1; i < *count; ++i) {
    const std::string_view argument = (*arguments)[i];
    if (argument.starts_with(seeds)) folder = argument.substr(seeds.size());
    if (!argument.starts_with(target)) continue;
    for (const fuzz::Target& known : fuzz::targets()) {
      if (known.name == argument.substr(target.size())) chosen = &known;
    }
  }
  if (chosen == nullptr) {
    for (const fuzz::Target& known : fuzz::targets()) std::printf("%s\n", std::string(known.name).c_str());
    std::exit(EXIT_FAILURE);
  }
  if (!folder.empty()) write_seeds(folder);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen->run({data, size});
  return 0;
}
