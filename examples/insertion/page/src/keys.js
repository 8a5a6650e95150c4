// The keyboard.

export const KEYS = [
  ['space', 'play or pause'],
  ['← →', 'one frame; with shift ten'],
  ['home end', 'first, last frame'],
  ['p n', 'last, next frame with contacts'],
  ['1 2 3', 'overview, follow the tip, endoscope'],
  ['0', 'first view'],
  ['esc', 'no contact selected'],
  ['charts', 'a click goes there, a drag zooms, a double click shows all'],
  ['contacts', 'a click selects; the address of the page keeps frame, camera and contact'],
];

const PLAIN = {
  ' ': 'play', Home: 'first', End: 'last', p: 'previous-contact', n: 'next-contact', 1: 'overview', 2: 'follow', 3: 'endoscope',
  0: 'reset', Escape: 'deselect',
};
const STEPS = {ArrowLeft: 'previous', ArrowRight: 'next'};

/** Keys call `actions`, but for those that a field with the focus needs itself. */
export function bindKeys(actions) {
  addEventListener('keydown', event => {
    const field = event.target.closest?.('input:not(#slider), select');
    if (event.ctrlKey || event.metaKey || event.altKey || field) {
      return;
    }
    if (STEPS[event.key]) {
      actions[STEPS[event.key]](event.shiftKey ? 10 : 1);
    } else if (PLAIN[event.key] && !(event.key === ' ' && event.target.closest?.('button, summary'))) {
      actions[PLAIN[event.key]]();
    } else {
      return;
    }
    event.preventDefault();
  });
}
