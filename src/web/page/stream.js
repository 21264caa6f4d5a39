// What the run sends: frames per second, one particle in so many, the particles of a region. The fields show the limits
// of the run, until one is edited.
const element = (id) => document.getElementById(id);
const short = (value) => String(Number(value.toPrecision(7)));

export class StreamLimits {
  constructor(controls) {
    this.controls = controls;
    this.region = ['x', 'y', 'z'].map((axis) => {
      const fields = ['from', 'to'].map((end) => {
        const made = document.createElement('input');
        made.id = `region-${axis}-${end}`;
        made.type = 'number';
        made.step = 'any';
        made.required = true;
        made.setAttribute('aria-label', `${axis} ${end}, m`);
        return made;
      });
      element('region').append(`${axis} from`, fields[0], 'to', fields[1]);
      return fields;
    });
    const number = (field) => Number(field.value);
    this.forms = [
      this.form('rate', 'Frames per second', (s) => [s.rate], [element('rate')],
        () => ({ do: 'rate', rate: number(element('rate')) })),
      this.form('decimation', 'One particle in', (s) => [s.decimation], [element('decimation')],
        () => ({ do: 'decimation', decimation: number(element('decimation')) })),
      this.form('region', 'Region', (s) => [...s.region_min, ...s.region_max],
        [0, 1].flatMap((end) => this.region.map((fields) => fields[end])),
        () => ({ do: 'region', min: this.region.map(([from]) => number(from)), max: this.region.map(([, to]) => number(to)) })),
    ];
    element('stream-whole').addEventListener('click', () => this.send(this.forms[2], { do: 'region', off: true }));
  }

  // values: of the fields, in the status.
  form(name, label, values, fields, words) {
    const place = element(`stream-${name}`);
    const form = { label, values, fields, edited: false, buttons: [...place.querySelectorAll('button')] };
    place.addEventListener('input', () => { form.edited = true; });
    place.addEventListener('submit', (event) => {
      event.preventDefault();
      if (this.controls.reason() === '') this.send(form, words());
    });
    return form;
  }

  send(form, words) {
    this.controls.send(form.label, words, (reply) => { form.edited = form.edited && reply.refused; });
  }

  setStatus(status) {
    const reason = this.controls.reason();
    for (const form of this.forms) {
      for (const button of form.buttons) {
        button.disabled = reason !== '';
        button.title = reason;
      }
      const values = form.values(status);
      if (!form.edited && !form.fields.includes(document.activeElement))
        form.fields.forEach((field, k) => { field.value = short(values[k]); });
    }
  }
}
