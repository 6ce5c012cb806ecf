/** Keeps the folder of the playground in the browser, so that it works without a network after the first visit. */

/** Put in by the build: the files of the folder, and a hash of them. */
declare const FILES: readonly string[];
declare const VERSION: string;

/** What this needs of its global scope, which TypeScript knows only instead of a window's. */
interface Scope {
  addEventListener(type: string, listener: (event: { request: Request; waitUntil(done: Promise<unknown>): void; respondWith(answer: Promise<Response>): void }) => void): void;
  skipWaiting(): Promise<void>;
  clients: { claim(): Promise<void> };
  location: Location;
}

const scope = globalThis as unknown as Scope;
const PREFIX = `platewash ${new URL(".", scope.location.href).pathname} `;
const OWN = PREFIX + VERSION;

async function install(): Promise<void> {
  const cache = await caches.open(OWN);
  await cache.addAll(FILES.map((name) => new Request(name, { cache: "no-cache" })));
  await scope.skipWaiting();
}

async function activate(): Promise<void> {
  const others = (await caches.keys()).filter((name) => name.startsWith(PREFIX) && name !== OWN);
  await Promise.all(others.map((name) => caches.delete(name)));
  await scope.clients.claim();
}

async function answer(request: Request): Promise<Response> {
  const cache = await caches.open(OWN);
  return (await cache.match(request, { ignoreSearch: true })) ?? fetch(request);
}

scope.addEventListener("install", (event) => event.waitUntil(install()));
scope.addEventListener("activate", (event) => event.waitUntil(activate()));
scope.addEventListener("fetch", (event) => {
  const { method, url } = event.request;
  if (method === "GET" && new URL(url).origin === scope.location.origin) event.respondWith(answer(event.request));
});
