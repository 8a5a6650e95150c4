// The page in a browser without a screen and without a network: node --test, with SAMPLE (insertion.json), PAGE (its page),
// PICTURES (a folder for screenshots), CHROMIUM and PYTHON in the environment. Playwright is looked for in NODE_PATH.
const assert = require('node:assert/strict');
const {spawnSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {after, before, describe, test} = require('node:test');
const {pathToFileURL} = require('node:url');
const {chromium} = require('playwright-core');

const sample = JSON.parse(fs.readFileSync(process.env.SAMPLE, 'utf8').replaceAll('NaN', 'null'));
const pageAddress = pathToFileURL(process.env.PAGE).href;
const last = sample.frames.length - 1;

const launch = args => chromium.launch({executablePath: process.env.CHROMIUM, args});

/** Opens the page; what it asks for or complains about ends up in `wrong`. */
async function open(browser, {hash = '', address = pageAddress, ...options} = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, offline: true, ...options});
  const page = await context.newPage();
  const wrong = [];
  page.on('console', message => ['error', 'warning'].includes(message.type()) && wrong.push(message.text()));
  page.on('pageerror', error => wrong.push(error.stack));
  page.on('request', request => /^(file|data):/.test(request.url()) || wrong.push(request.url()));
  await page.goto(address + hash);
  await page.waitForFunction(() => window.insertion);
  return {page, wrong};
}

const state = page => page.evaluate(() => window.insertion.state());
const picture = (page, name) =>
  page.screenshot({path: path.join(process.env.PICTURES, name), fullPage: name.includes('whole')});

/** Mean and variance of the brightness of a canvas, and a sum that tells two pictures apart. */
const pixels = (page, selector) => page.evaluate(selector => {
  window.insertion.draw();
  const canvas = document.querySelector(selector);
  const copy = Object.assign(document.createElement('canvas'), {width: canvas.width, height: canvas.height});
  const context = copy.getContext('2d');
  context.drawImage(canvas, 0, 0);
  const {data} = context.getImageData(0, 0, copy.width, copy.height);
  let sum = 0, squares = 0, print = 0;
  for (let at = 0; at < data.length; at += 4) {
    const light = (data[at] + data[at + 1] + data[at + 2]) / 3 * data[at + 3] / 255;
    sum += light;
    squares += light * light;
    print = (print * 31 + data[at] + 7 * data[at + 1] + 13 * data[at + 2]) % 2147483647;
  }
  const count = data.length / 4;
  return {mean: sum / count, variance: squares / count - (sum / count) ** 2, print};
}, selector);

const cells = (page, selector) => page.$$eval(`${selector} tbody tr`, rows =>
  rows.map(row => [...row.cells].map(cell => cell.textContent.trim())));

const near = (text, value) => value === null ? text === '–' :
  Math.abs(Number(text.replaceAll(',', '')) - value) <= 1e-3 * Math.abs(value);

const spoilt = path.join(process.env.PICTURES, 'spoilt.json');
const changed = change => JSON.stringify({...sample, ...change});

/** Makes the page spoilt.json.html of a text. */
function build(insertion) {
  fs.writeFileSync(spoilt, insertion);
  const script = path.join(__dirname, '..', '..', 'build_page.py');
  return spawnSync(process.env.PYTHON, [script, spoilt, `${spoilt}.html`, '--build', process.env.PICTURES], {encoding: 'utf8'});
}

describe('with WebGL', () => {
  let browser, page, wrong;
  before(async () => {
    browser = await launch(['--use-angle=swiftshader', '--enable-unsafe-swiftshader']);
    ({page, wrong} = await open(browser));
  });
  after(() => browser.close());

  test('any title is shown as it is', async () => {
    assert.equal(await page.title(), sample.title);
    assert.equal(await page.textContent('h1'), sample.title);
    assert.match(await page.textContent('#validation'), /Exactly free at every step: 600 of 600/);
    assert.equal(await page.getAttribute('#validation', 'class'), 'good');
  });

  test('the slider moves the catheter', async () => {
    const seen = new Set();
    for (const frame of [0, 12, last]) {
      await page.fill('#slider', String(frame));
      const now = await state(page);
      const {positions, contacts} = sample.frames[frame];
      assert.equal(now.frame, frame);
      assert.equal(now.vertices, positions.length / 3);
      assert.equal(now.contacts, contacts.length);
      positions.slice(-3).forEach((value, axis) => assert.ok(Math.abs(now.tip[axis] - value) < 1e-5));
      const {variance, print} = await pixels(page, '#view canvas');
      assert.ok(variance > 50, `the view is blank: ${variance}`);
      seen.add(print);
    }
    assert.equal(seen.size, 3);
  });

  test('each camera sees something else', async () => {
    await page.evaluate(() => window.insertion.seek(20));
    const seen = new Set();
    for (const [key, camera] of [['2', 'follow'], ['3', 'endoscope'], ['1', 'overview']]) {
      await page.keyboard.press(key);
      assert.equal((await state(page)).camera, camera);
      const {variance, print} = await pixels(page, '#view canvas');
      assert.ok(variance > 50, `${camera} is blank: ${variance}`);
      seen.add(print);
    }
    assert.equal(seen.size, 3);
  });

  test('it plays, stops, and steps by keys', async () => {
    await page.evaluate(() => window.insertion.seek(0));
    await page.keyboard.press(' ');
    await page.waitForFunction(() => window.insertion.state().frame > 1);
    await page.keyboard.press(' ');
    const {frame, playing} = await state(page);
    assert.equal(playing, false);
    await page.keyboard.press('ArrowLeft');
    assert.equal((await state(page)).frame, frame - 1);
    await page.keyboard.press('End');
    assert.equal((await state(page)).frame, last);
    await page.keyboard.press('Shift+ArrowLeft');
    assert.equal((await state(page)).frame, last - 10);
    await page.evaluate(() => window.insertion.seek(3));
    await page.keyboard.press('n');
    assert.equal((await state(page)).frame, sample.frames.findIndex((frame, at) => at > 3 && frame.contacts.length));
  });

  test('charts are drawn, and a click goes to that time', async () => {
    const charts = await page.$$('#charts .u-over');
    assert.equal(charts.length, 6);
    for (let at = 1; at <= charts.length; ++at) {
      const {variance} = await pixels(page, `#charts figure:nth-child(${at}) canvas`);
      assert.ok(variance > 1, `chart ${at} is blank: ${variance}`);
    }
    const box = await charts[2].boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    assert.ok(Math.abs((await state(page)).time - sample.frames[last].time / 2) < 0.2);
    // A drag zooms and stays at the time; a double click undoes the zoom.
    const before = await state(page);
    await page.mouse.move(box.x + 20, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 3, box.y + 20, {steps: 4});
    await page.mouse.up();
    assert.equal((await state(page)).frame, before.frame);
    assert.ok(!await page.isVisible('#charts figure:last-child .now'));
    await page.mouse.dblclick(box.x + 20, box.y + 20);
    await page.waitForSelector('#charts figure:last-child .now');
    // The figure is that at the pointer, and away from charts that of the frame.
    const value = () => page.textContent('#charts figure:nth-child(3) .value');
    await page.evaluate(() => window.insertion.seek(11));
    await page.mouse.move(box.x + box.width / last * 4, box.y + 20);
    assert.equal(await value(), String(sample.series.contacts[4]));
    await page.mouse.move(20, 20);
    assert.equal(await value(), String(sample.series.contacts[11]));
  });

  test('tables say what the input says', async () => {
    const contacts = await cells(page, '#contact-table');
    assert.equal(contacts.length, sample.contact_table.rows.length);
    sample.contact_table.rows.forEach((row, at) => row.forEach((value, column) =>
      assert.ok(typeof value === 'string' ? contacts[at][column] === value : near(contacts[at][column], value))));
    const figures = await cells(page, '#summary');
    assert.deepEqual(figures.map(([name]) => name), Object.keys(sample.summary));
    Object.values(sample.summary).forEach((value, at) => assert.ok(near(figures[at][1], value), figures[at].join(' ')));
    for (const [frame, {contacts}] of sample.frames.entries()) {
      await page.evaluate(frame => window.insertion.seek(frame), frame);
      const rows = await cells(page, '#frame-contacts');
      assert.equal(rows.length, contacts.length);
      contacts.forEach((contact, at) => {
        const [kind, vertex, time, tag, impulse, normal, point] = rows[at];
        assert.deepEqual([kind, vertex, tag], [contact.kind, contact.vertex < 0 ? '–' : String(contact.vertex), String(contact.tag)]);
        assert.ok(near(time, contact.time) && near(impulse, contact.impulse));
        normal.split(', ').forEach((text, axis) => assert.ok(Math.abs(Number(text) - contact.normal[axis]) < 1e-3));
        point.split(', ').forEach((text, axis) => assert.ok(near(text, contact.point[axis])));
      });
    }
  });

  test('a contact under the pointer tells its figures, a click keeps it', async () => {
    const frame = 23;
    await page.evaluate(frame => window.insertion.seek(frame), frame);
    const first = sample.frames.slice(0, frame).reduce((sum, {contacts}) => sum + contacts.length, 0);
    const place = await page.evaluate(contact => window.insertion.place(contact), first);
    const box = await page.locator('#view').boundingBox();
    await page.mouse.move(box.x + place.x, box.y + place.y);
    assert.match(await page.textContent('#tip'), new RegExp(`kind${sample.frames[frame].contacts[0].kind}`));
    await page.mouse.down();
    await page.mouse.up();
    await page.mouse.move(box.x + 5, box.y + box.height / 2);
    assert.equal((await state(page)).selected, first);
    assert.ok(await page.isVisible('#tip'));
    await page.waitForURL(address => address.hash === `#frame=${frame}&camera=overview&contact=${first}`);
    await page.keyboard.press('Escape');
    assert.ok(!await page.isVisible('#tip'));
  });

  test('nothing was wrong and nothing asked for', async () => {
    await page.evaluate(() => window.insertion.seek(26));
    await picture(page, 'light.png');
    await picture(page, 'whole.png');
    assert.deepEqual(wrong, []);
  });

  test('an address with a frame and a camera; dark', async () => {
    const other = await open(browser, {hash: '#frame=21&camera=follow', colorScheme: 'dark'});
    const {frame, camera} = await state(other.page);
    assert.deepEqual([frame, camera], [21, 'follow']);
    const {print} = await pixels(other.page, '#view canvas');
    await other.page.keyboard.press('1');
    assert.notEqual((await pixels(other.page, '#view canvas')).print, print);
    await other.page.keyboard.press('2');
    await picture(other.page, 'dark.png');
    assert.deepEqual(other.wrong, []);
  });

  test('a frame that was not verified is said and shown', async () => {
    const {series, summary} = sample;
    const verified = series.verified.map((_, frame) => frame === 7 ? 0 : 1);
    assert.equal(build(changed({series: {...series, verified}, summary: {...summary, 'demo.exactly_free_steps': 599}})).status, 0);
    const other = await open(browser, {address: pathToFileURL(`${spoilt}.html`).href});
    assert.match(await other.page.textContent('#validation'), /599 of 600/);
    assert.equal(await other.page.getAttribute('#validation', 'class'), 'bad');
    await other.page.click('#validation button');
    assert.equal((await state(other.page)).frame, 7);
    assert.deepEqual(other.wrong, []);
    fs.rmSync(`${spoilt}.html`);
  });

  test('on a phone nothing is wider than the screen', async () => {
    const screen = {viewport: {width: 390, height: 844}, hasTouch: true, deviceScaleFactor: 2};
    const phone = await open(browser, {...screen, hash: '#frame=26'});
    assert.equal(await phone.page.evaluate(() => document.documentElement.scrollWidth), 390);
    await picture(phone.page, 'phone.png');
    assert.deepEqual(phone.wrong, []);
  });
});

test('without WebGL there is a message, and the charts still', async () => {
  const browser = await launch(['--disable-3d-apis']);
  try {
    const {page, wrong} = await open(browser);
    assert.ok(await page.isVisible('#no-webgl'));
    await page.fill('#slider', '17');
    assert.equal((await state(page)).frame, 17);
    assert.ok((await pixels(page, '#charts canvas')).variance > 1);
    assert.equal((await cells(page, '#frame-contacts')).length, sample.frames[17].contacts.length);
    await picture(page, 'no-webgl.png');
    assert.deepEqual(wrong, []);
  } finally {
    await browser.close();
  }
});

test('an input that is not as agreed gives a message and no page', () => {
  for (const [insertion, message] of [
    ['{"format": 1', /JSONDecodeError/],
    [changed({format: 2}), /format 2 is not 1/],
    [changed({title: '\ud800'}), /UnicodeEncodeError/],
    [changed({title: 3}), /AttributeError/],
    [changed({frames: []}), /no frames/],
    [changed({wall: undefined}), /'wall'/],
    [changed({wall: {...sample.wall, triangles: [0, 1, 640]}}), /triangle/],
    [changed({series: {...sample.series, contacts: [1]}}), /one entry a frame: contacts/],
  ]) {
    const {status, stderr} = build(insertion);
    assert.equal(status, 1);
    assert.match(stderr, /^page: cannot use .*spoilt.json/);
    assert.match(stderr, message);
    assert.ok(!fs.existsSync(`${spoilt}.html`));
  }
});
