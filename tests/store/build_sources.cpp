// What a build reads of the scene's files to know whether they have changed.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>

#include "program.h"
#include "roam/error.h"
#include "store/build/fingerprint.h"

namespace {

namespace fs = std::filesystem;
using roam::store::Sources;

constexpr std::uint64_t mebibyte = 1 << 20;

/// Fingerprints of one part a file, each of the same name. `most`: MiB that may be hashed until it is given up.
std::vector<std::string> fingerprints(const std::vector<std::string>& files, std::int64_t most) {
  const TestFolder folder;
  std::vector<roam::store::SourcePart> parts;
  for (const std::string& file : files) {
    roam::store::SourcePart part;
    part.name = "part";
    part.path = file;
    part.files = {file};
    parts.push_back(part);
  }
  Sources sources(folder.file(""), std::nullopt, {});
  std::atomic<std::int64_t> ticks = 0;
  sources.look(parts, [&] {
    // Once for each file besides.
    if (++ticks > most + 2 * static_cast<std::int64_t>(files.size())) throw roam::Cancelled();
  });
  std::vector<std::string> found;
  for (const roam::store::SourcePart& part : parts) found.push_back(sources.fingerprint(part, ""));
  return found;
}

/// A file of `size` bytes that holds only `texts`, at their offsets.
std::string sparse(const std::string& file, std::uint64_t size,
                   const std::vector<std::pair<std::uint64_t, char>>& texts) {
  const int descriptor = ::open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600);
  EXPECT_EQ(::ftruncate(descriptor, static_cast<off_t>(size)), 0) << "this file system has no holes";
  for (const auto& [offset, text] : texts) {
    EXPECT_EQ(::pwrite(descriptor, &text, 1, static_cast<off_t>(offset)), 1);
  }
  ::close(descriptor);
  return file;
}

TEST(StoreSources, HashHolesAsTheZerosThatTheyRead) {
  const TestFolder folder;
  // Parts of one name in two folders: only contents differ.
  for (const char* name : {"holes", "zeros"}) fs::create_directory(folder.file(name));
  const std::uint64_t size = 9 * mebibyte + 5;
  const std::string holes = sparse(folder.file("holes/part"), size, {{3 * mebibyte + 7, 'a'}, {7 * mebibyte, 'b'}});
  std::string bytes(size, '\0');
  bytes[3 * mebibyte + 7] = 'a';
  bytes[7 * mebibyte] = 'b';
  const std::string zeros = folder.write("zeros/part", bytes);
  const auto found = fingerprints({holes, zeros}, 40);
  EXPECT_EQ(found[0], found[1]);
  bytes[8 * mebibyte] = 'c';
  (void)folder.write("zeros/part", bytes);
  EXPECT_NE(fingerprints({zeros}, 40)[0], found[0]);
}

TEST(StoreSources, RefuseAFileThatIsAHole) {
  const TestFolder folder;
  const std::string file =
      sparse(folder.file("hole"), std::uint64_t{8} << 40, {{0, 'a'}, {std::uint64_t{1} << 40, 'b'}});
  try {
    (void)fingerprints({file}, 1000);
    ADD_FAILURE() << "it was hashed";
  } catch (const roam::Cancelled&) {
    ADD_FAILURE() << "it would have been hashed for hours";
  } catch (const roam::Error& error) {
    const std::string what = error.what();
    EXPECT_TRUE(what.find("hole") != std::string::npos && what.find(file) != std::string::npos) << what;
  }
}

TEST(StoreSources, ReadAFileOnceWhateverItsNames) {
  const TestFolder folder;
  const std::string file = folder.write("file", std::string(8 * mebibyte, 'x'));
  std::vector<std::string> names{file};
  for (int i = 0; i < 40; ++i) {
    names.push_back(folder.file("link" + std::to_string(i)));
    if (i % 2 == 0) {
      fs::create_symlink(file, names.back());
    } else {
      fs::create_hard_link(file, names.back());
    }
  }
  const auto found = fingerprints(names, 16);
  // A copy is another file, and says the same.
  fs::create_directory(folder.file("copy"));
  EXPECT_EQ(fingerprints({folder.write("copy/file", std::string(8 * mebibyte, 'x'))}, 16)[0], found[0]);
}

TEST(StoreSources, ReadNoPipeAndNothingOutsideThatTookAFilesPlace) {
  const TestFolder folder;
  fs::create_directories(folder.file("scene/inner"));
  folder.write("secret", "secret");
  folder.write("inner/file", "secret");
  const std::string slow = folder.write("scene/a", std::string(4 * mebibyte, 'x'));
  const std::string file = folder.write("scene/inner/file", "text");
  const auto said = [&](const std::function<void()>& swap) {
    fs::remove_all(folder.file("scene/inner"));
    fs::remove_all(folder.file("aside"));
    fs::create_directory(folder.file("scene/inner"));
    folder.write("scene/inner/file", "text");
    roam::store::SourcePart part;
    part.name = "part";
    part.path = slow;
    part.files = {slow, file};
    Sources sources(folder.file(""), std::nullopt, {});
    try {
      swap();
      sources.look({part}, [] {});
      sources.check_unchanged(part, {part, sources.scope(slow), 0});
    } catch (const roam::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(said([] {}), "");
  const auto refused = [&](const std::function<void()>& swap) {
    EXPECT_NE(said(swap).find("cannot read " + file), std::string::npos) << said(swap);
  };
  refused([&] {
    fs::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  });
  refused([&] {
    fs::remove(file);
    fs::create_symlink(folder.file("secret"), file);
  });
  refused([&] {
    fs::rename(folder.file("scene/inner"), folder.file("aside"));
    fs::create_directory_symlink(folder.file("inner"), folder.file("scene/inner"));
  });
  // One that stays in the scene is followed.
  EXPECT_EQ(said([&] {
              fs::rename(file, folder.file("scene/other"));
              fs::create_symlink(folder.file("scene/other"), file);
            }),
            "");
}

}  // namespace
