// Connects the parts of the page: the stream of frames, the status every half second, the rows of the plots.
import { ask } from './api.js';
import { Controls } from './controls.js';
import { Plots } from './plots.js';
import { readScene, RecordReader } from './records.js';
import { StreamLimits } from './stream.js';
import { View } from './view.js';

const POLL = 500, RETRY = 1000, SILENT = 3, NOTICE = 15000; // ms, ms, s, ms
const element = (id) => document.getElementById(id);

// What was measured, in ms, and counted; tests read it.
const times = { frames: 0, parse: 0, upload: 0, pictures: 0, orbits: 0, orbitToDraw: 0, orbitToPicture: 0, picture: 0 };
const view = new View(times);
const plots = new Plots();
const controls = new Controls(() => ({ eye: view.eye(), target: view.target() }), () => poll());
const limits = new StreamLimits(controls);
let status = null, sceneNumber = 0, timer = 0, polling = false;
window.shorebreak = { times, view, plots };

// ---- notices ----

let noticeTimer = 0;

function notice(message, stays = false) {
  const place = element('notice');
  clearTimeout(noticeTimer);
  place.textContent = message;
  place.hidden = message === '';
  if (message && !stays) noticeTimer = setTimeout(() => notice(''), NOTICE);
}

function showState(name, label = name) {
  element('state').className = `state ${name}`;
  element('state').textContent = label;
}

// ---- facts ----

const seconds = (s) =>
  (s < 90 ? `${s.toFixed(0)} s` : s < 5400 ? `${(s / 60).toFixed(0)} min` : `${(s / 3600).toFixed(1)} h`);
const percent = (part) => `${Number((100 * part).toPrecision(2))} %`;

function facts(s) {
  return [
    ['Time', `${s.time_s.toFixed(2)} of ${Number(s.duration_s.toPrecision(4))} s`],
    ['Remaining', s.state === 'done' ? 'none' : s.eta_s === null ? 'not known' : seconds(s.eta_s)],
    ['Step', String(s.step)],
    ['Time step', `${Number((1e3 * s.time_step_s).toPrecision(3))} ms`],
    ['Iterations', String(s.iterations)],
    ['Density error', percent(s.density_error), s.density_error > 2 * s.tolerance],
    ['Particles', s.fluid_particles.toLocaleString('en')],
    ['Lost', s.lost_particles.toLocaleString('en'), s.lost_particles > 0.01 * s.fluid_particles],
    ['Max. speed', `${Number(s.max_speed.toPrecision(3))} m/s`],
    ['Stream loss', percent(s.loss), s.loss > 0.01],
  ];
}

function showFacts(s) {
  const place = element('facts');
  const rows = facts(s);
  while (place.children.length < rows.length) {
    const row = document.createElement('div');
    row.append(document.createElement('dt'), document.createElement('dd'));
    place.append(row);
  }
  rows.forEach(([name, value, bad], k) => {
    const [term, detail] = place.children[k].children;
    term.textContent = name;
    detail.textContent = value;
    detail.className = bad ? 'bad' : '';
  });
  element('progress').style.width = `${100 * Math.min(1, s.duration_s > 0 ? s.time_s / s.duration_s : 0)}%`;
}

function show(s) {
  element('run').textContent = s.run;
  document.title = `${s.run} – shorebreak`;
  if (status && status.run_id !== s.run_id)
    notice(`The run was started again at ${s.time_s.toFixed(2)} s; this page follows it.`);
  if (s.state !== 'done' && s.silent_s > SILENT) {
    showState('lost', 'silent');
    notice(`No message from the run for ${seconds(s.silent_s)}.`, true);
  } else {
    showState(s.state);
    if (element('notice').textContent.startsWith('No ') || element('notice').textContent.startsWith('The connection'))
      notice('');
    if (s.state === 'done' && !(status && status.state === 'done')) notice('The run has ended.', true);
  }
  status = s;
  showFacts(s);
  controls.setStatus(s);
  limits.setStatus(s);
}

// ---- status, scene and rows ----

async function update() {
  const s = await (await ask('/status')).json();
  show(s);
  plots.load(s.plots);
  if (s.scene !== sceneNumber) {
    const scene = readScene(await (await ask('/scene')).arrayBuffer());
    sceneNumber = s.scene;
    view.setScene(scene);
    controls.setScene(scene);
  }
  for (let more = plots.lags(s); more;) more = plots.add(await (await ask(plots.query)).json());
}

function explain(problem) {
  if (problem.status === 401) {
    showState('lost', 'token needed');
    notice('The server shows this run only to those who have its token. Enter it below the buttons.', true);
    controls.needToken();
  } else if (problem.status === 503) {
    showState('waiting');
    notice('No run is sending yet.', true);
  } else if (status && status.state === 'done') {
    showState('done');
    notice('The run has ended, and so has its server. This page shows its end.', true);
  } else {
    showState('lost', 'no connection');
    notice(`The connection to the server is lost (${problem.message}). Trying again.`, true);
  }
}

async function poll() {
  clearTimeout(timer);
  if (polling) return;
  polling = true;
  let wait = POLL;
  try {
    if (!document.hidden) await update();
  } catch (problem) {
    explain(problem);
    wait = RETRY;
  }
  polling = false;
  timer = setTimeout(poll, wait);
}

// ---- frames ----

const reader = new RecordReader((frame) => {
  times.frames++;
  times.time = frame.time;
  view.setFrame(frame);
});

// Reads until the server ends the stream, or the page is hidden.
async function readFrames() {
  const stop = new AbortController();
  const hide = () => { if (document.hidden) stop.abort(); };
  document.addEventListener('visibilitychange', hide);
  try {
    const pieces = (await ask('/frames', { signal: stop.signal })).body.getReader();
    reader.restart();
    for (let spent = 0, frames = times.frames; ;) {
      const { done, value } = await pieces.read();
      if (done) return;
      const begin = performance.now();
      reader.add(value);
      spent += performance.now() - begin;
      if (times.frames === frames) continue;
      times.parse = spent / (times.frames - frames);
      spent = 0;
      frames = times.frames;
    }
  } finally {
    document.removeEventListener('visibilitychange', hide);
    stop.abort();
  }
}

async function followFrames() {
  for (;;) {
    try {
      if (!document.hidden) await readFrames();
    } catch { /* the status says what is wrong */ }
    await new Promise((resolve) => { setTimeout(resolve, RETRY); });
  }
}

document.addEventListener('visibilitychange', () => { if (!document.hidden) poll(); });
poll();
followFrames();
