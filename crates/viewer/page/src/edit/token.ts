/** The token of the server, without which it answers no question: the address that `platewash edit` printed has it. */

const KEY = "platewash-token";
const TOKEN = /^[0-9a-f]{32}$/;

/** Where there is no storage, for this page alone. */
let own = "";

/** Takes the token out of the page's address, so that it is in no bookmark, and keeps it for pages of this address. */
export function takeToken(): void {
  const entries = new URLSearchParams(location.hash.slice(1));
  const given = entries.get("token");
  if (given === null || !TOKEN.test(given)) return;
  own = given;
  try {
    localStorage.setItem(KEY, given);
  } catch {
    // A page that may store nothing asks as long as it is open.
  }
  entries.delete("token");
  const rest = entries.toString();
  history.replaceState(history.state, "", rest === "" ? location.pathname + location.search : `#${rest}`);
}

/** The token that was taken last by a page of this address; empty where none was. */
export function keptToken(): string {
  try {
    return localStorage.getItem(KEY) ?? own;
  } catch {
    return own;
  }
}
