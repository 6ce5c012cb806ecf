/** Colours for shares: even steps in lightness from dark violet over teal to pale yellow, legible without seeing red or green. */

/** Lightness, chroma and hue [deg] in Oklch, evenly spaced. */
const ANCHORS = [
  [0.26, 0.11, 300],
  [0.4, 0.11, 268],
  [0.54, 0.1, 222],
  [0.68, 0.11, 175],
  [0.82, 0.15, 128],
  [0.95, 0.14, 104],
] as const;

function gamma(linear: number): number {
  const x = Math.max(0, Math.min(1, linear));
  return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

/** sRGB bytes of a colour in Oklab (B. Ottosson's matrices), clipped to what a screen shows. */
function bytesOf(lightness: number, a: number, b: number): [number, number, number] {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const byte = (linear: number): number => Math.round(255 * gamma(linear));
  return [
    byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    byte(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

function sample(share: number): [number, number, number] {
  const at = share * (ANCHORS.length - 1);
  const k = Math.min(ANCHORS.length - 2, Math.floor(at));
  const rest = at - k;
  const mixed = (component: 0 | 1 | 2): number => ANCHORS[k]![component] * (1 - rest) + ANCHORS[k + 1]![component] * rest;
  const hue = (mixed(2) * Math.PI) / 180;
  return bytesOf(mixed(0), mixed(1) * Math.cos(hue), mixed(1) * Math.sin(hue));
}

/** The map as `count` colours from share 0 to 1: red, green, blue, alpha bytes each. */
export function colormap(count = 256): Uint8Array {
  const bytes = new Uint8Array(4 * count);
  for (let i = 0; i < count; i++) bytes.set([...sample(i / Math.max(1, count - 1)), 255], 4 * i);
  return bytes;
}

/** The map as CSS gradient, for a legend. */
export function cssGradient(direction = "to right"): string {
  const stops = Array.from({ length: 9 }, (_, i) => `rgb(${sample(i / 8).join(" ")}) ${(100 * i) / 8}%`);
  return `linear-gradient(${direction}, ${stops.join(", ")})`;
}
