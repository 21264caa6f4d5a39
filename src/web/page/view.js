// The picture on the page: when it is drawn, the hand that turns it, the cameras of the scene, the legend.
import { Camera, cameraAt } from './camera.js';
import { Picture, STRIDE_MAX } from './picture.js';

const TURN = 0.006; // radians per pixel
// ms: while the camera moves, fewer particles are drawn if a picture takes longer, and more if it takes less.
const SLOW = 40, FAST = 15;
const COARSE = 2; // above so many, the picture has half as many pixels along a side as well
const element = (id) => document.getElementById(id);

export class View {
  constructor(times) {
    this.times = times; // what was measured, for tests
    this.canvas = element('picture');
    this.camera = new Camera();
    this.preset = null; // whose keys the camera follows
    this.waiting = null; // a frame that is not uploaded yet
    this.requested = false;
    this.pointers = new Map();
    this.moved = 0; // time stamp of the event that moved the camera; 0: drawn
    this.moving = false;
    this.every = 1; // one particle in so many is drawn while the camera moves
    this.fence = null;
    this.next = null;
    this.automatic = { speed: 0, pressure: 0 }; // tops of the scale if the scene gives none
    try {
      this.picture = new Picture(this.canvas);
    } catch (problem) {
      element('no-picture').textContent = `${problem.message} The plots and facts work without the picture.`;
      element('no-picture').hidden = false;
      return;
    }
    this.listen();
    this.drawScale();
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => this.press(event));
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'])
      canvas.addEventListener(name, (event) => this.release(event));
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.move(event, () => this.camera.zoom(Math.exp(0.0012 * event.deltaY)));
      this.settleSoon();
    }, { passive: false });
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('keydown', (event) => this.pressKey(event));
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => { this.picture.setUp(); this.request(); });
    element('colour').addEventListener('change', () => { this.drawScale(); this.request(); });
    new ResizeObserver(() => this.request()).observe(canvas);
    document.addEventListener('visibilitychange', () => this.request());
    element('hint').textContent = 'Drag: turn. Right button or two fingers: move. Wheel or pinch: zoom.';
  }

  // ---- the hand ----

  press(event) {
    try {
      this.canvas.setPointerCapture(event.pointerId);
    } catch { /* the pointer has gone already */ }
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.canvas.classList.add('dragging');
    this.moving = true;
  }

  drag(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.x, dy = event.clientY - last.y, height = this.canvas.clientHeight || 1;
    const before = this.spread();
    last.x = event.clientX;
    last.y = event.clientY;
    const pans = event.buttons & 6 || event.shiftKey || this.pointers.size > 1;
    this.move(event, () => {
      if (!pans) this.camera.orbit(TURN * dx, TURN * dy);
      else this.camera.pan(dx / height / this.pointers.size, -dy / height / this.pointers.size);
      const after = this.spread();
      if (before > 0 && after > 0) this.camera.zoom(before / after);
    });
  }

  // Distance of two fingers; 0 if there are not two.
  spread() {
    if (this.pointers.size !== 2) return 0;
    const [a, b] = this.pointers.values();
    return Math.hypot(a.x - b.x, a.y - b.y);
  }

  release(event) {
    if (!this.pointers.delete(event.pointerId) || this.pointers.size > 0) return;
    this.canvas.classList.remove('dragging');
    this.settle();
  }

  pressKey(event) {
    const step = 0.08;
    const keys = {
      ArrowLeft: () => this.camera.orbit(step, 0), ArrowRight: () => this.camera.orbit(-step, 0),
      ArrowUp: () => this.camera.orbit(0, step), ArrowDown: () => this.camera.orbit(0, -step),
      '+': () => this.camera.zoom(0.9), '-': () => this.camera.zoom(1 / 0.9),
    };
    if (!keys[event.key]) return;
    event.preventDefault();
    this.move(event, keys[event.key]);
    this.settleSoon();
  }

  move(event, change) {
    change();
    this.follow(null);
    this.moving = true;
    if (this.moved === 0) this.moved = event.timeStamp;
    this.request();
  }

  settle() {
    this.moving = false;
    this.request(); // with all particles
  }

  settleSoon() {
    clearTimeout(this.settling);
    this.settling = setTimeout(() => { if (this.pointers.size === 0) this.settle(); }, 200);
  }

  // ---- scene and frames ----

  setScene(scene) {
    if (!this.picture) return;
    const first = !this.scene || this.scene.run !== scene.run;
    this.scene = scene;
    this.picture.setScene(scene);
    this.camera.size = Math.hypot(...scene.domain_max.map((value, k) => value - scene.domain_min[k]));
    const presets = [{ name: 'whole domain', keys: null }, ...scene.cameras];
    element('cameras').replaceChildren(...presets.map((preset) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = preset.name;
      button.addEventListener('click', () => this.choose(preset));
      return button;
    }));
    this.presets = presets;
    if (first) this.choose(presets[presets.length > 1 ? 1 : 0]);
    this.drawScale();
    this.request();
  }

  choose(preset) {
    if (preset.keys) this.place(preset, this.time || 0);
    else this.camera.lookAtBox(...this.box());
    this.follow(preset);
    this.request();
  }

  box() {
    const { origin } = this.picture;
    return [this.scene.domain_min, this.scene.domain_max].map((end) => end.map((value, k) => value - origin[k]));
  }

  place(preset, time) {
    const { origin } = this.picture, { eye, target, fov } = cameraAt(preset.keys, time);
    this.camera.look(eye.map((value, k) => value - origin[k]), target.map((value, k) => value - origin[k]), fov);
  }

  follow(preset) {
    this.preset = preset;
    [...element('cameras').children].forEach((button, k) =>
      button.setAttribute('aria-pressed', String(this.presets[k] === preset)));
  }

  // The frame's bytes stay as they are until the one after the next has come.
  setFrame(frame) {
    this.waiting = frame;
    this.time = frame.time;
    this.request();
  }

  // Where the picture is seen from, and what it looks at, in the coordinates of the scene.
  eye() {
    return this.camera.eye().map((value, k) => value + (this.scene ? this.picture.origin[k] : 0));
  }

  target() {
    return this.camera.target.map((value, k) => value + (this.scene ? this.picture.origin[k] : 0));
  }

  // ---- drawing ----

  request() {
    if (this.requested || !this.picture || document.hidden) return;
    this.requested = true;
    requestAnimationFrame(() => this.draw());
  }

  draw() {
    this.requested = false;
    if (!this.picture || this.picture.gl.isContextLost()) return;
    const begin = performance.now();
    if (this.waiting) {
      this.picture.setFrame(this.waiting);
      this.widen(this.waiting);
      this.waiting = null;
      this.times.upload = performance.now() - begin;
    }
    if (this.preset && this.preset.keys && this.preset.keys.length > 1) this.place(this.preset, this.time || 0);
    this.picture.resize(this.moving && this.every > COARSE ? 0.5 : 1);
    this.picture.setColouring(element('colour').value, this.top());
    const every = this.moving ? Math.round(this.every) : 1;
    this.picture.draw(this.camera, every);
    this.times.pictures++;
    this.times.every = every;
    if (this.moved > 0) {
      this.times.orbitToDraw = performance.now() - this.moved;
      this.times.orbits++;
    }
    this.watch(begin, every, this.moved);
    this.moved = 0;
  }

  // Measures when the graphics processor has finished the picture.
  watch(begin, every, moved) {
    if (this.fence) {
      if (moved > 0) this.next ??= [begin, every, moved]; // it is measured when this one is finished
      return;
    }
    const { gl } = this.picture;
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      const done = gl.isContextLost() ? gl.WAIT_FAILED : gl.clientWaitSync(this.fence, 0, 0);
      if (done === gl.TIMEOUT_EXPIRED) { setTimeout(look, 4); return; }
      gl.deleteSync(this.fence);
      this.fence = null;
      const taken = performance.now() - begin;
      this.times.picture = taken;
      if (moved > 0) this.times.orbitToPicture = performance.now() - moved;
      if (taken > SLOW) this.every = Math.min(STRIDE_MAX, Math.max(this.every, 1.3 * every, every * taken / SLOW / 2));
      else if (taken < FAST) this.every = Math.max(1, this.every / 1.2);
      const { next } = this;
      this.next = null;
      if (next) this.watch(...next);
    };
    setTimeout(look, 1);
  }

  // ---- the legend ----

  // Without a top in the scene the scale grows with the largest value so far.
  widen(frame) {
    const before = this.top();
    this.automatic.speed = Math.max(this.automatic.speed, frame.speedMax);
    this.automatic.pressure = Math.max(this.automatic.pressure, frame.pressureMax);
    if (this.top() !== before) this.drawScale();
  }

  top() {
    const name = element('colour').value;
    const given = this.scene ? (name === 'speed' ? this.scene.speed_max : this.scene.pressure_max) : 0;
    return given > 0 ? given : this.automatic[name];
  }

  drawScale() {
    const scale = element('scale'), context = scale.getContext('2d'), image = context.createImageData(scale.width, 1);
    for (let x = 0; x < scale.width; x++) {
      const from = 4 * Math.floor(x / scale.width * 256);
      image.data.set(this.picture.table.subarray(from, from + 4), 4 * x);
    }
    for (let y = 0; y < scale.height; y++) context.putImageData(image, 0, y);
    const top = this.top() * (element('colour').value === 'pressure' ? 1e-3 : 1);
    element('ticks').replaceChildren(...[0, 0.5, 1].map((part) => {
      const tick = document.createElement('span');
      tick.textContent = String(Number((part * top).toPrecision(2)));
      return tick;
    }));
  }
}
