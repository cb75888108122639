// What the sanitizers must not take for defects of ours, in every program of a build with them, so that nobody has to
// set their options.

#ifdef __SANITIZE_THREAD__
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

#ifdef __SANITIZE_ADDRESS__
// A driver that is unloaded seems to leak what its own variables held. So none is unloaded.
extern "C" int dlclose(void*);
extern "C" int dlclose(void*) { return 0; }
#endif
