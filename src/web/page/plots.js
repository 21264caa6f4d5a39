// Plots of the forces on bodies and of the gauges by dygraphs, which the server has if it is installed there.
import { lineColour } from './colours.js';

const element = (id) => document.getElementById(id);
const text = (tag, content) => Object.assign(document.createElement(tag), { textContent: content });

// One table of GET /rows: grows, or begins anew when its generation changes.
class Table {
  constructor() {
    this.generation = 0;
    this.names = [];
    this.rows = [];
  }

  get place() {
    return `${this.generation}.${this.rows.length}`;
  }

  // Returns whether anything has changed.
  add({ generation, from, names, rows }) {
    const anew = generation !== this.generation || from !== this.rows.length;
    const changed = anew || rows.length > 0 || names.length !== this.names.length;
    if (anew) this.rows.length = from;
    this.generation = generation;
    this.names = names;
    this.rows.push(...rows);
    return changed;
  }
}

class Plot {
  // columns: of a row, the values of all names.
  constructor(id, columns) {
    this.id = id;
    this.columns = columns;
    this.hidden = new Set();
    this.names = [];
    this.outputs = [];
  }

  update(table) {
    if (!window.Dygraph) return;
    const names = table.names;
    const data = table.rows.map((row) => [row[0], ...this.columns(row, names.length)]);
    if (names.join('\n') !== this.names.join('\n')) this.start(names);
    if (names.length === 0 || data.length === 0) return;
    if (this.graph) this.graph.updateOptions({ file: data });
    else this.make(data, names);
    this.data = data;
    this.show(data.length - 1);
  }

  // The names of bodies are never given to dygraphs, which would read them as HTML.
  make(data, names) {
    this.graph = new window.Dygraph(element(this.id), data, {
      labels: ['t', ...names.map((name, k) => `s${k}`)],
      colors: names.map((name, k) => lineColour(k)),
      visibility: names.map((name) => !this.hidden.has(name)),
      legend: 'never', xlabel: 't, s', strokeWidth: 1.4, gridLineColor: '#e6ebf0', axisLineColor: '#c5ced7',
      axisLabelFontSize: 11, xLabelHeight: 14, axes: { x: { pixelsPerLabel: 45 }, y: { pixelsPerLabel: 28 } },
      connectSeparatedPoints: false, animatedZooms: false,
      highlightCallback: (event, x, points, row) => this.show(row),
      unhighlightCallback: () => this.show(this.data.length - 1),
    });
  }

  start(names) {
    if (this.graph) this.graph.destroy();
    this.graph = null;
    this.names = names.slice();
    this.outputs = names.map(() => document.createElement('output'));
    element(`${this.id}-legend`).replaceChildren(...names.map((name, k) => {
      const item = document.createElement('li'), button = document.createElement('button');
      const mark = document.createElement('i');
      mark.style.background = lineColour(k);
      button.type = 'button';
      button.append(mark, text('span', name), this.outputs[k]);
      button.setAttribute('aria-pressed', String(!this.hidden.has(name)));
      button.addEventListener('click', () => this.toggle(button, name, k));
      item.append(button);
      return item;
    }));
  }

  toggle(button, name, k) {
    const show = this.hidden.has(name);
    if (show) this.hidden.delete(name);
    else this.hidden.add(name);
    button.setAttribute('aria-pressed', String(show));
    if (this.graph) this.graph.setVisibility(k, show);
  }

  // The values of a row beside the names.
  show(row) {
    const values = this.data ? this.data[row] : null;
    this.outputs.forEach((output, k) => {
      const value = values ? values[k + 1] : null;
      const small = Math.abs(value) < 1e-3 ? 0 : Number(value?.toPrecision(3));
      output.textContent = value === null || value === undefined ? '' : String(small);
    });
  }
}

// Forces are in kN, or in MN when one is above 10 MN.
let newton = 1e-3;

function chooseUnit(rows) {
  let largest = 0;
  for (const row of rows) for (let k = 1; k < row.length; k++) largest = Math.max(largest, Math.abs(row[k]));
  newton = largest > 1e7 ? 1e-6 : 1e-3;
  element('forces-title').textContent = newton === 1e-6 ? 'Forces, MN' : 'Forces, kN';
}

function components(row, count) {
  const which = element('component').value, values = new Array(count);
  for (let k = 0; k < count; k++) {
    const [x, y, z] = [row[3 * k + 1], row[3 * k + 2], row[3 * k + 3]];
    const value = which === 'horizontal' ? (x === null || y === null ? null : Math.hypot(x, y)) : { x, y, z }[which];
    values[k] = value === null ? null : newton * value;
  }
  return values;
}

export class Plots {
  constructor() {
    this.tables = { forces: new Table(), gauges: new Table() };
    this.plots = {
      forces: new Plot('forces', components),
      gauges: new Plot('gauges', (row) => row.slice(1)),
    };
    element('component').addEventListener('change', () => this.plots.forces.update(this.tables.forces));
  }

  // Loads dygraphs once.
  load(available) {
    if (this.loading !== undefined) return;
    this.loading = available;
    if (!available) {
      for (const id of ['forces', 'gauges'])
        element(id).replaceChildren(text('p', 'No plots: the package libjs-dygraphs is not installed on the server.'));
      element('plot-hint').hidden = true;
      return;
    }
    const style = Object.assign(document.createElement('link'), { rel: 'stylesheet', href: '/dygraphs.css' });
    const script = Object.assign(document.createElement('script'), { src: '/dygraphs.js' });
    script.addEventListener('load', () => {
      // Its legend would need styles in attributes, and would read names as HTML.
      window.Dygraph.PLUGINS = window.Dygraph.PLUGINS.filter((plugin) => plugin !== window.Dygraph.Plugins.Legend);
      this.update(['forces', 'gauges']);
    });
    document.head.append(style, script);
  }

  // Whether the server has rows that this page does not have.
  lags(status) {
    return ['forces', 'gauges'].some((name) =>
      `${status[name].generation}.${status[name].rows}` !== this.tables[name].place);
  }

  get query() {
    return `/rows?forces=${this.tables.forces.place}&gauges=${this.tables.gauges.place}`;
  }

  // Takes an answer to that query. Returns whether more rows are there.
  add(answer) {
    this.update(['forces', 'gauges'].filter((name) => this.tables[name].add(answer[name])));
    return answer.forces.more || answer.gauges.more;
  }

  update(names) {
    if (names.includes('forces')) chooseUnit(this.tables.forces.rows);
    for (const name of names) this.plots[name].update(this.tables[name]);
  }
}
