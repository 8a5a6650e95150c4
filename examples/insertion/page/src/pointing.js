// Contacts under the pointer: their figures beside it, and a click keeps one.
import {element} from './format.js';
import {describe} from './tables.js';

const STILL = 5; // a press that moves less is a click, CSS pixels

export class Pointing {
  #pressed = null;

  /** `select` is called with the number of a contact that was clicked, -1 for none. */
  constructor(view, tip, contacts, select) {
    this.tip = tip;
    this.contacts = contacts;
    this.view = view;
    this.selected = -1;
    view.canvas.addEventListener('pointermove', event => {
      if (event.buttons === 0) {
        this.#hover(view.pick(event.offsetX, event.offsetY), event);
      }
    });
    view.canvas.addEventListener('pointerleave', () => this.#hover(-1));
    view.canvas.addEventListener('pointerdown', event => {
      this.#pressed = [event.clientX, event.clientY];
    });
    view.canvas.addEventListener('pointerup', event => {
      const [x, y] = this.#pressed ?? [Infinity, Infinity];
      if (Math.hypot(event.clientX - x, event.clientY - y) < STILL) {
        select(view.pick(event.offsetX, event.offsetY));
      }
    });
  }

  #hover(contact, event) {
    this.view.canvas.style.cursor = contact >= 0 ? 'pointer' : '';
    if (contact >= 0) {
      this.#tell(contact, event.offsetX, event.offsetY);
    } else {
      this.keep(this.selected);
    }
  }

  /** Shows the figures of a contact that was selected in the corner, nothing for -1. */
  keep(contact) {
    this.selected = contact;
    this.tip.hidden = contact < 0;
    if (contact >= 0) {
      this.#tell(contact);
    }
  }

  #tell(contact, x, y) {
    const told = describe(this.contacts.get(contact), 6);
    this.tip.replaceChildren(...Object.entries(told).map(([name, text]) =>
      element('div', {}, element('b', {textContent: name}), element('span', {textContent: text}))));
    if (x === undefined) {
      this.tip.append(element('button', {textContent: 'go there', onclick: () => this.view.visit(contact)}),
          element('button', {textContent: 'copy', title: 'All digits, as JSON', onclick: () => this.#copy(contact)}));
    }
    this.tip.hidden = false;
    this.tip.classList.toggle('kept', x === undefined);
    const {clientWidth, clientHeight} = this.tip.parentElement;
    this.tip.style.left = x === undefined ? '' : `${Math.min(x + 14, clientWidth - this.tip.offsetWidth - 8)}px`;
    this.tip.style.top = x === undefined ? '' : `${Math.min(y + 14, clientHeight - this.tip.offsetHeight - 8)}px`;
  }

  #copy(contact) {
    navigator.clipboard?.writeText(JSON.stringify(this.contacts.get(contact)));
  }
}
