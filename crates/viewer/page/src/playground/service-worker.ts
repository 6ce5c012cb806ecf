/** Keeps the folder of the playground in the browser, so that it works without a network after the first visit. The network goes first. */

/** Put in by the build: the files of the folder, and a hash of them. */
declare const FILES: readonly string[];
declare const VERSION: string;

/** What this needs of its global scope, which TypeScript knows only instead of a window's. */
interface Scope {
  addEventListener(type: string, listener: (event: { request: Request; waitUntil(done: Promise<unknown>): void; respondWith(answer: Promise<Response>): void }) => void): void;
  skipWaiting(): Promise<void>;
  location: Location;
}

const scope = globalThis as unknown as Scope;
const HOME = new URL("./", scope.location.href).href;
const PREFIX = `platewash ${HOME} `;
const OWN = PREFIX + VERSION;

async function install(): Promise<void> {
  const cache = await caches.open(OWN);
  await cache.addAll(FILES.map((name) => new Request(name, { cache: "no-cache" })));
  await scope.skipWaiting();
}

async function activate(): Promise<void> {
  const others = (await caches.keys()).filter((name) => name.startsWith(PREFIX) && name !== OWN);
  await Promise.all(others.map((name) => caches.delete(name)));
}

/** The server's answer, whatever it is; without a server the kept one. */
async function answer(request: Request): Promise<Response> {
  try {
    return await fetch(request);
  } catch (error) {
    const cache = await caches.open(OWN);
    const kept = await cache.match(request.mode === "navigate" ? HOME : request, { ignoreSearch: true });
    if (kept === undefined) throw error;
    return kept;
  }
}

scope.addEventListener("install", (event) => event.waitUntil(install()));
scope.addEventListener("activate", (event) => event.waitUntil(activate()));
scope.addEventListener("fetch", (event) => {
  const { method, url } = event.request;
  if (method === "GET" && url.startsWith(HOME)) event.respondWith(answer(event.request));
});
