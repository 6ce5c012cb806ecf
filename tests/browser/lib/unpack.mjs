/** Unpacks the browser once, before the tests start one in each of their processes. */
import { unpack } from "./browser.mjs";

await unpack();
