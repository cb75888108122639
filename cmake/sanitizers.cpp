// Events inside foreign libraries that the sanitizers would report as defects of ours. It is linked into every program
// of a build with them, so that nobody has to set their options.

#include <cstdio>
#include <cstdlib>
#include <cstring>

#ifdef __has_feature
#define HAS_FEATURE(name) __has_feature(name)
#else
#define HAS_FEATURE(name) 0
#endif

#if defined(__SANITIZE_THREAD__) || HAS_FEATURE(thread_sanitizer)
// Only what happens inside of libraries that were built without the sanitizer: it does not see how they synchronize.
//
// A line takes a report away when any of its stacks goes through the library, so libosg and libosgDB must never stand
// here: their pager calls our code in threads of theirs.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return
      // Mesa's drawing by the processor counts the owners of its fences by atomics of its own; it never calls us.
      "race:swrast_dri.so\n"
      // OpenSceneGraph waits until its threads have ended, but does not join them. Ours are std::thread.
      "thread:libOpenThreads.so\n";
}
#endif

#if defined(__SANITIZE_ADDRESS__) || HAS_FEATURE(address_sanitizer)
// A driver that is unloaded seems to leak what its own variables held. So none is unloaded.
extern "C" int dlclose(void*);
extern "C" int dlclose(void*) { return 0; }

// intercept_tls_get_addr: up to g++ 13, the search for leaks takes some thread-local memory for another, and crashes
// (google/sanitizers, issue 1322). print_suppressions: tests expect that nothing else is written.
// Weak: a program may have options of its own.
extern "C" const char* __asan_default_options();
extern "C" [[gnu::weak]] const char* __asan_default_options() {
  return "intercept_tls_get_addr=0:print_suppressions=0";
}

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return
      // It keeps offsets instead of pointers, so the values of each font seem lost.
      "leak:libfontconfig.so\n"
      // A process may end while tasks that own it wait in memory of TBB's, where nobody looks for pointers.
      "leak:roam::cracks::RimEdges::RimEdges\n"
      // spnav_open() loses the head of a list when there is no daemon.
      "leak:libspnav.so\n";
}

// Leaks cannot be looked for in a program that strace follows, which would be an error of every test with strace.
extern "C" int __lsan_is_turned_off();
extern "C" int __lsan_is_turned_off() {
  constexpr char tracer[] = "TracerPid:";
  char line[256];
  bool traced = false;
  if (std::FILE* status = std::fopen("/proc/self/status", "r")) {
    while (std::fgets(line, sizeof line, status) != nullptr) {
      if (std::strncmp(line, tracer, sizeof tracer - 1) == 0) traced = std::atoi(line + sizeof tracer - 1) != 0;
    }
    std::fclose(status);
  }
  return traced ? 1 : 0;
}
#endif
