// The shaders of the picture. Light comes from above the camera's left shoulder, in the camera's coordinates.
const LIGHT = 'const vec3 light = normalize(vec3(-0.35, 0.75, 0.55));';

// A particle is drawn as a square of pixels that shows a sphere. Its position is decoded here from the integers of the
// stream; so are speed and pressure, of which the stream has the square root.
const waterVertex = `#version 300 es
layout(location = 0) in vec3 cell;
layout(location = 1) in vec2 look;
uniform mat4 view, projection;
uniform vec3 corner, chosen; // chosen: weights of speed and pressure, largest value / top of the scale
uniform float quantum, radius, pixels;
out vec3 tint;
flat out float small;
uniform sampler2D colours;
void main() {
  vec4 at = view * vec4(corner + quantum * cell, 1.0);
  gl_Position = projection * at;
  gl_PointSize = clamp(pixels * radius / -at.z, 1.0, 256.0);
  small = gl_PointSize < 3.0 ? 1.0 : 0.0;
  float root = dot(look, chosen.xy), value = root * root * chosen.z;
  tint = texture(colours, vec2((clamp(value, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}`;

const waterFragment = `#version 300 es
precision mediump float;
in vec3 tint;
flat in float small;
out vec4 colour;
${LIGHT}
void main() {
  vec2 at = vec2(2.0, -2.0) * gl_PointCoord + vec2(-1.0, 1.0);
  float square = dot(at, at);
  if (small > 0.5) square = 0.3;
  else if (square > 1.0) discard;
  float bright = dot(vec3(at, sqrt(1.0 - square)), light);
  colour = vec4(tint * (0.62 + 0.42 * max(bright, 0.0)), 1.0);
}`;

const meshVertex = `#version 300 es
layout(location = 0) in vec3 position;
uniform mat4 view, projection;
uniform vec3 shift;
out vec3 place;
void main() {
  vec4 at = view * vec4(position + shift, 1.0);
  place = at.xyz;
  gl_Position = projection * at;
}`;

// Triangles are flat: their normal is that of the surface through neighbouring pixels.
const meshFragment = `#version 300 es
precision highp float;
in vec3 place;
uniform vec3 paint, up;
out vec4 colour;
${LIGHT}
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  if (dot(normal, place) > 0.0) normal = -normal;
  float sky = 0.5 + 0.5 * dot(normal, up);
  colour = vec4(paint * (0.38 + 0.30 * sky + 0.34 * max(dot(normal, light), 0.0)), 1.0);
}`;

const lineFragment = `#version 300 es
precision mediump float;
in vec3 place;
uniform vec4 paint;
out vec4 colour;
void main() { colour = paint; }`;

function compile(gl, kind, text) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
    throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

function link(gl, vertex, fragment) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, vertex));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, fragment));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(gl.getProgramInfoLog(program));
  const at = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
    const name = gl.getActiveUniform(program, i).name;
    at[name] = gl.getUniformLocation(program, name);
  }
  return { program, at };
}

export function makePrograms(gl) {
  return {
    water: link(gl, waterVertex, waterFragment),
    mesh: link(gl, meshVertex, meshFragment),
    line: link(gl, meshVertex, lineFragment),
  };
}
