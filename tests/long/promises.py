#!/usr/bin/env python3
"""tests/long/promises.py [--check] [--work FOLDER] [NAME...]

Takes out of a copy of the tree, one at a time, what makes each promise of docs/guarantees.md hold, and runs the
promise's test, which must fail (those of NAME: tests whose name contains it). A crash, and any other end but success,
is a failure too. Results are kept in FOLDER (build-promises), so that the same command goes on where it was stopped.
--check runs nothing: it only compares the list below with the source and with docs/guarantees.md. Status 1 if a test
passes all the same, a fault does not compile, or the list does not fit. Hours."""

import argparse
import hashlib
import json
import pathlib
import re
import sys

from changed_tree import SOURCE, ChangedTree, Late, ends_well, listed_files

# Those of the preset `check`, for the compiler's cache.
OPTIONS = ["-DCMAKE_BUILD_TYPE=Release", "-DROAM_BENCH=ON", "-DROAM_WERROR=ON"]

# Not a new-expression, which the compiler may leave out.
ALLOCATION = "\n  ::operator delete(::operator new(1));"

# Program, its filter as in docs/guarantees.md, file, what stands there once, what takes its place.
PROMISES = [
    ("sweep", "EverySweep.IsNeitherMissedNorLateNorEarly", "src/sweep/error_bound.h", "roundings = 16.0",
     "roundings = 0.0"),
    ("index", "NodeFilter.*", "src/index/margin.h", "node_roundings = 40.0F", "node_roundings = 0.0F"),
    ("index", "FilterMargins.*", "src/index/margin.h", "node_roundings = 40.0F", "node_roundings = 0.0F"),
    ("world", "PatchworkLevels.ARefinementWaitsUntilTheBodyIsFreeInIt", "src/world/patches.cpp",
     "if (!world || (fits && !fits(*world))) return false;", "if (!world) return false;"),
    ("world", "PatchworkUnknown.LeavesABodyBesideItFreeWhenItBecomesKnown", "src/world/patchwork.cpp",
     "unknown::sweep(box, Patchwork::margin,", "unknown::sweep(box, 0.0,"),
    ("world", "PatchworkMemory.*", "src/world/patchwork.cpp", "lost = true;\n      ++revision;", "++revision;"),
    ("world", "PatchworkQueries.DoNotAllocate", "src/world/patchwork.cpp", "collector.demand(0.0);",
     "collector.demand(0.0);" + ALLOCATION),
    ("motion", "WalkerPatchwork.*", "src/world/patchwork.cpp",
     "unknown::sweep(box, Patchwork::margin, query.body, query.from, query.motion)",
     "unknown::sweep(box, Patchwork::margin, query.body, query.from, 0.9 * query.motion)"),
    ("motion", "RandomWalks.*", "src/motion/move.cpp", "const double rest = free.gap - away;",
     "const double rest = free.gap - 0.5 * away;"),
    ("motion", "Walker.NeverPassesAThinWallAtAnySpeedAndTimeStep", "src/motion/move.cpp",
     "until_touch - skin / approach", "until_touch + skin / approach"),
    ("motion", "MoveInstances.NeverLetsAnythingTouchInARandomScene", "src/motion/move_instances.cpp",
     "body.radius + shift.bulge(place, way) + rounding", "body.radius + rounding"),
    ("motion", "Regions.NeverViolateInRandomClutter", "src/motion/sizes.cpp",
     "if (m.probe(lift).touched || !m.space.fits(body, m.place + lift + raised)) return;",
     "if (m.probe(lift).touched) return;"),
    ("motion", "Regions.GiveTheSameBitsOnEveryRunAndAllocateNothing", "src/motion/sizes.cpp",
     "if (sizes.settled()) return;", "if (sizes.settled()) return;" + ALLOCATION),
    ("check", "Certificate.IsRefusedForEachForgery", "src/check/check.cpp", "demand(place == end,", "demand(true,"),
    ("check", "Certificate.ProvesWhateverItAccepts", "src/check/check.cpp", "s.clearance - 1e-9)",
     "s.clearance - 1e-4)"),
    ("files_whole", "WholeFile.IsWholeOrAsItWasWhicheverCallFails", "src/files/whole_file.cpp",
     "if (again([&] { return ::fsync(file_.number()); }) != 0) fail_to_write(errno);",
     "static_cast<void>(again([&] { return ::fsync(file_.number()); }));"),
    ("import", "ImportSandbox.*", "src/import/reader/sandbox/landlock.cpp", "allow(ruleset, folder, read_file",
     "allow(ruleset, folder.parent_path(), read_file"),
    ("index", "LeafFilter.*", "src/index/leaf-inl.h",
     "slack = hn::Sub(slack, hn::Mul(set(half_height), hn::Abs(n.z)));",
     "slack = hn::Sub(slack, hn::Mul(set(0.999F * half_height), hn::Abs(n.z)));"),
    ("world", "WorldAgainstBruteForce.*", "src/index/sweep_traversal-inl.h",
     "piece_.body.radius + double(t.fine_error), piece_.body.half_height", "piece_.body.radius + 0.0 * double(t.fine_error), piece_.body.half_height"),
    # The rounding mode "down" is not seen.
    ("math", "FloatingPoint.*", "src/math/floating_point.h", "(_mm_getcsr() & ~flags)",
     "(_mm_getcsr() & ~flags & ~0x2000U)"),
    ("store", "PagerWalk.*", "src/store/pager/pager.cpp", "tracked.holds(residents.box(item))",
     "tracked.time_to(residents.box(item)) < 0.0"),
    ("store_pager_system_calls", "PagerSystemCalls.AreNoneOfTheBodysThread", "src/store/pager/pager.cpp",
     "lock(handover.mutex, std::try_to_lock);", "lock(handover.mutex);"),
    ("store_pager_memory", "PagerMemory.NothingIsAllocatedAndTheProcessDoesNotGrow", "src/store/pager/pager.cpp",
     "residents.take(item);", "residents.take(item);" + ALLOCATION),
    ("cli", "StoreMemory.IsWhatMemorySaysAndLittleMore", "src/store/pager/pager.cpp",
     "rest / (unit_bytes", "rest * 5 / 4 / (unit_bytes"),
    ("store", "StoreLinks.*", "src/store/folder.cpp", "flags | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK",
     "flags | O_CLOEXEC | O_NONBLOCK"),
    ("cli", "StoreTrust.*", "src/store/authentic.cpp", "if (key && !same_digits(found,",
     "if (key && has_line && !same_digits(found,"),
    ("store", "StoreCodecDamage.*", "src/store/codec/tree_shape.cpp",
     "    if (inner > 0 && depth >= index::max_depth) return \"its tree is too deep\";\n", ""),
    ("world", "WorldAllocations.*", "src/world/instances.cpp",
     "    tree.change({{turned(it.data->reach, frame), i}}, {});\n    it.pose = pose;",
     "    it.pose = pose;\n    tree.change({{turned(it.data->reach, frame), i}}, {});"),
    ("c_allocations", "CAllocations.*", "src/c/error.cpp",
     "} catch (const std::bad_alloc&) {\n    return failed(ROAM_NO_MEMORY,",
     "} catch (const std::bad_alloc&) {\n    return failed(ROAM_FAILED,"),
    ("cli", "Outputs.*", "src/files/mark.cpp", "if (size == 0) return true;", "if (size < 1000) return true;"),
    ("generate", "GenerateAllocations.*", "src/files/whole_file.cpp",
     "WholeFile::~WholeFile() {\n  if (!temporary_.empty()) ", "WholeFile::~WholeFile() {\n  if (temporary_.empty()) "),
    ("process", "ChildAllocations.*", "src/process/child.cpp", "all.children.insert(std::move(node));",
     "all.children[child] = node.mapped();"),
    ("import_allocations", "ImportAllocations.*", "src/process/child.cpp",
     "  if (collect()) return;\n", "  if (collect() || pid_ > 0) return;\n"),
    ("profile", "ProfileAllocations.*", "src/profile/profile.cpp",
     "(const Error& error) {\n    throw Error(fmt::format(", "(const std::exception& error) {\n    throw Error(fmt::format("),
    ("store_build_allocations", "StoreBuildAllocations.*", "src/store/build/output_folder.cpp",
     "} catch (const std::exception&) {  // such entries stay", "} catch (const Error&) {  // such entries stay"),
    ("training_allocations", "TrainingAllocations.*", "src/ways/survey.cpp",
     "TriangleId first, std::vector<TriangleId>& ids) {", "TriangleId first, std::vector<TriangleId>& ids) noexcept {"),
    ("store_allocations", "StoreAllocations.*", "src/store/pager/loader.cpp",
     "} catch (...) {\n      end();\n      throw;",
     "} catch (...) {\n      throw;"),
    ("web_allocations", "WebAllocations.*", "src/process/thread_without_signals.h",
     "~Blocked() { ::pthread_sigmask(SIG_SETMASK, &before, nullptr); }", "~Blocked() = default;"),
    ("cli", "VerbWithoutMemory.*", "src/cli/command_line.cpp", "std::set_terminate(end_after_exception);",
     "static_cast<void>(end_after_exception);"),
    ("cli", "MemoryRunsOut.*", "src/cli/command_line.cpp", "    std::_Exit(failed);", "    std::abort();"),
    ("files", "PathAllocations.*", "src/files/whole_file.cpp",
     "::unlinkat(folder(), temporary_.c_str(), 0);\n    throw;",
     "throw;"),
    ("cli", "FullDisk.*", "src/files/whole_file.cpp",
     "if (write_fully(file_.number(), bytes) < bytes.size()) fail_to_write(errno);",
     "static_cast<void>(write_fully(file_.number(), bytes));"),
    ("store_build_power", "StoreBuildPower.ACutAtAnyStepLeavesTheOldStoreTheNewOrNone", "src/files/whole_file.cpp",
     "  if (again([&] { return ::fsync(file_.number()); }) != 0) fail_to_write(errno);\n", ""),
    # Either limit bounds it, so both go.
    ("import", "ImportReaderProcess.BoundsTheMemoryOfTheReader", "src/import/reader/sandbox/sandbox.cpp",
     """  if (rights.address_space > 0) all = limit(RLIMIT_AS, rights.address_space) && all;
  if (rights.data > 0) all = limit(RLIMIT_DATA, rights.data) && all;
""", "  static_cast<void>(rights.data);\n"),
    ("world", "Batches.AreAnsweredAsOneByOne", "src/world/space.cpp", "i = some.begin(); i < some.end();",
     "i = some.begin(); i + 1 < some.end();"),
    ("world", "WorldBuild.GivesTheSameBitsForAnyNumberOfThreads", "src/world/build.cpp",
     "tiles[i] = build_tile(soup, ids, lossless);",
     "tiles[i] = build_tile(soup, ids, lossless || tbb::this_task_arena::max_concurrency() > 1);"),
    ("motion", "Walker.GivesTheSameBitsOnEveryRunAndWithAnyNumberOfThreads", "src/world/build.cpp",
     "return build_tiles(soup, parts, options.lossless, progress);",
     "return build_tiles(soup, parts, options.lossless || options.threads > 4, progress);"),
    ("world", "WorldBuild.ThrowsWhereverAnAllocationFails", "src/world/build.cpp", "arena.execute([&] {",
     "arena.execute([&]() noexcept {"),
    ("world", "WorldQueries.DoNotAllocate", "src/world/query.cpp", "    place_ = impact.place;\n    return impact.hit",
     "    place_ = impact.place;" + ALLOCATION + "\n    return impact.hit"),
    ("index", "InstructionSets.*", "cmake/compiler.cmake", "-ffp-contract=off", "-ffp-contract=fast"),
    ("c", "CWalker.MovesAsCppDoes", "src/c/walker.cpp", "    if (wish.braking != 0.0) how.braking = wish.braking;\n",
     ""),
    ("motion", "Resize.IsSmallerAtOnceAndLargerWhenItFits", "src/motion/sizes.cpp",
     "if (!m.space.fits(body, m.place + raised)) {",
     "if (!m.space.fits(Body::capsule(radius - 0.06, height), m.place + raised)) {"),
    ("motion", "WalkerAllocations.*", "src/motion/state.cpp",
     "  std::vector<char> inside(regions.size(), char{0});\n  regions_.swap(copies);",
     "  regions_.swap(copies);\n  std::vector<char> inside(regions.size(), char{0});"),
    ("store", "HostileStore.*", "src/store/page.cpp", "if (t.bytes > tile_bytes || t.number_bytes",
     "if (t.number_bytes"),
    ("store", "StoreDamageBits.EveryFlippedBitIsFoundAndNoneChangesAnAnswer", "src/store/read_ahead.cpp",
     "one.result.problem = r.hash ?", "one.result.problem = r.hash && r.bytes % 2 == 0 ?"),
    ("cli", "StoreVerbs.EveryTileDamagedHoldsABodyAndLetsNothingThrough", "src/store/pager/paged_scene.cpp",
     "if (!a.only_coming || !a.residents.has_failed(item)) {", "if (!a.residents.has_failed(item)) {"),
    ("store", "PagerFailures.NobodyPassesAWallWhateverIsReadAndWhen", "src/store/pager/paged_scene.cpp",
     "if (!a.only_coming || !a.residents.has_failed(item)) {", "if (!a.residents.has_failed(item)) {"),
    ("store", "PagerFailures.WithReadsThatNeverEndTheBodyIsHeldAndNothingWaits", "src/store/pager/paged_scene.cpp",
     "(!only_coming || !page.failed) && collector", "only_coming && !page.failed && collector"),
    ("store_build_resume", "StoreBuildResume.AfterBeingKilledAtAnyStepOnTheDisk", "src/store/build/merge.cpp",
     'return name == manifest_file("new"); })) remove_file(store, file);',
     'return name == manifest_file("new"); })) {}'),
    ("store_build_resume", "StoreBuildResume.AnUpdateThatIsKilledLeavesTheOldStoreOrTheNew",
     "src/store/build/merge.cpp",
     "  publish(work.store, manifest);", "  remove_file(work.store, current_file);\n  publish(work.store, manifest);"),
    ("store_build_resume", "StoreBuildResume.GivesTheSameBytesForAnyThreadsAndMemory", "src/store/build/merge.cpp",
     "manifest.geometry_hash += shard.geometry_hash;",
     "manifest.geometry_hash += shard.geometry_hash + (work.options.threads == 1 ? 1 : 0);"),
    ("store_build_resume", "StoreBuildResume.SaysThatTheDiskIsFullAndGoesOnWhenItIsNot",
     "src/files/whole_file.cpp",
     "if (write_fully(file_.number(), bytes) < bytes.size()) fail_to_write(errno);",
     "static_cast<void>(write_fully(file_.number(), bytes));"),
    ("import", "ImportHostile.*", "src/import/scene_scope.cpp", "found = holds(next) && fs::is_symlink",
     "found = fs::is_symlink"),
    ("import", "ImportTilesetsHostile.*", "src/import/scene_scope.cpp", "<= deepest_nesting + 1;",
     "<= deepest_nesting + 2;"),
    ("import", "ImportStreamMemory.*", "src/import/reader/piece_cutter.cpp",
     "return memory_limit - std::min(memory_limit, taken);",
     "return 2 * memory_limit - std::min(memory_limit, taken);"),
    ("osg_harvester_allocations", "OsgHarvesterAllocations.*", "src/osgroam/harvester.cpp",
     "} catch (...) {\n      give_up(place);", "} catch (const std::runtime_error&) {\n      give_up(place);"),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--work", type=pathlib.Path, default=SOURCE / "build-promises")
    parser.add_argument("names", metavar="NAME", nargs="*")
    options = parser.parse_args()
    document = (SOURCE / "docs/guarantees.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`([A-Z]\w+\.(?:\*|\w+))`", document))
    listed = {p[1] for p in PROMISES}
    wrong = [f"{name}: docs/guarantees.md has it, this list has not" for name in sorted(named - listed)]
    wrong += [f"{name}: this list has it, docs/guarantees.md has not" for name in sorted(listed - named)]
    for _, name, path, good, _ in PROMISES:
        count = (SOURCE / path).read_text(encoding="utf-8").count(good)
        if count != 1:
            wrong.append(f"{name}: {path} has {count} of: {good}")
    if wrong or options.check:
        print("\n".join(wrong))
        return 1 if wrong else 0
    return prove(options)


def state():
    """A digest of all files but documents, long proofs and findings: a result holds as long as they are the same."""
    digest = hashlib.sha256()
    for path in sorted(listed_files()):
        if not path.endswith(".md") and not path.startswith(("docs/", "tests/long/", "tests/fuzz/regressions/")):
            digest.update(path.encode() + b"\0" + (SOURCE / path).read_bytes())
    return digest.hexdigest()[:16]


def judge(tree, promise):
    """What the promise's test does without what keeps it."""
    program, name, path, good, bad = promise
    test = [tree.build / f"test_{program}", f"--gtest_filter=*{name}*"]
    try:
        if not tree.compiles([f"test_{program}"]) or not ends_well(test, 1200):
            return "fails as it is"
        with tree.changed(path, lambda text: text.replace(good, bad)):
            if not tree.compiles([f"test_{program}"]):
                return "does not compile"
            return "PASSES" if ends_well(test, 1200) else "fails"
    except Late:
        return "does not end in 20 minutes"


def prove(options):
    kept = options.work / "results.jsonl"
    known, now = {}, state()
    if kept.exists():
        rows = map(json.loads, kept.read_text(encoding="utf-8").splitlines())
        known = {tuple(row["promise"]): row["said"] for row in rows if row["state"] == now}
    chosen = [p for p in PROMISES if not options.names or any(name in p[1] for name in options.names)]
    tree, wrong = None, 0
    for promise in chosen:
        if promise not in known:
            tree = tree or ChangedTree(options.work, OPTIONS, sorted({f"test_{p[0]}" for p in chosen}))
            known[promise] = judge(tree, promise)
            with kept.open("a", encoding="utf-8") as out:
                out.write(json.dumps({"promise": promise, "state": now, "said": known[promise]}) + "\n")
        print(f"{promise[1]}: {known[promise]} without {promise[2]}: {promise[3].strip().splitlines()[0]}", flush=True)
        wrong += known[promise] != "fails"
    print(f"{len(chosen)} faults, {wrong} not seen to fail")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
