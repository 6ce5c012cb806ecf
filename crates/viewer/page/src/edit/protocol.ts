/**
 * What the page of a live cell and whoever plans for it say to each other: `platewash-edit/1`. The types come from Rust,
 * `crates/editor/src/protocol.rs`.
 *
 * The page holds the scenario, as the text of its file; whoever plans holds nothing but files and what is being worked on. Each
 * question carries all that its answer needs. An answer is a stream of lines, each a JSON object with its `kind`.
 */
import type * as rust from "../protocols.ts";

export type * from "../protocols.ts";
export type { disk as DiskLine, hello as HelloLine } from "../protocols.ts";

/** Lines of the answer to `/cell`; nothing follows an `EndLine`. */
export type CellLine = rust.CellLine | rust.EndLine;

/** Lines of the answer to `/map`: squares as they are found, coarse ones first. */
export type MapLine = rust.MapLine | rust.EndLine;

/** The line of the answer to `/recover`. */
export type RecoveryLine = rust.RecoveryLine | rust.EndLine;

/** The line of the answer to `/save`. */
export type SaveLine = rust.SaveLine | rust.EndLine;
