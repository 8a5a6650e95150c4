// The page in a browser without a screen and without a network: node --test, with PAGE, PICTURES (a folder for screenshots), CHROMIUM, and
// SESSION (the native program browser_session) in the environment. Playwright is looked for in NODE_PATH.
const assert = require('node:assert/strict');
const {spawnSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {after, before, describe, test} = require('node:test');
const {pathToFileURL} = require('node:url');
const {chromium} = require('playwright-core');

const {PAGE, PICTURES, SESSION} = process.env;
const VERTICES = 76; // of the wire when all of it is in the vessel
const LONG = 300000; // ms: far more than a quiet machine needs
const FILES = path.join(__dirname, 'files');

const state = page => page.evaluate(() => window.browser.state());
/** A picture with smooth edges, which a page without a graphics card draws slowly. */
async function picture(page, name) {
  await page.evaluate(() => window.browser.drawSharp(true));
  await page.waitForTimeout(500);
  await page.screenshot({path: path.join(PICTURES, name), timeout: LONG});
  await page.evaluate(() => window.browser.drawSharp(false));
}

const report = (name, value) => console.log(`browser: ${name} ${value}`);

async function open(browser, options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, offline: true, ...options});
  const page = await context.newPage();
  const wrong = [];
  page.on('console', message => ['error', 'warning'].includes(message.type()) && wrong.push(message.text()));
  page.on('pageerror', error => wrong.push(error.stack));
  page.on('request', request => /^(file|data|blob):/.test(request.url()) || wrong.push(request.url()));
  await page.goto(pathToFileURL(PAGE).href, {timeout: LONG});
  await page.waitForFunction(() => window.browser?.state().running, null, {timeout: LONG});
  return {page, wrong};
}

/** Pictures drawn a second, over some seconds. */
const framesPerSecond = (page, seconds) => page.evaluate(seconds => new Promise(resolve => {
  let frames = 0;
  const begin = performance.now();
  const count = now => {
    ++frames;
    now - begin < 1000 * seconds ? requestAnimationFrame(count) : resolve(1000 * frames / (now - begin));
  };
  requestAnimationFrame(count);
}), seconds);

/** Which of the page's steps so far the native program makes with other bits; -1 if none. */
async function compare(page, name) {
  const {log, bytes} = await page.evaluate(async () => {
    window.browser.pause();
    const {bytes} = await window.browser.ask('recorded');
    let text = '';
    for (let at = 0; at < bytes.length; at += 0x8000) {
      text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
    }
    return {log: window.browser.state().log, bytes: btoa(text)};
  });
  const input = path.join(PICTURES, `${name}.txt`);
  const output = path.join(PICTURES, `${name}.states`);
  fs.writeFileSync(input, log.map(({steps, push, turn, beat, cut}) => `${steps} ${push} ${turn} ${+beat} ${+cut}\n`).join(''));
  const {status, stdout, stderr} = spawnSync(SESSION, [input, output], {encoding: 'utf8'});
  assert.equal(status, 0, stderr);
  const native = fs.readFileSync(output);
  const inPage = Buffer.from(bytes, 'base64');
  report(`${name}_states_bytes`, native.length);
  assert.equal(inPage.length, native.length);
  assert.ok(inPage.equals(native), `the states differ from byte ${inPage.findIndex((byte, at) => byte !== native[at])} on`);
  return {stdout, steps: log.reduce((sum, {steps}) => sum + steps, 0)};
}

async function drop(page, name) {
  const bytes = fs.readFileSync(path.join(FILES, name)).toString('base64');
  await page.evaluate(({name, bytes}) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([Uint8Array.from(atob(bytes), letter => letter.charCodeAt(0))], name));
    document.body.dispatchEvent(new DragEvent('drop', {dataTransfer, bubbles: true, cancelable: true}));
  }, {name, bytes});
}

describe('the page', () => {
  let browser, page, wrong;
  before(async () => {
    browser = await chromium.launch({
      executablePath: process.env.CHROMIUM,
      args: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
    });
    ({page, wrong} = await open(browser));
  });
  after(() => browser.close());

  test('the wire is pushed to the end by a key, and drawn often enough', async () => {
    await page.evaluate(() => window.browser.begin('record'));
    await page.keyboard.down('ArrowUp');
    await page.waitForFunction(() => window.browser.state().vertices > 30, null, {timeout: LONG});
    const frames = await framesPerSecond(page, 4);
    report('frames_per_second', frames.toFixed(1));
    await page.waitForFunction(() => window.browser.state().vertices > 40, null, {timeout: LONG});
    await picture(page, 'overview.png');
    await page.waitForFunction(wanted => window.browser.state().vertices === wanted, VERTICES, {timeout: LONG});
    await page.keyboard.up('ArrowUp');
    const {contacts, tip, milliseconds} = await state(page);
    report('step_milliseconds', (milliseconds.reduce((sum, time) => sum + time, 0) / milliseconds.length).toFixed(2));
    assert.ok(contacts > 0);
    assert.ok(tip[0] > 80, `the tip is at ${tip}`);
    await picture(page, 'end.png');
    assert.ok(frames >= 30, `${frames} frames a second`);
  });

  test('all bits of it are those of the native program', async () => {
    const {steps, stdout} = await compare(page, 'pushed');
    report('pushed_steps', steps);
    console.log(stdout);
  });

  test('the grip is dragged, the wall beats and is cut: the same bits again', async () => {
    await page.evaluate(() => window.browser.begin('record'));
    await page.keyboard.down('ArrowUp');
    await page.waitForFunction(() => window.browser.state().vertices > 18, null, {timeout: LONG});
    await page.keyboard.up('ArrowUp');
    const before = await state(page);
    const grip = await page.evaluate(() => window.browser.grip());
    await page.mouse.move(grip.x, grip.y);
    await page.mouse.down();
    await page.mouse.move(grip.x + 60, grip.y + 20, {steps: 12});
    await page.waitForFunction(vertices => window.browser.state().vertices > vertices + 2, before.vertices, {timeout: LONG});
    await page.mouse.up();
    await page.click('#follow');
    await page.keyboard.press('c');
    await page.waitForFunction(() => /open beside the tip/.test(window.browser.state().message), null, {timeout: LONG});
    const {steps} = await state(page);
    await page.waitForFunction(steps => window.browser.state().steps > steps + 60, steps, {timeout: LONG});
    await picture(page, 'cut.png');
    await page.click('#beat');
    await page.keyboard.down('w');
    await page.waitForFunction(steps => window.browser.state().steps > steps + 150, steps, {timeout: LONG});
    await picture(page, 'beat.png');
    const frames = await framesPerSecond(page, 4);
    report('beating_frames_per_second', frames.toFixed(1));
    await page.keyboard.up('w');
    const pull = await page.locator('[data-hand="pull"]').boundingBox();
    await page.mouse.move(pull.x + 20, pull.y + 10);
    await page.mouse.down();
    await page.waitForTimeout(700);
    await page.mouse.up();
    await page.click('#follow');
    const {stdout} = await compare(page, 'changed');
    assert.match(stdout, /1 of 1 cuts/);
    assert.ok(frames >= 30, `${frames} frames a second`);
  });

  test('files are dropped: a surface, volumes, and what cannot be used', async () => {
    for (const [name, message] of [
      ['tube.obj', /tube.obj: the wire is in the surface. Its 2 openings were closed./],
      ['tube.off', /tube.off: the wire is in the surface/],
      ['tube.stl', /tube.stl: the wire is in the surface/],
      ['box.vtk', /box.vtk: the wire is in the mesh/],
      ['box.msh', /box.msh: the wire is in the mesh/],
      ['twisted.obj', /twisted.obj: triangles at an edge/],
      ['short.off', /short.off: the file ends early/],
      ['inverted.vtk', /inverted.vtk: the volumes cannot be used: DSW_STATUS_/],
      ['readme.txt', /readme.txt: the page reads only files that end in/],
    ]) {
      await drop(page, name);
      await page.waitForFunction(text => new RegExp(text).test(window.browser.state().message), message.source,
          {timeout: LONG});
      if (/the wire is in/.test(message.source)) {
        await page.keyboard.down('ArrowUp');
        await page.waitForFunction(() => window.browser.state().contacts > 0 && window.browser.state().vertices > 6, null,
            {timeout: LONG});
        await page.keyboard.up('ArrowUp');
        await picture(page, `${name}.png`);
      }
      assert.ok((await state(page)).running);
    }
  });

  test('nothing was wrong and nothing was asked for', () => assert.deepEqual(wrong, []));

  test('on a phone nothing is wider than the screen', async () => {
    const phone = await open(browser, {viewport: {width: 390, height: 844}, hasTouch: true, deviceScaleFactor: 2});
    assert.equal(await phone.page.evaluate(() => document.documentElement.scrollWidth), 390);
    await phone.page.waitForTimeout(1500);
    await picture(phone.page, 'phone.png');
    assert.deepEqual(phone.wrong, []);
    await phone.page.context().close();
  });
});
