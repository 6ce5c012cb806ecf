/** The tests of the page that edits, in one process, so that they share a browser. */
await import("./test/edit.mjs");
await import("./test/edit-cells.mjs");
await import("./test/edit-files.mjs");
await import("./test/edit-foreign.mjs");
