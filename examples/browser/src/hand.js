// The hand on the wire: keys, buttons that are held, and a drag of the grip say how fast it is pushed and turned.
const PUSH = 0.3; // scene's links a step; keys and buttons
const TURN = 0.06; // radians a step
const KEYS = {
  ArrowUp: 'push', w: 'push', ArrowDown: 'pull', s: 'pull', ArrowLeft: 'left', a: 'left', ArrowRight: 'right', d: 'right',
};

export class Hand {
  #held = new Map(); // what holds it: 'push', 'pull', 'left', 'right'
  #dragged = {push: 0, turn: 0}; // asked for, not yet made

  constructor(pad) {
    const nameOf = ({key}) => key.length === 1 ? key.toLowerCase() : key; // Shift may come and go while a key is held
    addEventListener('keydown', event => {
      const wish = KEYS[nameOf(event)];
      if (wish && !event.ctrlKey && !event.metaKey && !event.altKey) {
        this.#held.set(nameOf(event), wish);
        event.preventDefault();
      }
    });
    addEventListener('keyup', event => this.#held.delete(nameOf(event)));
    addEventListener('blur', () => this.#held.clear());
    for (const button of pad.querySelectorAll('[data-hand]')) {
      const release = event => this.#held.delete(event.pointerId);
      button.addEventListener('pointerdown', event => {
        button.setPointerCapture(event.pointerId);
        this.#held.set(event.pointerId, button.dataset.hand);
      });
      button.addEventListener('lostpointercapture', release);
      button.addEventListener('contextmenu', event => event.preventDefault());
    }
  }

  /** A drag of the grip, in links and radians. */
  drag(push, turn) {
    this.#dragged.push += push;
    this.#dragged.turn += turn;
  }

  /** What is left of a drag is not made. */
  release() {
    this.#dragged = {push: 0, turn: 0};
  }

  get holds() {
    return new Set(this.#held.values());
  }

  /** What the next `steps` steps do each: links pushed, radians turned. */
  take(steps) {
    const holds = this.holds;
    const sign = (forth, back) => holds.has(forth) - holds.has(back);
    const share = (wanted, most) => Math.max(-most, Math.min(most, wanted / steps));
    const drag = {push: share(this.#dragged.push, PUSH), turn: share(this.#dragged.turn, 2 * TURN)};
    this.#dragged.push -= drag.push * steps;
    this.#dragged.turn -= drag.turn * steps;
    return {push: PUSH * sign('push', 'pull') + drag.push, turn: TURN * sign('right', 'left') + drag.turn};
  }
}
