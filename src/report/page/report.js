// Plots and CSV links of a report. All data are in the element "data": for each table [{thinned, columns, names}, rows].
'use strict';
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const make = (tag, properties) => Object.assign(document.createElement(tag), properties);
  const COLOURS = ['#10598f', '#c4541a', '#2f7d4f', '#8a3d8f', '#a8842c', '#4b5bb5', '#b03a55', '#3b8a8a'];
  const colour = (k) => COLOURS[k] || `hsl(${(k * 137.5) % 360} 55% 42%)`;
  const SHOWN = 6;
  const PAPER = 660; // px, width of a plot on paper

  // What a plot can show of a row (an array of numbers, null for an empty cell), with the unit of SI and its name.
  const hypot = (a, b) => (a === null || b === null ? null : Math.hypot(a, b));
  const VIEWS = {
    forces: [
      ['Horizontal force', 'N', (r) => hypot(r[1], r[2])], ['Force along x', 'N', (r) => r[1]],
      ['Force along y', 'N', (r) => r[2]], ['Vertical force', 'N', (r) => r[3]],
      ['Overturning moment', 'N m', (r) => hypot(r[4], r[5])],
    ],
    gauges: [['Elevation', 'm', (r) => (r[1] === null ? r[2] : r[1])]],
    runup: [['Highest run-up, z', 'm', (r) => r[3]], ['Front along the line', 'm', (r) => r[4]]],
    overtopping: [['Net volume', 'm³', (r) => r[1]], ['Flux', 'm³/s', (r) => r[2]]],
    probes: [['Pressure', 'Pa', (r) => r[4]], ['Velocity along x', 'm/s', (r) => r[1]],
      ['Velocity along y', 'm/s', (r) => r[2]], ['Vertical velocity', 'm/s', (r) => r[3]]],
  };

  const parse = (text) => text.split('\n').filter(Boolean)
    .map((line) => line.split(',').map((cell) => (cell === '' ? null : Number(cell))));

  // kN and MN, kPa: the prefix that leaves the greatest value above 1.
  function prefix(unit, most) {
    if (!/^(N|Pa)/.test(unit)) return [1, unit];
    return most >= 1e7 ? [1e-6, `M${unit}`] : most >= 1e3 ? [1e-3, `k${unit}`] : [1, unit];
  }

  const figure = (value) => (value === null || value === undefined || Number.isNaN(value) ? '–'
    : String(Number(value.toPrecision(3))));

  // One row per time of any series. A cell without a row is null, which a line passes over; an empty cell is NaN, which
  // ends it.
  function join(series, view) {
    const at = new Map();
    series.forEach((rows, k) => rows.forEach((row) => {
      if (!at.has(row[0])) at.set(row[0], new Array(series.length + 1).fill(null));
      const value = view(row);
      at.get(row[0])[k + 1] = value === null ? NaN : value;
    }));
    return [...at.entries()].sort((a, b) => a[0] - b[0]).map(([time, row]) => { row[0] = time; return row; });
  }

  class Plot {
    constructor(element) {
      [this.about, this.rows] = data[element.dataset.table];
      this.views = VIEWS[element.dataset.table];
      this.series = this.rows.map(parse);
      this.flat = this.about.columns.some((name) => name.endsWith('_per_m'));
      this.graphElement = element.querySelector('.graph');
      this.list = element.querySelector('.series');
      this.items = this.about.items ? [...new Set(this.about.items)] : null;
      this.item = this.items ? this.items[0] : null;
      this.visible = this.series.map((rows, k) => (this.items ? this.about.items[k] === this.items[0] : k < SHOWN));
      this.head(element);
      this.legend();
      this.view = 0;
      this.show(0);
    }

    colour(k) { return colour(this.about.colours ? this.about.colours[k] : k); }

    // Shows the lines of one item, with the zoom of the time.
    choose(item) {
      this.item = item;
      this.visible = this.about.items.map((name) => name === item);
      const range = this.graph.isZoomed('x') ? this.graph.xAxisRange() : null;
      this.legend();
      this.show(this.view);
      if (range) this.graph.updateOptions({ dateWindow: range });
    }

    head(element) {
      const head = make('div', { className: 'plot-head' });
      this.unit = make('span', { className: 'unit' });
      const reset = make('button', { type: 'button', textContent: 'Whole time' });
      reset.addEventListener('click', () => this.graph && this.graph.resetZoom());
      head.append(this.unit);
      if (this.items && this.items.length > 1) {
        const select = make('select', { ariaLabel: 'Body, gauge or line' });
        this.items.forEach((name, i) => select.append(make('option', { value: i, textContent: name })));
        select.addEventListener('change', () => this.choose(this.items[Number(select.value)]));
        head.append(select);
      }
      if (this.views.length > 1) {
        const select = make('select', { ariaLabel: 'Quantity' });
        this.views.forEach(([name], v) => select.append(make('option', { value: v, textContent: name })));
        select.addEventListener('change', () => { this.view = Number(select.value); this.show(this.view); });
        head.append(select);
      }
      head.append(reset);
      element.prepend(head);
      const hint = make('span', { className: 'only-screen', textContent: ' Drag to zoom, double-click to see all; click a name to show or hide it.' });
      element.querySelector('figcaption').append(hint);
    }

    legend() {
      this.outputs = this.about.names.map(() => make('output', {}));
      this.list.replaceChildren(...this.about.names.map((name, k) => {
        const item = make('li', {}), button = make('button', { type: 'button' }), mark = make('i', {});
        mark.style.background = this.colour(k);
        button.append(mark, make('span', { textContent: name }), this.outputs[k]);
        button.setAttribute('aria-pressed', String(this.visible[k]));
        button.addEventListener('click', () => {
          this.visible[k] = !this.visible[k];
          button.setAttribute('aria-pressed', String(this.visible[k]));
          if (this.graph) this.graph.setVisibility(k, this.visible[k]);
        });
        item.append(button);
        item.hidden = this.items !== null && !this.visible[k];
        return item;
      }));
    }

    show(v) {
      const [name, unit, view] = this.views[v];
      let joined = join(this.series, view), most = 0;
      // The unit is that of the chosen item, not that of a larger one that is not shown.
      const counts = (k) => !this.items || this.about.items[k] === this.item;
      for (const row of joined)
        for (let k = 1; k < row.length; k++) if (counts(k - 1) && Math.abs(row[k]) > most) most = Math.abs(row[k]);
      const [factor, named] = prefix(unit, most);
      if (factor !== 1) joined = joined.map((row) => row.map((value, k) => (k === 0 || value === null ? value : value * factor)));
      const per = this.flat && /^(N|m³)/.test(unit) ? ' per metre of width' : '';
      const item = this.items ? `${this.item}: ` : ''; // on paper there is no choice
      this.unit.textContent = `${item}${name}, ${named}${per}`;
      if (this.graph) this.graph.destroy();
      // Names of bodies are never given to dygraphs, which would read them as HTML.
      this.graph = new window.Dygraph(this.graphElement, joined, {
        labels: ['t', ...this.about.names.map((_, k) => `s${k}`)], colors: this.about.names.map((_, k) => this.colour(k)),
        visibility: this.visible.slice(), legend: 'never', xlabel: 't, s', strokeWidth: 1.4, gridLineColor: '#e6ebf0',
        axisLineColor: '#c5ced7', axisLabelFontSize: 11, xLabelHeight: 14, connectSeparatedPoints: true,
        axes: { x: { pixelsPerLabel: 60 }, y: { pixelsPerLabel: 30, axisLabelWidth: 54 } }, animatedZooms: false,
        highlightCallback: (event, x, points, row) => this.values(joined[row]),
        unhighlightCallback: () => this.values(null),
      });
      this.values(null);
    }

    values(row) {
      this.outputs.forEach((output, k) => { output.textContent = row ? figure(row[k + 1]) : ''; });
    }
  }

  function start() {
    const plots = [];
    document.querySelectorAll('.plot').forEach((element) => {
      if (window.Dygraph) plots.push(new Plot(element));
      else {
        const graph = element.querySelector('.graph');
        graph.classList.add('none');
        graph.append(make('p', { className: 'missing', textContent: 'No plot: dygraphs (Debian’s package libjs-dygraphs) was not installed where this page was made.' }));
      }
    });
    // A canvas that is drawn anew before printing would be blank on paper, so the drawn one is scaled.
    window.addEventListener('beforeprint', () => plots.forEach(({ graphElement }) => {
      graphElement.style.setProperty('--on-paper', Math.min(1.8, PAPER / graphElement.clientWidth));
    }));
    window.shorebreakReport = { plots };
  }

  // The link is filled when it is clicked, so that a page with many series opens quickly.
  document.querySelectorAll('a.csv').forEach((link) => {
    const [about, rows] = data[link.dataset.table];
    const k = about.names.indexOf(link.dataset.name);
    if (k < 0) return;
    link.download = `${link.dataset.table}-${link.dataset.name}.csv`;
    link.addEventListener('click', () => {
      link.href = URL.createObjectURL(new Blob([`${about.columns.join(',')}\n${rows[k]}`], { type: 'text/csv' }));
    });
  });
  // dygraphs' own legend would read names as HTML.
  if (window.Dygraph)
    window.Dygraph.PLUGINS = window.Dygraph.PLUGINS.filter((plugin) => plugin !== window.Dygraph.Plugins.Legend);
  start();
})();
