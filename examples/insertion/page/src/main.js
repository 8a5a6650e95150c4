// The page of an insertion: puts its parts together and carries what one says to the others.
import 'uplot/dist/uPlot.min.css';
import '../style.css';

import WebGL from 'three/addons/capabilities/WebGL.js';

import {Charts, seriesLabel} from './charts.js';
import {readData} from './data.js';
import {element, number} from './format.js';
import {bindKeys, KEYS} from './keys.js';
import {Player, SPEEDS} from './player.js';
import {Pointing} from './pointing.js';
import {Strip} from './strip.js';
import {fillContactTable, fillSummary, FrameContacts} from './tables.js';
import {onThemeChange} from './theme.js';
import {writeValidation} from './validation.js';
import {View} from './view.js';

const byId = id => document.getElementById(id);
const data = readData();
const {frames, contacts} = data;
const player = new Player(frames);
let selected = -1;
let view = null;
let pointing = null;
let remembering = 0; // a timer

function makeView() {
  if (WebGL.isWebGL2Available()) {
    return new View(byId('view'), data);
  }
  byId('view').classList.add('flat');
  byId('no-webgl').hidden = false;
  return null;
}

function select(contact) {
  selected = contact;
  if (contact >= 0 && frames.frameOfContact(contact) !== player.frame) {
    player.pause();
    player.seek(frames.frameOfContact(contact));
  }
  list.select(contact);
  view?.select(contact);
  pointing?.keep(contact);
  remember();
}

// A frame, camera and contact can be sent to somebody as the address of the page. Browsers limit how often it may change.
function remember() {
  clearTimeout(remembering);
  remembering = setTimeout(() => {
    const camera = view ? `&camera=${view.cameras.mode}` : '';
    history.replaceState(null, '', `#frame=${player.frame}${camera}${selected >= 0 ? `&contact=${selected}` : ''}`);
  }, 400);
}

function recall() {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const index = name => wanted.has(name) ? Number.parseInt(wanted.get(name), 10) : NaN;
  player.seek(index('frame') >= 0 ? index('frame') : player.frame);
  if (['overview', 'follow', 'endoscope'].includes(wanted.get('camera'))) {
    setCamera(wanted.get('camera'));
  }
  if (index('contact') >= 0 && index('contact') < contacts.count) {
    select(index('contact'));
  }
}

function setCamera(mode) {
  if (!view) {
    return;
  }
  view.camera = mode;
  document.querySelectorAll('#cameras button').forEach(button =>
    button.setAttribute('aria-pressed', button.dataset.camera === mode));
  byId('view').classList.toggle('within', mode === 'endoscope');
  placeInset();
  remember();
}

function placeInset() {
  const shown = view.inset && view.cameras.mode !== 'endoscope';
  const {left, top, side} = view.insetPlace();
  const frame = byId('inset-frame');
  frame.hidden = !shown;
  Object.assign(frame.style, {left: `${left}px`, top: `${top}px`, width: `${side}px`, height: `${side}px`});
}

function showFrame() {
  const {frame} = player;
  if (selected >= 0 && frames.frameOfContact(selected) !== frame) {
    select(-1);
  }
  view?.show(frame);
  charts.show(frame);
  list.show(frames.contactsOf(frame), selected);
  byId('slider').value = frame;
  const parts = [
    `${frames.time[frame].toFixed(3)} s`, `step ${number(frames.step[frame])}`, `frame ${frame + 1} of ${frames.count}`,
    `${number(frames.vertexCount(frame))} vertices, ${number(frames.insertedOf(frame).length)} inserted`];
  byId('readout').replaceChildren(...parts.map(part => element('span', {textContent: part})));
  showCounts();
  remember();
}

// The legend counts the contacts of the frame by kind, and hides kinds.
function makeLegend() {
  const swatch = name => element('i', {className: `dot ${name}`});
  byId('legend').append(
      element('span', {}, swatch('catheter'), 'catheter'), element('span', {}, swatch('inserted'), 'inserted'),
      ...contacts.kinds.map((kind, at) => {
        const box = element('input', {type: 'checkbox', checked: true, onchange: () => view?.hide(at, !box.checked)});
        return element('label', {title: `contacts with a ${kind}: shown or hidden`}, box, swatch(`kind-${at}`), `${kind} `,
            element('output', {className: 'count'}));
      }));
}

function showCounts() {
  const counts = contacts.kinds.map(() => 0);
  const {begin, end} = frames.contactsOf(player.frame);
  for (let contact = begin; contact < end; ++contact) {
    ++counts[contacts.kind[contact]];
  }
  document.querySelectorAll('#legend .count').forEach((output, kind) => {
    output.textContent = counts[kind];
  });
}

function makeTransport() {
  byId('slider').max = frames.count - 1;
  byId('slider').addEventListener('input', () => {
    player.pause();
    player.seek(Number(byId('slider').value));
  });
  byId('speed').append(...SPEEDS.map(speed =>
    element('option', {
      value: speed, textContent: speed === 1 ? 'real time' : `${speed} × real time`, selected: speed === player.speed,
    })));
  byId('speed').addEventListener('change', () => {
    player.speed = Number(byId('speed').value);
  });
  player.addEventListener('frame', showFrame);
  player.addEventListener('playing', () => {
    byId('play').classList.toggle('playing', player.playing);
    byId('play').setAttribute('aria-label', player.playing ? 'Pause' : 'Play');
    remember();
  });
}

function makeSettings() {
  if (!view) {
    return;
  }
  const bind = (id, property, set) => byId(id).addEventListener('input', () => {
    set(byId(id)[property]);
    view.draw();
  });
  bind('opacity', 'valueAsNumber', value => { view.wall.opacity.value = value; });
  bind('thickness', 'valueAsNumber', value => { view.thickness = value; });
  bind('trail', 'checked', shown => { view.trail.mesh.visible = shown; });
  bind('vertices', 'checked', shown => { view.vertices.mesh.visible = shown; });
  bind('triangles', 'checked', shown => { view.edges = shown; });
  bind('inset', 'checked', shown => { view.inset = shown; placeInset(); });
  new ResizeObserver(() => {
    view.resize();
    placeInset();
  }).observe(byId('view'));
  byId('inset').checked = view.inset = byId('view').clientWidth > 500;
  byId('settings').open = byId('view').clientWidth > 700;
}

const hasContacts = frame => frames.contactCount(frame) > 0;
const actions = {
  play: () => player.toggle(),
  previous: (steps = 1) => { player.pause(); player.seek(player.frame - steps); },
  next: (steps = 1) => { player.pause(); player.seek(player.frame + steps); },
  first: () => player.seek(0),
  last: () => player.seek(frames.count - 1),
  'previous-contact': () => player.find(-1, hasContacts),
  'next-contact': () => player.find(1, hasContacts),
  'inset-frame': () => setCamera('endoscope'),
  overview: () => setCamera('overview'),
  follow: () => setCamera('follow'),
  endoscope: () => setCamera('endoscope'),
  reset: () => { setCamera('overview'); view?.cameras.reset(); },
  deselect: () => select(-1),
};

const about = data.environment;
byId('title').textContent = data.title;
byId('about').textContent = [
  about.source, `${number(about.volumes)} volumes, ${number(about.passable)} of them passable`, `${number(about.points)} points`,
  `steps of ${number(data.dt * 1000)} ms`].filter(Boolean).join(' · ');
writeValidation(byId('validation'), data, frame => player.seek(frame));
fillContactTable(byId('contact-table'), data.contact_table);
fillSummary(byId('summary'), data.summary);
byId('series').append(...Object.entries(data.series_about).map(([name, about]) =>
  element('tr', {}, element('td', {textContent: seriesLabel(name)}), element('td', {textContent: about}))));
byId('keys').append(...KEYS.map(([keys, what]) =>
  element('div', {}, element('dt', {textContent: keys}), element('dd', {textContent: what}))));

view = makeView();
const charts = new Charts(byId('charts'), data, time => { player.pause(); player.seekTime(time); });
const list = new FrameContacts(byId('frame-contacts'), byId('frame-contacts-about'), contacts, select);
const strip = new Strip(byId('strip'), data);
pointing = view && new Pointing(view, byId('tip'), contacts, select);
makeLegend();
makeTransport();
makeSettings();
for (const id of ['play', 'previous', 'next', 'previous-contact', 'next-contact', 'inset-frame', 'reset']) {
  byId(id).addEventListener('click', () => actions[id]());
}
document.querySelectorAll('#cameras button').forEach(button =>
  button.addEventListener('click', () => setCamera(button.dataset.camera)));
bindKeys(actions);
onThemeChange(() => {
  view?.paint();
  charts.paint();
  strip.paint();
});
setCamera('overview');
recall();
showFrame();
addEventListener('hashchange', recall);

// What tests ask and do.
window.insertion = {
  seek: frame => player.seek(frame),
  select,
  draw: () => view?.drawNow(),
  place: contact => view?.place(contact) ?? null,
  state: () => ({
    frame: player.frame,
    time: frames.time[player.frame],
    playing: player.playing,
    vertices: frames.vertexCount(player.frame),
    contacts: frames.contactCount(player.frame),
    tip: Array.from(frames.line(player.frame).slice(-3), (value, axis) => value + data.origin[axis]),
    selected,
    camera: view?.cameras.mode ?? null,
  }),
};
