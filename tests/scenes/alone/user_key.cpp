// The user's key, while somebody else moves folders about.
#include "scenes/user_key.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdarg>
#include <filesystem>
#include <functional>
#include <string>

#include "program.h"

namespace {

int calls = 0;
/// Before the call of this number, counted from 1; 0: never.
int exchanging_call = 0, restoring_call = 0;
std::function<void(bool forged)> exchange;

void count() {
  ++calls;
  if (calls == exchanging_call) exchange(true);
  if (calls == restoring_call) exchange(false);
}

}  // namespace

// These take the place of the C library's in this program.
extern "C" int openat(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  count();
  return static_cast<int>(::syscall(SYS_openat, folder, path, flags, mode));
}
extern "C" int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return openat(AT_FDCWD, path, flags, mode);
}
extern "C" int fstatat(int folder, const char* path, struct stat* status, int flags) noexcept {
  count();
  return static_cast<int>(::syscall(SYS_newfstatat, folder, path, status, flags));
}
extern "C" int stat(const char* path, struct stat* status) noexcept { return fstatat(AT_FDCWD, path, status, 0); }
extern "C" int fstat(int file, struct stat* status) noexcept {
  count();
  return static_cast<int>(::syscall(SYS_fstat, file, status));
}

namespace {

namespace fs = std::filesystem;
using roam::app::made_user_key;
using roam::app::user_key;

/// A folder for the user's data, with the folder of the key.
class UserKey : public testing::Test {
 protected:
  UserKey() {
    setenv("XDG_DATA_HOME", data_.c_str(), 1);
    fs::create_directory(data_);
    fs::create_directory(own_);
  }

  void make_forged() const {
    fs::remove_all(forged_);
    fs::create_directory(forged_);
    folder_.write("data/forged/store.key", std::string(64, '7') + "\n");
    // By this it is known that they are not the user's alone.
    fs::permissions(forged_, fs::perms::all);
    fs::permissions(forged_ + "/store.key", fs::perms::others_read, fs::perm_options::add);
  }
  [[nodiscard]] static bool is_forged(const roam::app::UserKey& key) {
    return key.key && key.key->bytes[0] == std::byte{0x77} && key.key->bytes[31] == std::byte{0x77};
  }
  [[nodiscard]] static bool is_refused(const std::string& why) {
    const roam::app::UserKey read = user_key(), made = made_user_key();
    EXPECT_FALSE(read.key || made.key);
    EXPECT_NE(std::string(read.problem.what()).find(why), std::string::npos) << read.problem.what();
    EXPECT_NE(std::string(made.problem.what()).find(why), std::string::npos) << made.problem.what();
    return !read.key && !made.key;
  }

  const TestFolder folder_;
  const std::string data_ = folder_.file("data"), own_ = data_ + "/roam", forged_ = data_ + "/forged",
                    away_ = data_ + "/away";
};

TEST_F(UserKey, IsNeverTakenFromAFolderThatTakesThePlaceOfItsOwn) {
  bool exchanged = false;
  exchange = [&](bool forged) {
    if (forged == exchanged) return;
    exchanged = forged;
    fs::rename(own_, forged ? away_ : forged_);
    fs::rename(forged ? forged_ : away_, own_);
  };
  for (const bool makes : {false, true}) {
    const auto get = [&](int first, int last) {
      if (makes) fs::remove(own_ + "/store.key");
      make_forged();
      calls = 0;
      exchanging_call = first;
      restoring_call = last;
      const roam::app::UserKey key = makes ? made_user_key() : user_key();
      exchanging_call = restoring_call = 0;
      exchange(false);
      return key;
    };
    ASSERT_TRUE(made_user_key().key) << made_user_key().problem.what();
    ASSERT_TRUE(get(0, 0).key);
    const int all = calls;
    ASSERT_GE(all, 3);
    for (int first = 1; first <= all; ++first) {
      for (int last = first + 1; last <= all + 1; ++last) {
        EXPECT_FALSE(is_forged(get(first, last)))
            << "exchanged before call " << first << ", restored before call " << last;
      }
    }
  }
}

TEST_F(UserKey, IsRefusedWhereOthersMayExchangeItsFolder) {
  ASSERT_TRUE(made_user_key().key);
  for (const fs::perms others : {fs::perms::others_write, fs::perms::group_write}) {
    fs::permissions(data_, others, fs::perm_options::add);
    EXPECT_TRUE(is_refused("chmod +t " + data_));
    // There only owners may rename.
    fs::permissions(data_, fs::perms::sticky_bit, fs::perm_options::add);
    EXPECT_TRUE(user_key().key) << user_key().problem.what();
    fs::permissions(data_, others | fs::perms::sticky_bit, fs::perm_options::remove);
  }
  EXPECT_TRUE(user_key().key) << user_key().problem.what();
}

TEST_F(UserKey, IsRefusedBehindALinkAndUnderTwoNames) {
  ASSERT_TRUE(made_user_key().key);
  fs::create_hard_link(own_ + "/store.key", folder_.file("second"));
  EXPECT_TRUE(is_refused("other names"));
  fs::remove(folder_.file("second"));
  ASSERT_TRUE(user_key().key) << user_key().problem.what();
  fs::rename(own_, away_);
  fs::create_symlink(away_, own_);
  EXPECT_TRUE(is_refused(own_ + " is a link"));
  fs::remove(own_);
  folder_.write("data/roam", "");
  EXPECT_TRUE(is_refused(own_ + " is no folder"));
}

TEST_F(UserKey, IsNotGivenUpForAnErrorThatPasses) {
  ASSERT_TRUE(made_user_key().key);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{0, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  std::string why;
  try {
    static_cast<void>(made_user_key());
  } catch (const roam::Error& error) {
    why = error.what();
  }
  const bool is_read = user_key().key.has_value();
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_NE(why.find("too many files are open"), std::string::npos) << why;
  EXPECT_FALSE(is_read);
  EXPECT_TRUE(user_key().key);
}

TEST_F(UserKey, IsMadeInAFolderThatOnlyTheUserMayWriteTo) {
  fs::remove_all(data_);
  const mode_t before = ::umask(0);
  const roam::app::UserKey made = made_user_key();
  ::umask(before);
  ASSERT_TRUE(made.key) << made.problem.what();
  EXPECT_EQ(fs::status(data_).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(own_).permissions(), fs::perms::owner_all);
}

}  // namespace
