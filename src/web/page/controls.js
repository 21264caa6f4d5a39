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
    this.buttons = BUTTONS.map((button) => {
      const made = document.createElement('button');
      made.type = 'button';
      made.id = `command-${button.name}`;
      made.textContent = button.label;
      made.disabled = true;
      made.addEventListener('click', () => this.press(button, made, eye));
      return made;
    });
    element('commands').append(...this.buttons);
    element('login').addEventListener('submit', (event) => {
      event.preventDefault();
      this.refused = false;
      setToken(element('token').value.trim());
      element('token').value = '';
      this.show();
      this.changed();
    });
  }

  // A button that ends the run is pressed twice.
  press(button, made, eye) {
    if (button.sure && !made.classList.contains('sure')) {
      made.classList.add('sure');
      made.textContent = `${button.label}?`;
      setTimeout(() => this.calm(button, made), 1e3 * SURE_SECONDS);
      return;
    }
    this.calm(button, made);
    this.send(button.label, button.words ? button.words() : { do: 'picture', ...eye() });
  }

  calm(button, made) {
    made.classList.remove('sure');
    made.textContent = button.label;
  }

  async send(label, words) {
    this.say(`${label}: sent`);
    try {
      const { id } = await command(words);
      this.expected = { id, label };
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
    this.status = status;
    const reply = this.expected && (status.replies || []).find(({ id }) => id === this.expected.id);
    if (reply) {
      this.message = `${this.expected.label}: ${reply.refused ? 'refused: ' : ''}${reply.text || 'done'}`;
      this.expected = null;
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
    BUTTONS.forEach((button, k) => {
      this.buttons[k].disabled = reason !== '' || !button.when(status);
      this.buttons[k].title = reason;
    });
    element('why').textContent = reason || this.message;
    const useful = this.refused || (status && status.commands && status.state !== 'done');
    element('login').hidden = hasToken() || !useful;
  }
}
