// The sentence that says whether the catheter was free at every step.
import {element, number} from './format.js';

/** Writes the sentence; a click on a failure calls `seek` with its first frame. */
export function writeValidation(host, {summary, series}, seek) {
  const steps = summary['demo.steps'];
  const free = summary['demo.exactly_free_steps'];
  const wrong = (series.verified ?? []).indexOf(0);
  const good = steps === free && steps > 0 && wrong < 0;
  host.title = 'Exactly: as real numbers, not up to a tolerance, no edge of the catheter meets the wall.';
  host.className = good ? 'good' : 'bad';
  if (steps === undefined || free === undefined) {
    host.textContent = 'Not verified: the input has no figures of it.';
  } else {
    host.textContent = good ? `✓ Exactly free at every step: ${number(free)} of ${number(steps)}` :
      `✗ Exactly free at ${number(free)} of ${number(steps)} steps only`;
  }
  if (wrong >= 0) {
    host.append(' ', element('button', {textContent: 'go to the first', onclick: () => seek(wrong)}));
  }
}
