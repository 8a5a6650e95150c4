// The page: asks the worker for a step, shows the last one, and carries what the visitor wants from one to the other.
import '../style.css';

import WebGL from 'three/addons/capabilities/WebGL.js';

import {number} from '../../insertion/page/src/format.js';
import {colour} from '../../insertion/page/src/theme.js';
import {readFile} from './files.js';
import {Hand} from './hand.js';
import {Simulation} from './simulation.js';
import {View} from './view.js';

const STEP = 1000 / 60; // ms of the clock for a step
const CONTACT = 9; // doubles of a scene_contact

const byId = id => document.getElementById(id);
const simulation = new Simulation(JSON.parse(byId('data').textContent));
const hand = new Hand(byId('pad'));
const view = WebGL.isWebGL2Available() ? new View(byId('view')) : null;
const session = {
  running: false, beat: false, cut: false, angle: 0, link: 1, steps: 0, log: [], last: null, milliseconds: [], frames: [],
};
let beginning = 0; // scenes asked for and not there yet
let asked = false; // the worker has not answered yet
let before = 0; // time of the last step
let shownFigures = 0;
let hideMessage = 0; // a timer

function say(text, bad = false) {
  clearTimeout(hideMessage);
  byId('message').textContent = text;
  byId('message').hidden = false;
  byId('message').classList.toggle('bad', bad);
  hideMessage = setTimeout(() => { byId('message').hidden = true; }, bad ? 12000 : 6000);
}

/** Asks for another scene. The old one stays if that fails. */
async function begin(what, question = {}, done = '', name = '') {
  ++beginning;
  session.running = false;
  hand.release();
  try {
    const scene = await simulation.ask(what, question);
    Object.assign(session, {cut: false, angle: 0, link: scene.size.link, steps: 0, log: [], last: scene, milliseconds: []});
    setBeat(false);
    byId('volumes').textContent = number(scene.size.volumes);
    view?.begin(scene);
    view?.show(scene, 0);
    session.running = beginning === 1;
    if (done) {
      say(done);
    }
    return true;
  } catch (error) {
    session.running = beginning === 1 && session.last !== null;
    say(name ? `${name}: ${error.message}` : error.message, true);
    return false;
  } finally {
    --beginning;
  }
}

async function openFile(file) {
  try {
    const {what, closed, left, question} = await readFile(file);
    const openings = closed === 0 ? '' : ` ${closed === 1 ? 'Its opening was' : `Its ${closed} openings were`} closed.`;
    const beside = left === 0 ? '' : ` ${left} points, lines and polygons beside its cells, and all names, were left out.`;
    await begin(what, question, `${file.name}: the wire is in the ${what === 'surface' ? 'surface' : 'mesh'}.${openings}${beside}`, file.name);
  } catch (error) {
    say(error.message, true);
  }
}

function setBeat(on) {
  session.beat = on;
  byId('beat').setAttribute('aria-pressed', on);
}

async function step(now) {
  const steps = Math.max(1, Math.min(3, Math.round((now - before) / STEP)));
  const {push, turn} = hand.take(steps);
  const wish = {steps, push: push * session.link, turn, beat: session.beat, cut: session.cut};
  before = now;
  session.cut = false;
  asked = true;
  try {
    const answer = await simulation.ask('step', wish);
    session.log.push(wish);
    session.steps += steps;
    session.angle += turn * steps;
    session.last = answer;
    session.milliseconds.push(answer.milliseconds);
    if (session.milliseconds.length > 132) {
      session.milliseconds.shift();
    }
    if (answer.cut !== null) {
      say(answer.cut === '' ? 'The wall is open beside the tip.' : `No cut: ${answer.cut}.`, answer.cut !== '');
    }
    view?.show(answer, session.angle);
  } catch (error) {
    session.running = false;
    say(`The scene has stopped: ${error.message}. Press Restart.`, true);
  }
  asked = false;
}

function showFigures(now) {
  const {milliseconds, last, frames} = session;
  const mean = milliseconds.slice(-60).reduce((sum, time) => sum + time, 0) / Math.max(1, Math.min(60, milliseconds.length));
  byId('contacts').textContent = last.contacts.length / CONTACT;
  byId('step').textContent = milliseconds.length === 0 ? '–' : mean.toFixed(2);
  byId('frames').textContent = Math.round(1000 * (frames.length - 1) / Math.max(1, frames.at(-1) - frames[0]));
  byId('wire').textContent = `${last.wire.length / 3} vertices`;
  shownFigures = now;

  const canvas = byId('strip');
  const context = canvas.getContext('2d');
  const most = Math.max(1.5, ...milliseconds);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = colour('--accent');
  milliseconds.forEach((time, at) => {
    const height = time / most * canvas.height;
    context.fillRect(2 * at, canvas.height - height, 1.6, height);
  });
  context.fillStyle = '#ffffff40';
  context.fillRect(0, canvas.height * (1 - 1 / most), canvas.width, 1);
}

function frame(now) {
  requestAnimationFrame(frame);
  if (!session.last) {
    return;
  }
  if (session.running && !asked && now - before > 0.6 * STEP) {
    step(now);
  }
  view?.adapt(now - (session.frames.at(-1) ?? now));
  session.frames.push(now);
  if (session.frames.length > 61) {
    session.frames.shift();
  }
  view?.draw();
  const holds = hand.holds;
  document.querySelectorAll('[data-hand]').forEach(button => button.classList.toggle('held', holds.has(button.dataset.hand)));
  if (now - shownFigures > 200) {
    showFigures(now);
  }
}

const actions = {
  beat: () => setBeat(!session.beat),
  cut: () => { session.cut = true; },
  follow: () => {
    const on = byId('follow').getAttribute('aria-pressed') !== 'true';
    byId('follow').setAttribute('aria-pressed', on);
    if (view) {
      view.follow = on;
    }
  },
  restart: () => begin('vessel'),
};

function bind() {
  for (const [id, action] of Object.entries(actions)) {
    byId(id).addEventListener('click', action);
  }
  const keys = {b: 'beat', c: 'cut', f: 'follow', r: 'restart'};
  addEventListener('keydown', event => {
    if (keys[event.key] && !event.repeat && !event.ctrlKey && !event.metaKey && !event.altKey) {
      actions[keys[event.key]]();
    }
  });
  byId('file').addEventListener('change', () => {
    const [file] = byId('file').files;
    byId('file').value = '';
    return file && openFile(file);
  });
  addEventListener('dragover', event => {
    event.preventDefault();
    byId('drop').hidden = false;
  });
  addEventListener('dragleave', event => { byId('drop').hidden = event.relatedTarget === null; });
  addEventListener('drop', event => {
    event.preventDefault();
    byId('drop').hidden = true;
    const [file] = event.dataTransfer.files;
    return file && openFile(file);
  });
}

/** The grip is dragged along the wire to push and pull, and across it to turn; elsewhere a drag turns the view. */
function bindGrip() {
  const host = byId('view');
  let last = null;
  const place = event => {
    const box = host.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  };
  host.addEventListener('pointerdown', event => {
    const at = place(event);
    if (event.button === 0 && view.isGrip(at.x, at.y)) {
      last = at;
      host.setPointerCapture(event.pointerId);
      host.classList.add('gripping');
      event.stopPropagation();
    }
  }, true);
  host.addEventListener('pointermove', event => {
    const at = place(event);
    host.classList.toggle('grip', view.isGrip(at.x, at.y));
    if (last) {
      const {push, turn} = view.asHand(at.x - last.x, at.y - last.y);
      hand.drag(push / session.link, turn);
      last = at;
      event.stopPropagation();
    }
  }, true);
  host.addEventListener('lostpointercapture', () => {
    last = null;
    hand.release();
    host.classList.remove('gripping');
  });
}

bind();
if (view) {
  bindGrip();
} else {
  byId('view').classList.add('flat');
}
requestAnimationFrame(frame);
simulation.started.then(async ({version}) => {
  byId('version').textContent = version;
  if (await begin('vessel')) {
    say('Hold Push, or drag the blue grip. Arrow keys push, pull and turn.');
  }
}, error => say(`The library cannot run in this browser: ${error.message}`, true));

// What tests ask and do.
window.browser = {
  begin,
  ask: (what, question) => simulation.ask(what, question),
  grip: () => view?.gripPlace,
  state: () => ({
    running: session.running,
    steps: session.steps,
    log: session.log,
    vertices: session.last ? session.last.wire.length / 3 : 0,
    tip: session.last ? Array.from(session.last.wire.slice(0, 3)) : null,
    contacts: session.last ? session.last.contacts.length / CONTACT : 0,
    milliseconds: session.milliseconds,
    message: byId('message').hidden ? '' : byId('message').textContent,
  }),
  pause: () => { session.running = false; },
  drawSharp: sharp => { view.sharp = sharp; },
};
