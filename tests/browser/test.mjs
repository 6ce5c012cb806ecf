/** All tests, in one process, so that they share a browser. */
await import("./test/loads.mjs");
await import("./test/motion.mjs");
await import("./test/time.mjs");
await import("./test/picture.mjs");
await import("./test/verdict.mjs");
await import("./test/hostile.mjs");
await import("./test/many.mjs");
await import("./test/live.mjs");
await import("./test/edit.mjs");
await import("./test/edit-cells.mjs");
await import("./test/edit-files.mjs");
await import("./test/edit-foreign.mjs");
