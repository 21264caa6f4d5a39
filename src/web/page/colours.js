// The colour map of the water, the one of the pictures: L* is linear, a* and b* go from navy over cyan to white.
const A = [9, 3, -6, -17, -14, -1], B = [-34, -38, -34, -24, -12, -1];

function spline(knots, t) {
  const at = t * (knots.length - 1), k = Math.min(Math.floor(at), knots.length - 2), s = at - k;
  const a = knots[k], b = knots[k + 1];
  const before = k > 0 ? (b - knots[k - 1]) / 2 : b - a, after = k < knots.length - 2 ? (knots[k + 2] - a) / 2 : b - a;
  return a + (b - a) * s * s * (3 - 2 * s) + before * s * (1 - s) * (1 - s) + after * s * s * (s - 1);
}

const fromLab = (f) => (f > 6 / 29 ? f ** 3 : 3 * (6 / 29) ** 2 * (f - 4 / 29));

function encode(linear) {
  const value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
  return Math.round(255 * Math.max(0, Math.min(1, value)));
}

function colour(t) {
  const f = (21 + 76 * t + 16) / 116;
  const x = 0.95047 * fromLab(f + spline(A, t) / 500), y = fromLab(f), z = 1.08883 * fromLab(f - spline(B, t) / 200);
  return [encode(3.2404542 * x - 1.5371385 * y - 0.4985314 * z), encode(-0.969266 * x + 1.8760108 * y + 0.041556 * z),
    encode(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)];
}

// RGBA of 256 colours.
export function colourTable() {
  const table = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; i++) table.set([...colour(i / 255), 255], 4 * i);
  return table;
}

// Distinct colours for lines on white.
export function lineColour(index) {
  const first = ['#10598f', '#c4541a', '#2f7d4f', '#8a3d8f', '#a8842c', '#4b5bb5', '#b03a55', '#3b8a8a'];
  return index < first.length ? first[index] : `hsl(${(index * 137.5) % 360} 55% 42%)`;
}
