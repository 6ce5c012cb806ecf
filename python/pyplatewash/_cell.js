/**
 * A live cell in a notebook: the page in a frame of its own, and what it and the kernel say to each other.
 *
 * The page says what `crates/viewer/page/src/edit/protocol.ts` states, and every message is passed on with the page's name, `view`:
 *
 *     to the kernel      {view, open: true}                      a page is to be shown
 *                        {view, platewash, path, question}       as the page says it
 *                        {view, platewash, abort: true}          likewise
 *     from the kernel    {view, page}                            the page; from now on the one that counts
 *                        {view, words}                           why there is none
 *                        {view, say}                             passed on to the page
 *
 * What was asked of a kernel that is gone is answered here, by `{platewash, error}`: the page then says so, and asks again.
 *
 * One page counts at a time, the newest: of two, each with a scenario of its own, the cell could not follow both.
 */

const KERNEL_GONE = "the kernel is gone: run the notebook's cell again";

function note(words, button, press) {
  const shown = document.createElement("p");
  shown.style.cssText = "margin:0;padding:0.75em 0;font:14px/1.5 system-ui,sans-serif";
  shown.setAttribute("role", "status");
  shown.append(words);
  if (button) {
    const pressed = document.createElement("button");
    pressed.style.marginInlineStart = "0.75em";
    pressed.textContent = button;
    pressed.addEventListener("click", press);
    shown.append(pressed);
  }
  return shown;
}

function newFrame(page, height) {
  const frame = document.createElement("iframe");
  frame.title = "platewash";
  // Without allow-same-origin the page cannot reach the notebook.
  frame.setAttribute("sandbox", "allow-scripts allow-downloads");
  frame.allow = "fullscreen";
  frame.style.cssText = `display:block;width:100%;height:${height}px;border:0`;
  frame.srcdoc = page;
  return frame;
}

function render({ model, el }) {
  let view = "";
  let frame = null;
  // The window of the frame as it was loaded first. A notebook that moves the cell loads the frame anew, with the scenario of old.
  let live = null;
  // What the page is to be told once it listens.
  let waiting = [];
  let asked = new Set();
  let isGone = false;

  const open = () => {
    view = Array.from(crypto.getRandomValues(new Uint32Array(4)), (word) => word.toString(36)).join("");
    [frame, live, waiting, asked] = [null, null, [], new Set()];
    el.replaceChildren(note("The kernel makes the page …"));
    model.send({ view, open: true });
  };

  const show = (page) => {
    frame = newFrame(page, model.get("height"));
    frame.addEventListener("load", ({ target }) => (isLive(target.contentWindow) ? flush() : reopen(target)));
    el.replaceChildren(frame);
  };

  const isLive = (source) => source === (live ??= source);

  const reopen = (which) => which === frame && open();

  const flush = () => waiting.splice(0).forEach(tell);

  const tell = (words) => (live ? live.postMessage(words, "*") : waiting.push(words));

  // From the page.
  const heard = ({ source, data }) => {
    if (!frame || source !== frame.contentWindow || typeof data !== "object" || data === null || !("platewash" in data)) return;
    if (!isLive(source)) {
      reopen(frame);
      return;
    }
    flush();
    model.send({ ...data, view });
    if (typeof data.path !== "string") return;
    if (isGone) lose(data.platewash);
    else asked.add(data.platewash);
  };

  // From the kernel.
  const told = (content) => {
    isGone = false;
    if (content.view !== view) {
      if (!("page" in content) || !view) return;
      view = "";
      frame = null;
      el.replaceChildren(note("This cell is shown elsewhere in the notebook.", "Show it here", open));
    } else if ("page" in content) {
      show(content.page);
    } else if ("words" in content) {
      el.replaceChildren(note(content.words, "Try again", open));
    } else if ("say" in content) {
      if (content.say.end) asked.delete(content.say.platewash);
      tell(content.say);
    }
  };

  const resized = () => frame && (frame.style.height = `${model.get("height")}px`);

  // The kernel ended or began anew. It may as well be there again: what is asked goes to it all the same.
  const lose = (platewash) => tell({ platewash, error: KERNEL_GONE });
  const gone = () => {
    isGone = true;
    asked.forEach(lose);
    asked.clear();
  };

  window.addEventListener("message", heard);
  model.on("msg:custom", told);
  model.on("change:height", resized);
  model.on("comm_live_update", gone);
  open();
  return () => {
    window.removeEventListener("message", heard);
    model.off("msg:custom", told);
    model.off("change:height", resized);
    model.off("comm_live_update", gone);
  };
}

export default { render };
