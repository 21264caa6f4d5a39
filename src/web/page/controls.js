// The buttons that steer the run. They say why they cannot be used.
import { command, hasToken, setToken } from './api.js';

const element = (id) => document.getElementById(id);

const BUTTONS = [
  { name: 'pause', label: 'Pause', words: () => ({ do: 'pause' }), when: (s) => s.state === 'running' },
  { name: 'resume', label: 'Resume', words: () => ({ do: 'resume' }), when: (s) => s.state === 'paused' },
  { name: 'step', label: 'Step', words: () => ({ do: 'step', steps: 1 }), when: (s) => s.state !== 'done' },
  { name: 'checkpoint', label: 'Checkpoint', words: () => ({ do: 'checkpoint' }), when: (s) => s.state !== 'done' },
  { name: 'picture', label: 'Picture', words: null, when: (s) => s.state !== 'done' },
  { name: 'stop', label: 'Stop', words: () => ({ do: 'stop' }), when: (s) => s.state !== 'done', sure: true },
];
const SURE_SECONDS = 4;

export class Controls {
  // eye: returns {eye, target}, in metres, of the picture on the page.
  constructor(eye, changed) {
    this.status = null;
    this.changed = changed;
    this.refused = false; // the server did not accept the token
    this.message = '';
    this.expected = new Map(); // what is waited for, by the id of the command
    this.buttons = BUTTONS.map((button) => this.make({
      ...button, id: `command-${button.name}`, words: button.words || (() => ({ do: 'picture', ...eye() })),
    }));
    this.starts = []; // of wave makers
    element('commands').append(...this.buttons.map(({ made }) => made));
    element('login').addEventListener('submit', (event) => {
      event.preventDefault();
      this.refused = false;
      setToken(element('token').value.trim());
      element('token').value = '';
      this.show();
      this.changed();
    });
  }

  make(button) {
    const made = document.createElement('button');
    made.type = 'button';
    made.id = button.id;
    made.textContent = button.label;
    made.disabled = true;
    button.made = made;
    made.addEventListener('click', () => this.press(button));
    return button;
  }

  // Each wave maker that waits for a command has a button. It is of no use once the run has obeyed.
  setScene(scene) {
    this.starts = scene.wavemakers.map((name, k) => {
      const button = {
        id: `start-${k}`, label: `Start ${name}`, sure: true, started: false,
        words: () => ({ do: 'trigger', wavemaker: name }),
        when: () => !button.started,
        replied: (reply) => { button.started = button.started || !reply.refused; },
      };
      return this.make(button);
    });
    element('starts').replaceChildren(...this.starts.map(({ made }) => made));
    this.show();
  }

  // A button that ends the run or starts a wave is pressed twice.
  press(button) {
    const { made } = button;
    if (button.sure && !made.classList.contains('sure')) {
      made.classList.add('sure');
      made.textContent = `${button.label}?`;
      setTimeout(() => this.calm(button), 1e3 * SURE_SECONDS);
      return;
    }
    this.calm(button);
    this.send(button.label, button.words(), button.replied);
  }

  calm({ made, label }) {
    made.classList.remove('sure');
    made.textContent = label;
  }

  // replied: called with the reply of the run.
  async send(label, words, replied = () => {}) {
    this.say(`${label}: sent`);
    try {
      const { id } = await command(words);
      this.expected.set(id, { label, replied });
    } catch (problem) {
      this.say(`${label}: ${problem.message}`);
      if (problem.status === 401) this.needToken();
    }
    this.changed();
  }

  say(message) {
    this.message = message;
    this.show();
  }

  needToken() {
    this.refused = true;
    setToken('');
    this.show();
  }

  setStatus(status) {
    if (this.status && this.status.run_id !== status.run_id) this.expected.clear();
    this.status = status;
    for (const reply of status.replies || []) {
      const expected = this.expected.get(reply.id);
      if (!expected) continue;
      this.message = `${expected.label}: ${reply.refused ? 'refused: ' : ''}${reply.text || 'done'}`;
      this.expected.delete(reply.id);
      expected.replied(reply);
    }
    this.show();
  }

  reason() {
    const { status } = this;
    if (this.refused) return 'The server did not accept the token. It is in the file control.token of the run folder.';
    if (!status) return 'No run to steer yet.';
    if (!status.commands)
      return 'This run takes no commands: start it with --control, or with control.enabled in the scene.';
    if (status.state === 'done') return 'The run has ended.';
    if (!hasToken()) return 'To steer the run, enter its token. It is in the file control.token of the run folder.';
    return '';
  }

  show() {
    const reason = this.reason(), { status } = this;
    for (const button of [...this.buttons, ...this.starts]) {
      button.made.disabled = reason !== '' || !button.when(status);
      button.made.title = reason || (button.started ? 'It has been started.' : '');
    }
    element('why').textContent = reason || this.message;
    const useful = this.refused || (status && status.commands && status.state !== 'done');
    element('login').hidden = hasToken() || !useful;
  }
}
