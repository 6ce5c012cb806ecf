/** The tests of pages that show, in one process, so that they share a browser. */
await import("./test/loads.mjs");
await import("./test/motion.mjs");
await import("./test/time.mjs");
await import("./test/picture.mjs");
await import("./test/features.mjs");
await import("./test/verdict.mjs");
await import("./test/hostile.mjs");
await import("./test/looks.mjs");
await import("./test/many.mjs");
await import("./test/live.mjs");
