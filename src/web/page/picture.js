// Draws the water, the bodies and the gauges with WebGL2. Particles are uploaded as they came; the shader decodes them.
import { colourTable } from './colours.js';
import { makePrograms } from './shaders.js';

const POINT = 8; // bytes of a particle
export const STRIDE_MAX = 8; // particles: fewer would not show the shape of the water
const SHOWN = 0.68; // radius of a drawn particle in particle spacings: without holes between neighbours
const SKY = [0.875, 0.906, 0.933];
const PLAIN = [0.74, 0.72, 0.68], GROUND = [0.70, 0.66, 0.57];

export class Picture {
  // Throws without WebGL2.
  constructor(canvas) {
    const gl = canvas.getContext('webgl2', { antialias: false, alpha: false, powerPreference: 'low-power' });
    if (!gl) throw new Error('This browser has no WebGL2.');
    this.canvas = canvas;
    this.gl = gl;
    this.table = colourTable();
    this.scene = null;
    this.frame = null;
    this.colouring = { chosen: [1, 0], top: 1 };
    this.setUp();
  }

  // Also after the browser has given the context back.
  setUp() {
    const gl = this.gl;
    this.programs = makePrograms(gl);
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, this.table);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    this.points = gl.createBuffer();
    this.capacity = 0;
    this.water = gl.createVertexArray();
    this.meshes = [];
    this.lines = null;
    gl.enable(gl.DEPTH_TEST);
    if (this.scene) this.setScene(this.scene);
    if (this.frame) this.setFrame(this.frame);
  }

  setScene(scene) {
    const gl = this.gl;
    for (const mesh of this.meshes) {
      gl.deleteVertexArray(mesh.array);
      mesh.buffers.forEach((buffer) => gl.deleteBuffer(buffer));
    }
    this.scene = scene;
    // Numbers on the graphics processor are relative to the middle of the domain, so that 32 bits are enough.
    this.origin = scene.domain_min.map((value, k) => (value + scene.domain_max[k]) / 2);
    this.corner = scene.domain_min.map((value, k) => value - this.origin[k]);
    this.meshes = scene.bodies.map((body, index) => ({ index, body })).filter(({ body }) => body.triangles > 0)
      .map(({ index, body }) => this.makeMesh(index, body));
    this.makeLines(scene);
  }

  makeMesh(index, body) {
    const gl = this.gl, array = gl.createVertexArray(), buffers = [gl.createBuffer(), gl.createBuffer()];
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffers[0]);
    gl.bufferData(gl.ARRAY_BUFFER, body.mesh, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[1]);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, body.corners, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    const paint = body.color[0] >= 0 ? body.color : body.terrain ? GROUND : PLAIN;
    return { index, array, buffers, count: body.corners.length, paint };
  }

  // The edges of the domain, and a line through each gauge.
  makeLines(scene) {
    const gl = this.gl, size = scene.domain_max.map((value, k) => value - scene.domain_min[k]), ends = [];
    for (let axis = 0; axis < 3; axis++)
      for (let corner = 0; corner < 8; corner++) {
        if (corner >> axis & 1) continue;
        const from = size.map((value, k) => (corner >> k & 1) * value), to = from.slice();
        to[axis] = size[axis];
        ends.push(...from, ...to);
      }
    this.edges = ends.length / 3;
    for (const gauge of scene.gauges) {
      const x = gauge.x - scene.domain_min[0], y = gauge.y - scene.domain_min[1];
      ends.push(x, y, 0, x, y, size[2]);
    }
    if (this.lines) gl.deleteBuffer(this.lines.buffer);
    this.lines = { array: gl.createVertexArray(), buffer: gl.createBuffer(), count: ends.length / 3 };
    gl.bindVertexArray(this.lines.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.lines.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(ends), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.bindVertexArray(null);
  }

  setFrame(frame) {
    const gl = this.gl;
    this.frame = frame;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.points);
    if (frame.points.length > this.capacity) {
      this.capacity = Math.ceil(1.2 * frame.points.length);
      gl.bufferData(gl.ARRAY_BUFFER, this.capacity, gl.STREAM_DRAW);
    }
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, frame.points);
  }

  // top: the value at which the scale of colours ends.
  setColouring(name, top) {
    this.colouring = { chosen: name === 'speed' ? [1, 0] : [0, 1], name, top };
  }

  // scale: pixels of the picture per pixel of the screen, along a side.
  resize(scale) {
    const ratio = scale * Math.min(window.devicePixelRatio || 1, 2), { canvas } = this;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
  }

  // every: one particle in so many is drawn.
  draw(camera, every = 1) {
    const { gl, canvas } = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...SKY, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (!this.scene) return;
    const view = camera.view(), projection = camera.projection(canvas.width / canvas.height);
    this.drawMeshes(view, projection);
    if (this.frame) this.drawWater(view, projection, Math.min(every, STRIDE_MAX));
    this.drawLines(view, projection);
  }

  use({ program, at }, view, projection) {
    this.gl.useProgram(program);
    this.gl.uniformMatrix4fv(at.view, false, view);
    this.gl.uniformMatrix4fv(at.projection, false, projection);
    return at;
  }

  drawMeshes(view, projection) {
    const gl = this.gl, at = this.use(this.programs.mesh, view, projection);
    const moved = new Map((this.frame ? this.frame.moved : []).map(({ body, by }) => [body, by]));
    gl.uniform3f(at.up, view[8], view[9], view[10]);
    for (const mesh of this.meshes) {
      const by = moved.get(mesh.index);
      gl.uniform3fv(at.shift, by ? this.corner.map((value, k) => value + by[k]) : this.corner);
      gl.uniform3fv(at.paint, mesh.paint);
      gl.bindVertexArray(mesh.array);
      gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0);
    }
  }

  drawWater(view, projection, every) {
    const { gl, frame, colouring } = this, at = this.use(this.programs.water, view, projection);
    const largest = colouring.name === 'pressure' ? frame.pressureMax : frame.speedMax;
    gl.uniform3f(at.chosen, ...colouring.chosen, colouring.top > 0 ? largest / colouring.top : 0);
    gl.uniform1f(at.quantum, frame.quantum);
    // Fewer particles are drawn larger, so that they cover the same surface.
    const radius = SHOWN * frame.spacing * Math.cbrt(frame.decimation * every);
    gl.uniform1f(at.radius, radius);
    gl.uniform1f(at.pixels, projection[5] * this.canvas.height);
    gl.bindVertexArray(this.water);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.points);
    gl.enableVertexAttribArray(0);
    gl.enableVertexAttribArray(1);
    for (const part of frame.parts) {
      const from = POINT * part.first;
      gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, false, POINT * every, from);
      gl.vertexAttribPointer(1, 2, gl.UNSIGNED_BYTE, true, POINT * every, from + 6);
      gl.uniform3fv(at.corner, part.corner.map((value, k) => value - this.origin[k]));
      gl.drawArrays(gl.POINTS, 0, Math.floor((part.count + every - 1) / every));
    }
  }

  drawLines(view, projection) {
    const gl = this.gl, at = this.use(this.programs.line, view, projection);
    gl.uniform3fv(at.shift, this.corner);
    gl.bindVertexArray(this.lines.array);
    gl.uniform4f(at.paint, 0.55, 0.61, 0.67, 1);
    gl.drawArrays(gl.LINES, 0, this.edges);
    gl.uniform4f(at.paint, 0.77, 0.33, 0.1, 1);
    gl.drawArrays(gl.LINES, this.edges, this.lines.count - this.edges);
    gl.bindVertexArray(null);
  }
}
