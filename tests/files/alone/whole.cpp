// Files that are whole or as they were, whatever the disk does.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <thread>

#include "files/file_error.h"
#include "files/whole_file.h"
#include "program.h"

namespace {

/// The n-th call of those below fails with this error, or is cut short where the error is 0. 0: none does.
std::atomic<int> calls{0}, failing_call{0}, failure{0};
std::atomic<int> umasks{0};
/// Whether the file system knows RENAME_NOREPLACE; over a network it does not.
std::atomic<bool> renames_without_replacing{false};
/// Whether closing says that the disk is full, as some network file systems do only then.
std::atomic<bool> closing_fails{false};
/// The calls on files, in order. w: write, s: fsync, n: rename or link, S: fsync of a folder.
std::string order;

template <class Call, class Short>
auto counted(Call&& call, Short&& cut_short) {
  if (++calls != failing_call) return call();
  if (failure == 0) return cut_short();
  errno = failure;
  return static_cast<decltype(call())>(-1);
}
template <class Call>
auto counted(Call&& call) {
  return counted(call, call);
}

}  // namespace

// These take the place of the C library's in this program.
extern "C" ssize_t write(int fd, const void* bytes, std::size_t size) {
  order += 'w';
  const auto call = [&](std::size_t n) { return static_cast<ssize_t>(::syscall(SYS_write, fd, bytes, n)); };
  return counted([&] { return call(size); }, [&] { return call((size + 1) / 2); });
}
extern "C" ssize_t pwrite(int fd, const void* bytes, std::size_t size, off_t offset) {
  const auto call = [&](std::size_t n) { return static_cast<ssize_t>(::syscall(SYS_pwrite64, fd, bytes, n, offset)); };
  return counted([&] { return call(size); }, [&] { return call((size + 1) / 2); });
}
extern "C" int fsync(int fd) {
  struct stat status {};
  order += ::fstat(fd, &status) == 0 && S_ISDIR(status.st_mode) ? 'S' : 's';
  return counted([&] { return static_cast<int>(::syscall(SYS_fsync, fd)); });
}
extern "C" int close(int fd) {
  const auto closed = static_cast<int>(::syscall(SYS_close, fd));
  if (!closing_fails) return closed;
  errno = ENOSPC;
  return -1;
}
extern "C" int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  order += 'n';
  return counted([&] { return static_cast<int>(::syscall(SYS_renameat, from_folder, from, to_folder, to)); });
}
extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to,
                         unsigned int flags) noexcept {
  if (renames_without_replacing) {
    order += 'n';
    return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
  }
  errno = EINVAL;
  return -1;
}
extern "C" int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  order += 'n';
  return counted([&] { return static_cast<int>(::syscall(SYS_linkat, from_folder, from, to_folder, to, flags)); });
}
extern "C" mode_t umask(mode_t mask) noexcept {
  ++umasks;
  return static_cast<mode_t>(::syscall(SYS_umask, mask));
}

namespace {

namespace fs = std::filesystem;
using roam::files::Naming;
using roam::files::WholeFile;
using roam::files::write_whole;

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

template <class Work>
std::string complaint(const Work& work) {
  try {
    work();
  } catch (const roam::Error& error) {
    return error.what();
  }
  return "";
}

std::size_t files_in(const TestFolder& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.file("")), fs::directory_iterator()));
}

/// Writes "first second" in two pieces, the second one first.
void write_in_pieces(const std::string& file) {
  WholeFile out(file);
  out.write_at(6, bytes_of("second"));
  out.write(bytes_of("first "));
  out.commit();
}

TEST(WholeFile, IsWholeOrAsItWasWhicheverCallFails) {
  const TestFolder folder;
  const std::string file = folder.file("a.txt");
  calls = 0;
  failing_call = 0;
  write_in_pieces(file);
  const int all = calls;
  ASSERT_GE(all, 5) << "two writes, the file's sync, the rename and the folder's sync";
  for (const int error : {EIO, ENOSPC, EDQUOT}) {
    for (int call = 1; call <= all; ++call) {
      folder.write("a.txt", "old");
      calls = 0;
      failure = error;
      failing_call = call;
      const std::string said = complaint([&] { write_in_pieces(file); });
      failing_call = 0;
      EXPECT_NE(said.find(std::strerror(error)), std::string::npos) << "call " << call << ": " << said;
      EXPECT_NE(said.find("roam-test-"), std::string::npos) << said;
      // The last call is the folder's sync, after the rename.
      EXPECT_EQ(folder.read("a.txt"), call == all ? "first second" : "old") << "call " << call;
      EXPECT_EQ(files_in(folder), 1U) << "call " << call;
    }
  }
}

TEST(WholeFile, GoesOnAfterInterruptedAndShortWrites) {
  const TestFolder folder;
  const std::string file = folder.file("a.txt");
  for (const int error : {EINTR, 0}) {
    for (int call = 1; call <= 3; ++call) {
      calls = 0;
      failure = error;
      failing_call = call;
      EXPECT_EQ(complaint([&] { write_in_pieces(file); }), "") << "call " << call;
      failing_call = 0;
      EXPECT_EQ(folder.read("a.txt"), "first second") << "call " << call;
    }
  }
}

TEST(WholeFile, SyncsItsTextBeforeItGetsItsNameAndItsFolderAfterwards) {
  for (const bool at_once : {false, true}) {
    renames_without_replacing = at_once;
    for (const Naming naming : {Naming::exact, Naming::beside, Naming::numbered, Naming::unclaimed}) {
      const TestFolder folder;
      order.clear();
      write_whole(folder.file("a.txt"), "text", naming);
      EXPECT_EQ(order, "wsnS") << static_cast<int>(naming) << at_once;
    }
  }
  renames_without_replacing = false;
}

TEST(WholeFile, IsAsItWasIfClosingSaysThatTheDiskIsFull) {
  for (const Naming naming : {Naming::exact, Naming::beside, Naming::numbered, Naming::unclaimed}) {
    const TestFolder folder;
    folder.write("a.txt", "old");
    const std::string said = complaint([&] {
      WholeFile out(folder.file("a.txt"), naming);
      out.write(bytes_of("new"));
      closing_fails = true;
      out.commit();
    });
    closing_fails = false;
    EXPECT_NE(said.find(std::strerror(ENOSPC)), std::string::npos) << said;
    EXPECT_EQ(folder.read("a.txt"), "old");
    EXPECT_EQ(files_in(folder), 1U);
  }
}

TEST(WholeFile, TakesFileSystemsThatSyncNoFolder) {
  const TestFolder folder;
  calls = 0;
  write_in_pieces(folder.file("a.txt"));
  failing_call = calls.load();
  calls = 0;
  failure = EINVAL;
  EXPECT_EQ(complaint([&] { write_in_pieces(folder.file("b.txt")); }), "");
  failing_call = 0;
  EXPECT_EQ(folder.read("b.txt"), "first second");
}

TEST(WholeFile, HasTheRightsOfAnyNewFileAndLeavesTheProcessesMaskAlone) {
  const TestFolder folder;
  const mode_t before = ::umask(027);
  const int counted_before = umasks;
  write_whole(folder.file("a.txt"), "text");
  EXPECT_EQ(umasks, counted_before) << "another thread's files would be writable for everybody meanwhile";
  ::umask(before);
  struct stat status {};
  ASSERT_EQ(::stat(folder.file("a.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST(WholeFile, TwoOfOneNameDoNotMix) {
  const TestFolder folder;
  const std::string file = folder.file("a.txt");
  WholeFile one(file), other(file);
  EXPECT_NE(one.temporary(), other.temporary());
  one.write(bytes_of("one"));
  other.write(bytes_of("other"));
  one.commit();
  EXPECT_EQ(folder.read("a.txt"), "one");
  other.commit();
  EXPECT_EQ(folder.read("a.txt"), "other");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(WholeFile, OfANameThatNobodyHadIsTheFirstOfAll) {
  for (const bool at_once : {false, true}) {
    renames_without_replacing = at_once;
    const TestFolder folder;
    const std::string file = folder.file("a.txt");
    const auto writer = [&] {
      return WholeFile(roam::files::Descriptor(::open(folder.file("").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
                       folder.file(""), "a.txt", 0600, Naming::unclaimed);
    };
    WholeFile one = writer(), other = writer();
    one.write(bytes_of("one"));
    other.write(bytes_of("other"));
    const fs::path first = one.commit();
    EXPECT_EQ(other.commit(), first);
    EXPECT_EQ(folder.read("a.txt"), "one");
    EXPECT_EQ(files_in(folder), 1U);
  }
  renames_without_replacing = false;
}

class NumberedFile : public testing::TestWithParam<bool> {
 protected:
  NumberedFile() { renames_without_replacing = GetParam(); }
  ~NumberedFile() override { renames_without_replacing = false; }
};
INSTANTIATE_TEST_SUITE_P(WhetherOrNotRenamingCanKeepAFile, NumberedFile, testing::Bool());

TEST_P(NumberedFile, ReplacesNothing) {
  const TestFolder folder;
  const std::string file = folder.file("a.txt");
  WholeFile one(file, Naming::numbered), other(file, Naming::numbered);
  one.write(bytes_of("one"));
  other.write(bytes_of("other"));
  // All of this came while they were written.
  folder.write("a-1.txt", "precious");
  fs::create_symlink("elsewhere.txt", folder.file("a-2.txt"));
  for (const char* name : {"a.txt", "a-3.txt"}) fs::create_directory(folder.file(name));
  EXPECT_EQ(one.commit(), folder.file("a-4.txt"));
  EXPECT_EQ(other.commit(), folder.file("a-5.txt"));
  EXPECT_EQ(folder.read("a-1.txt"), "precious");
  EXPECT_EQ(folder.read("a-4.txt"), "one");
  EXPECT_EQ(folder.read("a-5.txt"), "other");
  EXPECT_TRUE(fs::is_symlink(folder.file("a-2.txt")));
  EXPECT_EQ(files_in(folder), 6U);
  EXPECT_EQ(write_whole(folder.file("b"), "text", Naming::numbered), folder.file("b-1"));
}

TEST(WholeFile, ThatIsNumberedNamesInErrorsTheWholePathThatItWouldHaveGot) {
  const TestFolder folder;
  folder.write("a-1.txt", "precious");
  const fs::path before = fs::current_path();
  fs::current_path(folder.file(""));
  calls = 0;
  failure = ENOSPC;
  failing_call = 1;
  const std::string said = complaint([] { write_whole("a.txt", "text", Naming::numbered); });
  failing_call = 0;
  fs::current_path(before);
  EXPECT_NE(said.find("cannot write " + folder.file("a-2.txt") + ": "), std::string::npos) << said;
}

TEST(WholeFile, ThatIsNumberedNamesThatPathWhereItCannotBeMade) {
  const std::string said = complaint([] { write_whole("/proc/a.txt", "text", Naming::numbered); });
  EXPECT_NE(said.find("cannot write /proc/a-1.txt: "), std::string::npos) << said;
}

TEST(WholeFile, IsNumberedWhereAFileHasOneNameOnly) {
  const TestFolder folder;
  folder.write("a-1.txt", "precious");
  // After the write and the file's sync: once the name that is free, once the one that is taken.
  for (const int call : {4, 3}) {
    calls = 0;
    failure = EPERM;
    failing_call = call;
    const fs::path file = write_whole(folder.file("a.txt"), "text", Naming::numbered);
    failing_call = 0;
    EXPECT_EQ(file, folder.file(call == 4 ? "a-2.txt" : "a-3.txt"));
    EXPECT_EQ(folder.read(file.filename()), "text");
  }
  EXPECT_EQ(folder.read("a-1.txt"), "precious");
  EXPECT_EQ(files_in(folder), 3U);
}

TEST(WholeFile, IsWrittenThroughLinksThoughTheyLeadToNothingYet) {
  const TestFolder folder;
  fs::create_directory(folder.file("far"));
  fs::create_symlink("far/b.txt", folder.file("a.txt"));
  fs::create_symlink(folder.file("a.txt"), folder.file("first.txt"));
  for (const char* text : {"new", "newer"}) {
    EXPECT_EQ(write_whole(folder.file("first.txt"), text), folder.file("far/b.txt"));
    EXPECT_EQ(folder.read("far/b.txt"), text);
    EXPECT_TRUE(fs::is_symlink(folder.file("first.txt")) && fs::is_symlink(folder.file("a.txt")));
  }
  EXPECT_EQ(files_in(folder), 3U);
  fs::create_symlink("ring.txt", folder.file("ring.txt"));
  EXPECT_NE(complaint([&] { write_whole(folder.file("ring.txt"), "text"); }).find("cannot write"), std::string::npos);
}

TEST(WholeFile, IsWrittenThroughNoLinkThatAnotherUserPutIntoASharedFolder) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can make a link of another user";
  const TestFolder shared, own;
  constexpr uid_t thief = 12345;
  const auto plant = [&](const std::string& target, const char* name) {
    fs::create_symlink(target, shared.file(name));
    ASSERT_EQ(::lchown(shared.file(name).c_str(), thief, thief), 0);
  };
  own.write("precious.txt", "precious");
  plant(own.file("precious.txt"), "a.txt");
  plant(own.file("new.txt"), "b.txt");
  plant(own.file(""), "folder");
  for (const mode_t mode : {01777, 01770}) {
    ASSERT_EQ(::chmod(shared.file("").c_str(), mode), 0);
    for (const char* name : {"a.txt", "b.txt", "folder/new.txt"}) {
      const std::string said = complaint([&] { write_whole(shared.file(name), "text"); });
      EXPECT_NE(said.find("cannot write " + shared.file(name) + ": "), std::string::npos) << said;
      EXPECT_NE(said.find("is a link that another user put there; choose another place"), std::string::npos) << said;
    }
  }
  EXPECT_EQ(own.read("precious.txt"), "precious");
  EXPECT_EQ(files_in(own), 1U);
  EXPECT_EQ(files_in(shared), 3U);
  // One's own links and those of the folder's owner are followed, and all in a folder that is not sticky.
  ASSERT_EQ(::chmod(shared.file("").c_str(), 0777), 0);
  EXPECT_EQ(write_whole(shared.file("b.txt"), "text"), own.file("new.txt"));
  ASSERT_EQ(::chmod(shared.file("").c_str(), 01777), 0);
  ASSERT_EQ(::lchown(shared.file("b.txt").c_str(), 0, 0), 0);
  EXPECT_EQ(write_whole(shared.file("b.txt"), "text"), own.file("new.txt"));
  ASSERT_EQ(::chown(shared.file("").c_str(), thief, thief), 0);
  EXPECT_EQ(write_whole(shared.file("folder/new.txt"), "text"), shared.file("folder/new.txt"));
}

TEST(WholeFile, ReplacesOnlyItsLikeThoughThatComesWhileItIsWritten) {
  const TestFolder folder;
  const std::string file = folder.write("a.txt", "like 1");
  const roam::files::FileKind kind = roam::files::beginning_with("like", "like");
  {
    WholeFile out(file, Naming::exact, kind);
    out.write(bytes_of("like 2"));
    folder.write("a.txt", "precious");
    const std::string said = complaint([&] { out.commit(); });
    EXPECT_NE(said.find("cannot write " + file + ": this would overwrite a file that is no like"), std::string::npos)
        << said;
  }
  EXPECT_EQ(folder.read("a.txt"), "precious");
  EXPECT_NE(complaint([&] { WholeFile(file, Naming::beside, kind); }), "");
  EXPECT_EQ(files_in(folder), 1U);
  folder.write("a.txt", "");
  write_whole(file, "like 3", Naming::exact, kind);
  write_whole(file, "like 4", Naming::exact, kind);
  EXPECT_EQ(folder.read("a.txt"), "like 4");
}

TEST(WholeFile, ThatIsNamedByNobodyTakesThePlaceOfALink) {
  const TestFolder folder;
  folder.write("secret.txt", "precious");
  fs::create_symlink("secret.txt", folder.file("a.txt"));
  write_whole(folder.file("a.txt"), "text", Naming::beside);
  EXPECT_EQ(folder.read("secret.txt"), "precious");
  EXPECT_FALSE(fs::is_symlink(folder.file("a.txt")));
  EXPECT_EQ(folder.read("a.txt"), "text");
}

TEST(WholeFile, RemovesWhatAKilledProcessLeftOfItsNameAlone) {
  const TestFolder folder;
  folder.write("a.txt.1.0.unfinished", "left");
  folder.write("b.txt.1.0.unfinished", "left of another file");
  folder.write("a.txt.unfinished", "a person's own");
  WholeFile living(folder.file("a.txt"));
  living.write(bytes_of("still being written"));
  const int lock = ::open(folder.write("a.txt.1.1.unfinished", "of a process").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  write_whole(folder.file("a.txt"), "new");
  EXPECT_FALSE(fs::exists(folder.file("a.txt.1.0.unfinished")));
  EXPECT_TRUE(fs::exists(folder.file("a.txt.1.1.unfinished")));
  EXPECT_EQ(files_in(folder), 5U);
  living.commit();
  EXPECT_EQ(folder.read("a.txt"), "still being written");
  ::close(lock);
  write_whole(folder.file("a.txt"), "newer");
  EXPECT_EQ(files_in(folder), 3U);
}

TEST(WholeFile, TakesAnotherNameThanAProcessOfTheSameNumberLeft) {
  const TestFolder folder;
  std::string next;
  {
    const WholeFile probe(folder.file("a.txt"));
    next = probe.temporary().filename().string();
  }
  // "a.txt.<process>.<number>.unfinished"
  const std::size_t end = next.rfind('.'), begin = next.rfind('.', end - 1) + 1;
  const int number = std::stoi(next.substr(begin, end - begin));
  for (int i = 1; i <= 3; ++i) {
    folder.write(next.substr(0, begin) + std::to_string(number + i) + ".unfinished", "left");
  }
  write_whole(folder.file("a.txt"), "new");
  EXPECT_EQ(folder.read("a.txt"), "new");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(WholeFile, IsRemovedWhenTheProgramMustEndAtOnce) {
  const TestFolder folder;
  WholeFile file(folder.file("a.txt"));
  file.write(bytes_of("half"));
  EXPECT_EQ(files_in(folder), 1U);
  roam::files::Unfinished::remove_all();
  EXPECT_EQ(files_in(folder), 0U);
}

TEST(WholeFile, IsRemovedWhereItIsWhateverTookThePlaceOfItsFolder) {
  const TestFolder folder;
  fs::create_directory(folder.file("own"));
  const WholeFile file(folder.file("own/a.txt"));
  const std::string name = file.temporary().filename().string();
  fs::rename(folder.file("own"), folder.file("aside"));
  fs::create_directory(folder.file("theirs"));
  folder.write("theirs/" + name, "precious");
  fs::create_directory_symlink(folder.file("theirs"), folder.file("own"));
  roam::files::Unfinished::remove_all();
  EXPECT_TRUE(fs::exists(folder.file("theirs/" + name)));
  EXPECT_TRUE(fs::is_empty(folder.file("aside")));
}

TEST(WholeFile, IsRemovedWhenItIsNotCommitted) {
  const TestFolder folder;
  { WholeFile(folder.file("a.txt")).write(bytes_of("half")); }
  EXPECT_EQ(files_in(folder), 0U);
}

TEST(WholeFile, StaysInItsFolderWhenTheProgramGoesElsewhere) {
  const TestFolder folder, elsewhere;
  const fs::path before = fs::current_path();
  fs::current_path(folder.file(""));
  {
    WholeFile file("a.txt");
    fs::current_path(elsewhere.file(""));
    file.write(bytes_of("text"));
    file.commit();
  }
  fs::current_path(before);
  EXPECT_EQ(folder.read("a.txt"), "text");
  EXPECT_EQ(files_in(elsewhere), 0U);
}

TEST(WholeFile, RefusesWhatIsNoFileBeforeAnyWork) {
  const TestFolder folder;
  fs::create_directory(folder.file("folder"));
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/null", folder.file("device"));
  EXPECT_NE(complaint([&] { WholeFile(folder.file("folder")); }).find("directory"), std::string::npos);
  EXPECT_NE(complaint([&] { WholeFile(folder.file("pipe")); }).find("pipe or a device"), std::string::npos);
  EXPECT_NE(complaint([&] { WholeFile(folder.file("device")); }).find("pipe or a device"), std::string::npos);
  EXPECT_NE(complaint([&] { WholeFile(folder.file("absent/a.txt")); }).find("make its folder"), std::string::npos);
  EXPECT_NE(complaint([&] { WholeFile(folder.file(std::string(300, 'a'))); }).find("too long"), std::string::npos);
  EXPECT_NE(complaint([&] { WholeFile(""); }).find("empty"), std::string::npos);
  EXPECT_EQ(files_in(folder), 3U);
}

TEST(WholeFile, TakesTheLongestNamesThatFileSystemsTake) {
  const TestFolder folder;
  const std::string name(255, 'a');
  write_whole(folder.file(name), "text");
  EXPECT_EQ(folder.read(name), "text");
}

TEST(WholeFile, NeedsNoRightToListItsFolder) {
  const TestFolder folder;
  ASSERT_EQ(::chmod(folder.file("").c_str(), 0777), 0);
  fs::create_directory(folder.file("closed"));
  ASSERT_EQ(::chmod(folder.file("closed").c_str(), 0333), 0);
  constexpr uid_t nobody = 65534;
  const bool root = ::geteuid() == 0;
  if (root) {
    ASSERT_EQ(::seteuid(nobody), 0);
  }
  const std::string said = complaint([&] { write_whole(folder.file("closed/a.txt"), "text"); });
  if (root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_EQ(said, "");
  EXPECT_EQ(folder.read("closed/a.txt"), "text");
  ASSERT_EQ(::chmod(folder.file("closed").c_str(), 0777), 0);
}

TEST(WholeFile, ThreadsWriteTheirOwn) {
  const TestFolder folder;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 20; ++k) write_whole(folder.file("a.txt"), std::string(1000, static_cast<char>('a' + i)));
    });
  }
  for (std::thread& thread : threads) thread.join();
  const std::string text = folder.read("a.txt");
  EXPECT_EQ(text, std::string(1000, text[0]));
  EXPECT_EQ(files_in(folder), 1U);
}

}  // namespace
