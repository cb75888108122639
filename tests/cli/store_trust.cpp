// A store that came with a scene is not believed: what roam view, build and verify make of it.
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli_scenes.h"
#include "environment_variable.h"
#include "roam/error.h"
#include "scenes/user_key.h"
#include "store/authentic.h"
#include "store/files.h"
#include "store/manifest.h"
#include "store_builds.h"
#include "store_verbs.h"

namespace {

using namespace roam;
using namespace store_builds;
using nlohmann::json;
using store_verbs::run;

/// room_obj() without its front wall, of as many bytes.
std::string open_room_obj() {
  const std::string whole = room_obj();
  std::string text = whole.substr(0, whole.find("o front"));
  return text + std::string(whole.size() - text.size() - 1, '#') + "\n";
}

/// A scene, and what a stranger has put beside it.
class StoreTrust : public testing::Test {
 protected:
  StoreTrust() {
    for (const char* name : {"true", "open", "given"}) fs::create_directory(folder_.file(name));
    folder_.write("true/scene.obj", room_obj());
    folder_.write("open/scene.obj", open_room_obj());
    folder_.write("given/scene.obj", room_obj());
    // As long ago as a date can tell.
    for (const char* name : {"true", "open", "given"}) {
      const std::string file = folder_.file(name) + "/scene.obj";
      fs::last_write_time(file, fs::last_write_time(file) - std::chrono::hours(1));
    }
  }
  ~StoreTrust() override { setenv("XDG_DATA_HOME", user_data.file("").c_str(), 1); }

  [[nodiscard]] std::string scene() const { return folder_.file("given/scene.obj"); }
  [[nodiscard]] std::string store() const { return scene() + ".roam"; }
  [[nodiscard]] StoreBuildOptions strangers(const std::string& of, const std::string& output,
                                            const std::optional<StoreKey>& key) const {
    StoreBuildOptions o = options({folder_.file(of + "/scene.obj")}, output);
    o.key = key;
    return o;
  }
  /// Beside the scene: the store of one that lacks a wall, which says that it is of this one.
  void give_store() const {
    build_store(strangers("true", folder_.file("true.roam"), strangers_key));
    build_store(strangers("open", store(), strangers_key));
    const auto manifest = [](const std::string& of) { return store::read_manifest(*store::files_of(of), of); };
    store::Manifest forged = manifest(store());
    forged.parts[0].fingerprint = manifest(folder_.file("true.roam")).parts[0].fingerprint;
    store::publish(store(), forged);
    store::add_code(store(), Store::open(store())->info().hash, strangers_key);
  }
  /// Beside the scene: what a build leaves that was ended after it had read the one that lacks a wall.
  void give_scratch(const std::optional<StoreKey>& key) const {
    const StoreBuildOptions right = strangers("true", folder_.file("true.roam"), key);
    const StoreBuildOptions open = strangers("open", store(), key);
    StoreBuildReport report;
    static_cast<void>(plan_store(right, report));
    static_cast<void>(plan_store(open, report));
    const auto id_in = [](const std::string& of) {
      return fs::directory_iterator(of + "/scratch/parts")->path().stem().string();
    };
    const std::string file = "scratch/parts/" + id_in(store()) + ".json";
    const auto fingerprint_in = [&](const std::string& of) {
      const std::string text = content(of).at(file), start = "\"fingerprint\": \"";
      return text.substr(text.find(start) + start.size(), 64);
    };
    std::string record = content(store()).at(file);
    record.replace(record.find(fingerprint_in(store())), 64, fingerprint_in(folder_.file("true.roam")));
    std::ofstream(store() + "/" + file) << record;
  }

  /// roam view on the scene, straight on through the front wall.
  [[nodiscard]] ProgramResult view(const std::vector<std::string>& more = {}) const {
    const std::string path = folder_.write("p.path", "2 0 0.95\n18 0 0.95\n25 0 0.95\n");
    std::vector<std::string> arguments{"view", scene(), "--headless", "--path", path, "--mode", "fly", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  void become(const std::string& user) const { setenv("XDG_DATA_HOME", folder_.file(user).c_str(), 1); }

  const TestFolder folder_;
  const StoreKey strangers_key{{std::byte{17}}};
};

TEST_F(StoreTrust, AStoreThatCameWithTheSceneIsNotWalkedIn) {
  give_store();
  const ProgramResult told = view();
  EXPECT_EQ(told.status, 3) << told.err;
  const json report = json::parse(told.out);
  EXPECT_EQ(report["outcome"], "blocked");
  EXPECT_EQ(report["blocked_at"]["object"], "front");
  EXPECT_TRUE(contains(told.err, "is not used") && contains(told.err, "--store") && contains(told.err, "--adopt"))
      << told.err;
  // Nor by who has a key.
  ASSERT_EQ(run({"build", folder_.file("true/scene.obj")}).status, 0);
  const ProgramResult again = view();
  EXPECT_EQ(json::parse(again.out)["outcome"], "blocked");
  EXPECT_TRUE(contains(again.err, "it was not built with your key")) << again.err;
  // Whoever names it trusts it.
  EXPECT_EQ(json::parse(view({"--store", store()}).out)["outcome"], "left_scene");
}

TEST_F(StoreTrust, AStoreThatCameWithTheSceneIsNeitherUpToDateNorDestroyed) {
  give_store();
  const auto before = content(store());
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"build", scene()}, {"build", scene(), "-o", store()}, {"build", scene(), "--plan"}}) {
    const ProgramResult built = run(command);
    EXPECT_EQ(built.status, 1) << built.out;
    EXPECT_TRUE(contains(built.err, "was not built with your key") && contains(built.err, "--adopt")) << built.err;
    EXPECT_TRUE(content(store()) == before);
  }
  fs::remove_all(store());
  ASSERT_EQ(run({"build", scene()}).status, 0);
  EXPECT_EQ(Store::open(store())->info().triangles, 12U);
  const ProgramResult own = view();
  EXPECT_TRUE(contains(json::parse(own.out)["store"].dump(), "scene.obj.roam")) << own.err;
}

TEST_F(StoreTrust, AStrangersDamagedStoreIsNeitherRepairedNorReplaced) {
  give_store();
  const std::string current = store() + "/CURRENT";
  std::ofstream(current) << "nothing\n";
  auto before = content(store());
  const auto expect_refused = [&] {
    const ProgramResult built = run({"build", scene()});
    EXPECT_EQ(built.status, 1) << built.out;
    EXPECT_TRUE(contains(built.err, "code of your key") && contains(built.err, "--adopt")) << built.err;
    EXPECT_TRUE(content(store()) == before);
  };
  expect_refused();
  fs::remove_all(store() + "/manifests");
  fs::remove_all(store() + "/spare");
  before = content(store());
  expect_refused();
  const ProgramResult adopted = run({"build", scene(), "--adopt"});
  EXPECT_EQ(adopted.status, 0) << adopted.err;
  EXPECT_EQ(Store::open(store())->info().triangles, 12U);
}

TEST_F(StoreTrust, OnesOwnDamagedStoreIsRepaired) {
  ASSERT_EQ(run({"build", scene()}).status, 0);
  std::ofstream(store() + "/CURRENT") << "nothing\n";
  const ProgramResult built = run({"build", scene()});
  EXPECT_EQ(built.status, 0) << built.err;
  EXPECT_TRUE(contains(built.out + built.err, "a copy of its manifest was whole")) << built.out << built.err;
}

TEST_F(StoreTrust, VerifyingSaysWhoWroteIt) {
  give_store();
  const ProgramResult foreign = run({"verify", store()});
  EXPECT_EQ(foreign.status, 0) << foreign.out << foreign.err;
  EXPECT_TRUE(contains(foreign.out, "by whom is not known")) << foreign.out;
  EXPECT_EQ(json::parse(run({"verify", store(), "--json"}).out)["yours"], false);
  fs::remove_all(store());
  ASSERT_EQ(run({"build", scene()}).status, 0);
  EXPECT_TRUE(contains(run({"verify", store()}).out, "written by you")) << run({"verify", store()}).out;
  EXPECT_EQ(json::parse(run({"verify", store(), "--json"}).out)["yours"], true);
}

TEST_F(StoreTrust, ARepairGivesNoCode) {
  give_store();
  fs::remove(fs::directory_iterator(store() + "/parts")->path());
  ASSERT_EQ(run({"build", folder_.file("true/scene.obj")}).status, 0);  // so that there is a key
  (void)run({"verify", store(), "--repair", scene()});
  EXPECT_FALSE(Store::open(store())->is_authentic(*app::user_key().key));
}

TEST_F(StoreTrust, WhatAStrangersBuildLeftIsReadAgain) {
  for (const std::optional<StoreKey>& key : {std::optional<StoreKey>(), std::optional(strangers_key)}) {
    fs::remove_all(store());
    fs::remove_all(folder_.file("true.roam"));
    give_scratch(key);
    const ProgramResult built = run({"build", scene(), "--json"});
    ASSERT_EQ(built.status, 0) << built.err;
    EXPECT_EQ(json::parse(built.out)["triangles"], 12);
    EXPECT_EQ(Store::open(store())->info().triangles, 12U) << "the wall is there";
    EXPECT_TRUE(verify_store(store()).whole());
  }
}

TEST_F(StoreTrust, APlanOfAStrangerIsNotBuilt) {
  give_scratch(std::nullopt);
  for (const std::vector<std::string>& step : {std::vector<std::string>{"--shard", "0"}, {"--merge"}}) {
    std::vector<std::string> command{"build", "-o", store()};
    command.insert(command.end(), step.begin(), step.end());
    const ProgramResult built = run(command);
    EXPECT_EQ(built.status, 1);
    EXPECT_TRUE(contains(built.err, "was not made with your key")) << built.err;
  }
}

TEST_F(StoreTrust, WhatAStrangerRemembersOfTheSceneIsForgotten) {
  // The store is the user's own, of the scene as it was: without the wall.
  fs::copy(folder_.file("open/scene.obj"), scene(), fs::copy_options::overwrite_existing);
  std::this_thread::sleep_for(std::chrono::milliseconds(3200));  // what changed just now is not remembered
  ASSERT_EQ(run({"build", scene()}).status, 0);
  fs::copy(folder_.file("true/scene.obj"), scene(), fs::copy_options::overwrite_existing);
  std::string text = folder_.read("given/scene.obj.roam/sources.json");
  json sources = json::parse(text.substr(0, text.rfind('}') + 1));
  ASSERT_EQ(sources.size(), 1U);
  struct stat status {};
  ASSERT_EQ(::stat(scene().c_str(), &status), 0);
  const auto ns = [](const std::timespec& t) { return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec; };
  sources.front()[1] = ns(status.st_ctim);
  folder_.write("given/scene.obj.roam/sources.json", sources.dump());
  const ProgramResult built = run({"build", scene(), "--json"});
  ASSERT_EQ(built.status, 0) << built.err;
  EXPECT_EQ(json::parse(built.out)["triangles"], 12) << "the scene was taken for what it was";
}

TEST_F(StoreTrust, AColleaguesStoreIsAdoptedAndStaysTheirs) {
  become("colleague");
  ASSERT_EQ(run({"build", scene()}).status, 0);
  const auto before = content(store());
  become("user");
  EXPECT_EQ(run({"build", scene()}).status, 1);
  EXPECT_TRUE(content(store()) == before);
  const ProgramResult adopted = run({"build", scene(), "--adopt", "--json"});
  ASSERT_EQ(adopted.status, 0) << adopted.err;
  EXPECT_EQ(json::parse(adopted.out)["unchanged"], true);
  for (const char* one : {"user", "colleague"}) {
    become(one);
    EXPECT_EQ(json::parse(run({"build", scene(), "--json"}).out)["unchanged"], true) << one;
    EXPECT_TRUE(view().err.empty()) << view().err;
  }
  // A new one is of whoever built it.
  folder_.write("given/scene.obj", open_room_obj());
  ASSERT_EQ(run({"build", scene()}).status, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(store() + "/codes"), {}), 1) << "codes of what is gone are gone";
  become("user");
  EXPECT_EQ(run({"build", scene()}).status, 1);
}

TEST_F(StoreTrust, WithoutAKeyAStoreIsBuiltAndNotBelieved) {
  unsetenv("XDG_DATA_HOME");
  const std::string home = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  unsetenv("HOME");
  const ProgramResult built = run({"build", scene()}), again = run({"build", scene()});
  const ProgramResult adopted = run({"build", scene(), "--adopt"});
  const ProgramResult planned = run({"build", scene(), "-o", folder_.file("steps.roam"), "--plan"});
  setenv("HOME", home.c_str(), 1);
  EXPECT_EQ(built.status, 0) << built.err;
  EXPECT_TRUE(contains(built.err, "set HOME or XDG_DATA_HOME")) << built.err;
  EXPECT_EQ(again.status, 1) << again.out;
  EXPECT_TRUE(contains(again.err, "--adopt")) << again.err;
  EXPECT_EQ(adopted.status, 0) << adopted.err;
  EXPECT_TRUE(contains(adopted.out, "up to date")) << adopted.out;
  EXPECT_EQ(planned.status, 1);
  EXPECT_TRUE(contains(planned.err, "set HOME or XDG_DATA_HOME")) << planned.err;
}

TEST_F(StoreTrust, ABuildThatIsStoppedGoesOnWithAKeyAlone) {
  const std::string reader =
      folder_.write("reader", "#!/bin/sh\ncase \"$*\" in *--only-list*) exec '" ROAM_READER_PROGRAM
                              "' \"$@\";; esac\nkill -INT $PPID\nexec sleep 100\n");
  fs::permissions(reader, fs::perms::owner_all);
  const EnvironmentVariable slow("ROAM_READER", reader);
  const ProgramResult own = run({"build", scene()});
  EXPECT_TRUE(contains(own.err, "the same command again goes on")) << own.err;
  const EnvironmentVariable nowhere("XDG_DATA_HOME", folder_.write("no folder", ""));
  const ProgramResult keyless = run({"build", scene()});
  EXPECT_TRUE(contains(keyless.err, "begins anew") && !contains(keyless.err, "goes on")) << keyless.err;
}

TEST_F(StoreTrust, AKeyIsTheUsersAlone) {
  become("user");
  EXPECT_FALSE(app::user_key().key);
  EXPECT_FALSE(fs::exists(folder_.file("user"))) << "who only looks makes nothing";
  const app::UserKey made = app::made_user_key();
  ASSERT_TRUE(made.key) << made.problem.what();
  EXPECT_EQ(app::user_key().key->bytes, made.key->bytes);
  const fs::path file = app::key_file();
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  const auto problem = [] {
    EXPECT_FALSE(app::user_key().key || app::made_user_key().key);
    return std::string(app::made_user_key().problem.what());
  };
  const std::string text = folder_.read("user/roam/store.key");
  fs::permissions(file, fs::perms::group_read, fs::perm_options::add);
  EXPECT_TRUE(contains(problem(), "chmod")) << problem();
  fs::permissions(file, fs::perms::group_read, fs::perm_options::remove);
  fs::permissions(file.parent_path(), fs::perms::others_write, fs::perm_options::add);
  EXPECT_TRUE(contains(problem(), "chmod go-w")) << problem();
  fs::permissions(file.parent_path(), fs::perms::others_write, fs::perm_options::remove);
  std::string no_digit = text;
  no_digit[0] = 'g';
  for (const std::string& damaged : {std::string(), text.substr(1), text + "\n", no_digit}) {
    folder_.write("user/roam/store.key", damaged);
    EXPECT_TRUE(contains(problem(), "is damaged")) << problem();
    EXPECT_EQ(folder_.read("user/roam/store.key"), damaged) << "it is not replaced";
  }
  folder_.write("user/roam/store.key", text);
  ASSERT_TRUE(app::user_key().key);
  fs::rename(file, folder_.file("elsewhere"));
  fs::create_symlink(folder_.file("elsewhere"), file);
  EXPECT_TRUE(contains(problem(), "is a link")) << problem();
  if (::geteuid() == 0) {  // anybody else may give no file away
    fs::remove(file);
    fs::rename(folder_.file("elsewhere"), file);
    ASSERT_EQ(::chown(file.c_str(), 1, 1), 0);
    EXPECT_TRUE(contains(problem(), "another user")) << problem();
  }
}

TEST_F(StoreTrust, BuildsThatBeginAtOnceMakeOneKey) {
  become("user");
  std::vector<pid_t> children;
  for (int i = 0; i < 8; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      const app::UserKey made = app::made_user_key();
      const StoreKey key = made.key.value_or(StoreKey{});
      std::ofstream(folder_.file("key" + std::to_string(i))).write(reinterpret_cast<const char*>(key.bytes.data()), 32);
      ::_exit(0);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) ::waitpid(child, nullptr, 0);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(folder_.read("key" + std::to_string(i)), folder_.read("key0")) << i;
  EXPECT_NE(folder_.read("key0"), std::string(32, '\0'));
}

}  // namespace
