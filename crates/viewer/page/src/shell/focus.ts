/** Keeps the focus where it is while what it is in is made anew. */

/** The way from `root` down to an element, by places among siblings; null where it is not within. */
function wayTo(root: Element, element: Element | null): number[] | null {
  const way: number[] = [];
  for (let at = element; at !== root; at = at.parentElement) {
    if (at?.parentElement == null) return null;
    way.unshift([...at.parentElement.children].indexOf(at));
  }
  return way;
}

/** Calls `renew`; focus that this takes away goes to the element of the same kind in the same place. */
export function keepingFocus(root: Element, renew: () => void): void {
  const focused = document.activeElement;
  const way = wayTo(root, focused);
  const { scrollTop } = root;
  renew();
  if (root.scrollTop !== scrollTop) root.scrollTop = scrollTop;
  if (way === null || focused === null || focused.isConnected) return;
  let at: Element | undefined = root;
  for (const k of way) at = at?.children[k];
  if (at instanceof HTMLElement && at.tagName === focused.tagName) at.focus({ preventScroll: true });
}
