/** What regions of a picture hold, by the share of their pixels: no pixel is compared with a picture of another day. */

/** The scene's canvas. */
const SCENE = "canvas.scene";

/** A picture of the scene alone, without what lies over it. */
export async function picture(page) {
  await page.addStyleTag({ content: `${SCENE} { visibility: visible } body :not(${SCENE}) { visibility: hidden !important }` });
  await page.evaluate(() => window.platewash.step());
  return (await page.locator(SCENE).screenshot()).toString("base64");
}

/** Where places of the world are on it [px]. */
export const projected = (page, places) => page.evaluate((places) => places.map((place) => window.platewash.project(place)), places);

/** In squares of `edge` pixels round points of a picture, the share of pixels of each kind: ranges of hue [°], saturation, lightness. */
export const shares = (page, picture, points, edge, kinds) => apart(page, ofKind, { pictures: [picture], points, edge, kinds });

/** The share of pixels that two pictures show differently. */
export const changed = (page, one, other, points, edge) => apart(page, differing, { pictures: [one, other], points, edge });

/** Works on pixels in a page of its own. */
async function apart(page, work, { pictures, points, edge, kinds }) {
  const blank = await page.context().newPage();
  try {
    await blank.evaluate(`window.squares = ${squares}`);
    return await blank.evaluate(work, { pictures, points, edge, kinds });
  } finally {
    await blank.close();
  }
}

/** In the browser: the pixels of each square in each picture. */
async function squares(pictures, points, edge) {
  const decoded = pictures.map(async (picture) => {
    const image = new Image();
    image.src = `data:image/png;base64,${picture}`;
    await image.decode();
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    return points.map(([x, y]) => context.getImageData(Math.round(x - edge / 2), Math.round(y - edge / 2), edge, edge).data);
  });
  return Promise.all(decoded);
}

/** In the browser. */
async function ofKind({ pictures, points, edge, kinds }) {
  const hsl = (r, g, b) => {
    const [high, low] = [Math.max(r, g, b), Math.min(r, g, b)];
    const [span, lightness] = [high - low, (high + low) / 510];
    if (span === 0) return [0, 0, lightness];
    const sixths = high === r ? ((g - b) / span + 6) % 6 : high === g ? (b - r) / span + 2 : (r - g) / span + 4;
    return [60 * sixths, span / 255 / (1 - Math.abs(2 * lightness - 1)), lightness];
  };
  const within = (value, [low, high]) => value >= low && value <= high;
  const [found] = await window.squares(pictures, points, edge);
  return found.map((data) => {
    const counts = Object.fromEntries(Object.keys(kinds).map((kind) => [kind, 0]));
    for (let at = 0; at < data.length; at += 4) {
      const [hue, saturation, lightness] = hsl(data[at], data[at + 1], data[at + 2]);
      for (const [kind, range] of Object.entries(kinds)) {
        const fits = within(hue, range.hue) && within(saturation, range.saturation) && within(lightness, range.lightness);
        if (fits) counts[kind] += 4 / data.length;
      }
    }
    return counts;
  });
}

/** In the browser. */
async function differing({ pictures, points, edge }) {
  const [one, other] = await window.squares(pictures, points, edge);
  return one.map((data, square) => {
    let count = 0;
    for (let at = 0; at < data.length; at += 4) {
      const apart = [0, 1, 2].map((channel) => Math.abs(data[at + channel] - other[square][at + channel]));
      if (Math.max(...apart) > 16) count += 4 / data.length;
    }
    return count;
  });
}
