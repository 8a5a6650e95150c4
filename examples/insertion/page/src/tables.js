// The tables below: contacts of the frame, contacts by kind and feature, figures.
import {cell, element, number, vector} from './format.js';

const COLUMNS = {
  kind: 'What of the wall was met: the inside of a face (plane), an edge or a vertex',
  vertex: 'Index into the catheter\'s line at this frame, from the tail; – for none',
  time: 'Share of the vertex\'s move up to the contact, 0 to 1',
  tag: 'Of the cell behind the wall',
  impulse: 'That the wall gave the catheter',
  normal: 'Of the contact, away from the wall',
  point: 'Where the contact is',
};
const MOST = 400; // rows of one frame

function head(columns, firstRow = []) {
  return element('thead', {}, element('tr', {}, ...columns.map((column, at) =>
    element('th', {textContent: column, className: typeof firstRow[at] === 'number' ? 'number' : ''}))));
}

function row(values, exact = values) {
  return element('tr', {}, ...values.map((value, at) => element('td', {
    textContent: cell(value),
    title: typeof exact[at] === 'number' && !Number.isInteger(exact[at]) ? String(exact[at]) : '',
    className: typeof value === 'number' || value === null ? 'number' : '',
  })));
}

export function fillContactTable(table, {columns, rows}) {
  table.replaceChildren(head(columns, rows[0]), element('tbody', {}, ...rows.map(values => row(values))));
}

export function fillSummary(table, summary) {
  table.replaceChildren(element('tbody', {}, ...Object.entries(summary).map(([name, value]) => {
    const line = row([name, value]);
    // Long names may be broken after a dot or an underscore.
    line.firstChild.replaceChildren(...name.split(/(?<=[._])/).flatMap(part => [part, element('wbr')]));
    return line;
  })));
}

/** How a contact is told: name and text of each figure, with enough digits to find it in the input. */
export function describe(contact, digits = 4) {
  return {
    kind: contact.kind,
    vertex: contact.vertex < 0 ? '–' : String(contact.vertex),
    time: number(contact.time, digits),
    tag: String(contact.tag),
    impulse: number(contact.impulse, digits),
    normal: vector(contact.normal, digits),
    point: vector(contact.point, digits),
  };
}

/** The contacts of one frame; `select` is called with the number of a contact. */
export class FrameContacts {
  #body = element('tbody');
  #begin = 0;

  constructor(table, about, contacts, select) {
    this.about = about;
    this.contacts = contacts;
    table.append(head(Object.keys(COLUMNS)), this.#body);
    table.querySelectorAll('th').forEach(heading => { heading.title = COLUMNS[heading.textContent]; });
    this.#body.addEventListener('click', event => {
      const line = event.target.closest('tr');
      if (line?.dataset.contact) {
        select(Number(line.dataset.contact));
      }
    });
  }

  show({begin, end}, selected) {
    this.#begin = begin;
    this.about.textContent = end === begin ? 'none at this frame' : `${number(end - begin)} at this frame`;
    const lines = [];
    for (let contact = begin; contact < Math.min(end, begin + MOST); ++contact) {
      const told = describe(this.contacts.get(contact));
      const line = element('tr', {}, ...Object.values(told).map(text => element('td', {textContent: text})));
      line.firstChild.prepend(element('i', {className: `dot kind-${this.contacts.kind[contact]}`}));
      line.dataset.contact = contact;
      lines.push(line);
    }
    if (end - begin > MOST) {
      lines.push(element('tr', {}, element('td', {
        colSpan: Object.keys(COLUMNS).length, textContent: `and ${number(end - begin - MOST)} more`,
      })));
    }
    this.#body.replaceChildren(...lines);
    this.select(selected);
  }

  select(selected) {
    [...this.#body.children].forEach((line, at) => line.classList.toggle('selected', this.#begin + at === selected));
  }
}
