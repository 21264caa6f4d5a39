// A camera that looks at a target from a distance; z is up. Angles in radians, lengths in metres.
const UP_LIMIT = 1.55;

const add = (a, b, by = 1) => a.map((value, k) => value + by * b[k]);
const subtract = (a, b) => add(a, b, -1);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const length = Math.hypot(...a) || 1; return a.map((value) => value / length); };

export class Camera {
  constructor() {
    this.target = [0, 0, 0];
    this.distance = 10;
    this.azimuth = -1.2;
    this.elevation = 0.45;
    this.fov = 42;
    this.size = 10; // of the scene
  }

  look(eye, target, fov) {
    const from = subtract(eye, target);
    this.target = target.slice();
    this.distance = Math.max(Math.hypot(...from), 1e-3);
    this.azimuth = Math.atan2(from[1], from[0]);
    this.elevation = Math.asin(Math.max(-1, Math.min(1, from[2] / this.distance)));
    this.fov = fov;
  }

  // Sees a box from its long side.
  lookAtBox(min, max) {
    const size = subtract(max, min), middle = add(min, size, 0.5);
    this.azimuth = size[0] >= size[1] ? -1.9 : 2.7;
    this.elevation = 0.5;
    this.fov = 40;
    this.target = middle;
    this.distance = 0.55 * Math.hypot(...size) / Math.tan(this.fov * Math.PI / 360);
  }

  direction() {
    const flat = Math.cos(this.elevation);
    return [flat * Math.cos(this.azimuth), flat * Math.sin(this.azimuth), Math.sin(this.elevation)];
  }

  eye() {
    return add(this.target, this.direction(), this.distance);
  }

  // Columns of the rotation: right, up, back.
  axes() {
    const back = this.direction(), right = [-Math.sin(this.azimuth), Math.cos(this.azimuth), 0];
    return [right, unit(cross(back, right)), back];
  }

  orbit(dx, dy) {
    this.azimuth -= dx;
    this.elevation = Math.max(-UP_LIMIT, Math.min(UP_LIMIT, this.elevation + dy));
  }

  // By fractions of the picture's height.
  pan(dx, dy) {
    const [right, up] = this.axes(), height = 2 * this.distance * Math.tan(this.fov * Math.PI / 360);
    this.target = add(add(this.target, right, -dx * height), up, dy * height);
  }

  zoom(factor) {
    this.distance = Math.max(1e-3 * this.size, Math.min(20 * this.size, this.distance * factor));
  }

  view() {
    const [r, u, b] = this.axes(), eye = this.eye();
    return new Float32Array([r[0], u[0], b[0], 0, r[1], u[1], b[1], 0, r[2], u[2], b[2], 0,
      -dot(r, eye), -dot(u, eye), -dot(b, eye), 1]);
  }

  projection(aspect) {
    // A narrow picture shows as much sideways as one of 4:3.
    const scale = 1 / Math.tan(this.fov * Math.PI / 360) * Math.min(1, aspect / (4 / 3));
    const near = 0.02 * this.distance, far = this.distance + 4 * this.size;
    return new Float32Array([scale / aspect, 0, 0, 0, 0, scale, 0, 0, 0, 0, (near + far) / (near - far), -1,
      0, 0, 2 * near * far / (near - far), 0]);
  }
}

// The place of a scene's camera at a time: between its keys on straight lines.
export function cameraAt(keys, time) {
  let k = 0;
  while (k + 1 < keys.length && keys[k + 1].time <= time) k++;
  const a = keys[k], b = keys[Math.min(k + 1, keys.length - 1)];
  const part = b.time > a.time ? Math.max(0, Math.min(1, (time - a.time) / (b.time - a.time))) : 0;
  const mix = (from, to) => from.map((value, i) => value + part * (to[i] - value));
  return { eye: mix(a.eye, b.eye), target: mix(a.target, b.target), fov: a.fov + part * (b.fov - a.fov) };
}
