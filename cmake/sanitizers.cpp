// What the thread sanitizer overlooks in every program of a build with it. The sanitizer asks the program itself, so
// that nobody has to set TSAN_OPTIONS. Only what happens inside of libraries that were built without it stands here: it
// does not see how they synchronize.
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
