// Uses the viewer page as people do: one tab plays a trace, another watches its session live.
//   node page_test.mjs PROGRAM BROWSER FOLDER_OF_WORLDS FOLDER_FOR_SCREENSHOTS   (see run.sh)
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

const { chromium } = createRequire(new URL('../../service/page/package.json', import.meta.url))('playwright-core');
const [, , program, executablePath, worlds, pictures] = process.argv;
const faults = []; // what no tab may do

/// The program with these arguments: {address, stop()}, once it has said where it listens.
async function start(...args) {
  const child = spawn(program, args, { stdio: ['ignore', 'pipe', 'inherit'] });
  const address = await new Promise((resolve, reject) => {
    child.stdout.on('data', (data) => resolve(/http:\S+/.exec(data)[0]));
    child.on('exit', (status) => reject(new Error(`${args[0]} has ended with status ${status}`)));
  });
  return { address, stop: () => child.kill('SIGTERM') };
}

const server = await start('serve', '--port', '0', '--audit', '1');
// A root shell, as in continuous integration, has no sandbox.
const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--enable-unsafe-swiftshader'] });
const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, colorScheme: 'light' });

async function openTab(name, address = server.address) {
  const tab = await context.newPage(), host = new URL(address).host;
  const inner = (url) => /^(data|blob):/.test(url) || new URL(url).host === host;
  tab.on('request', (request) => inner(request.url()) || faults.push(`${name}: request to ${request.url()}`));
  tab.on('websocket', (socket) => inner(socket.url()) || faults.push(`${name}: WebSocket to ${socket.url()}`));
  tab.on('pageerror', (error) => faults.push(`${name}: ${error.stack}`));
  tab.on('console', (message) => {
    // Without `gridcull view` there is no trace to load, which chromium notes.
    const noTrace = message.text().includes('404') && message.location().url.includes('/v1/trace/');
    if (message.type() === 'error' && !noTrace) faults.push(`${name}: ${message.text()}`);
  });
  await tab.goto(`${address}/`);
  return tab;
}

const text = (tab, selector) => tab.locator(selector).innerText();
const until = (tab, selector, pattern) => tab.locator(selector).filter({ hasText: pattern }).first().waitFor({ timeout: 30000 });
const frameOf = async (tab) => Number(/frame (\d+)/.exec(await text(tab, '#clock'))?.[1]);
const sizeOf = async (tab) => Number(await text(tab, '#pvs-size'));
const files = (world) => [`${worlds}/${world}/scene.json`, `${worlds}/${world}/frames.jsonl`];

/// Paused, `n` frames on.
async function stepTo(tab, n) {
  while (await frameOf(tab) < n) {
    const next = (await frameOf(tab)) + 1;
    await tab.keyboard.press('.');
    await until(tab, '#clock', new RegExp(`^frame ${next}\\b`));
  }
}

/// Where a point of a fitted ground plan is on the screen.
async function onMap(tab, { bounds }, [x, y]) {
  const box = await tab.locator('#flat').boundingBox();
  const size = [0, 1].map((axis) => bounds.max[axis] - bounds.min[axis]);
  const scale = Math.min(box.width / (1.04 * size[0]), box.height / (1.04 * size[1]));
  const middle = [0, 1].map((axis) => (bounds.max[axis] + bounds.min[axis]) / 2);
  return [box.x + box.width / 2 + (x - middle[0]) * scale, box.y + box.height / 2 - (y - middle[1]) * scale];
}

const answered = (tab) => tab.waitForFunction(() => !document.getElementById('why').innerText.includes('Working out'), null, { timeout: 30000 });

/// The page tells what is in the view by balls, the server precisely: some of the hidden may turn out to be outside.
async function nextHidden(tab) {
  for (let i = 0; i < 20; i++) {
    await tab.keyboard.press('N');
    await tab.waitForTimeout(50);
    await answered(tab);
    if (/ is hidden from viewer /.test(await text(tab, '#why'))) break;
  }
  assert.match(await text(tab, '#why'), /is hidden from viewer \d+\.\s+(It is covered by this object:|Together these \d+ objects cover it:)/);
}

async function explain(tab, id) {
  await tab.fill('#object-id', String(id));
  await tab.press('#object-id', 'Enter');
  await until(tab, '#why .verdict', new RegExp(`^Object ${id}\\b`));
  await answered(tab);
  await tab.locator('#object-id').blur();
  return text(tab, '#why');
}

async function check2d() {
  const town = JSON.parse(readFileSync(files('town')[0])), viewers = town.viewers.map(({ id }) => id);
  const driver = await openTab('driver'), watching = await openTab('watcher');
  await until(driver, '#sessions-empty', /No session is open/);
  await driver.setInputFiles('#files', files('town'));
  await until(driver, '#clock', /^frame \d+ of 60/);
  await driver.locator('body').press('Space');
  await until(driver, '#play', 'Play');

  // Another tab finds the session in the list and follows it.
  await watching.locator('#sessions button').first().click();
  await until(watching, '#facts', /2D · silhouette · cells of 2 m/);
  await stepTo(driver, (await frameOf(driver)) + 1);
  const frame = await frameOf(driver);
  await until(watching, '#clock', new RegExp(`^frame ${frame}\\b`));
  assert.equal(await sizeOf(watching), await sizeOf(driver), 'both tabs are told the same');
  assert.ok(await sizeOf(driver) > 0);

  // Choosing a viewer, by the list and by the keyboard.
  await watching.selectOption('#viewer', String(viewers[2]));
  await until(watching, '#viewer', /./);
  await driver.keyboard.press('v');
  await driver.keyboard.press('v');
  assert.equal(await driver.inputValue('#viewer'), String(viewers[2]));
  await stepTo(driver, frame + 1);
  await until(watching, '#clock', new RegExp(`^frame ${frame + 1}\\b`));
  assert.equal(await sizeOf(watching), await sizeOf(driver));

  // Back, on, layers, help, by keyboard.
  await driver.keyboard.press(',');
  await until(driver, '#clock', new RegExp(`^frame ${frame}\\b`));
  await driver.keyboard.press('End');
  await until(driver, '#clock', new RegExp(`^frame ${frame + 1}\\b`));
  assert.equal(await driver.isChecked('#layer-touched'), false);
  await driver.keyboard.press('4');
  assert.equal(await driver.isChecked('#layer-touched'), true);
  await driver.keyboard.press('4');
  await driver.keyboard.press('?');
  assert.ok(await driver.locator('#help').isVisible());
  await driver.keyboard.press('Escape');

  // Why: by the field, then by clicking a building.
  await driver.keyboard.press('n');
  await until(driver, '#why .verdict', / is seen by viewer | is hidden, but /);
  await driver.keyboard.press('f');
  const house = town.objects.find(({ static: still }) => still);
  await driver.mouse.click(...await onMap(driver, town, house.position));
  await until(driver, '#why .verdict', new RegExp(`^Object ${house.id}\\b`));
  await driver.keyboard.press('Escape');
  await nextHidden(driver);
  assert.match(await explain(watching, house.id), /is (seen by|hidden from|outside the view volume of) viewer|is hidden, but/);

  await driver.keyboard.press('Escape');
  await driver.keyboard.press('c');
  await stepTo(driver, 40);
  await nextHidden(driver);
  await driver.evaluate(() => document.activeElement.blur());
  await driver.waitForTimeout(500);
  await driver.screenshot({ path: `${pictures}/page-2d.png` });
  await driver.emulateMedia({ colorScheme: 'dark' });
  await driver.waitForTimeout(300);
  await driver.screenshot({ path: `${worlds}/page-2d-dark.png` });
  await watching.close();
  await driver.click('#back');
  await until(driver, '#sessions-empty', /No session is open/);
  await driver.close();
}

async function check3d() {
  const tab = await openTab('3D');
  await tab.setInputFiles('#files', files('city'));
  await until(tab, '#clock', /^frame \d+ of 30/);
  await tab.locator('body').press('Space');
  await until(tab, '#facts', /3D · silhouette/);
  await tab.selectOption('#method', 'voxel');
  await until(tab, '#facts', /3D · voxel/);
  await until(tab, '#clock', /^frame \d+ of 30/);
  await tab.locator('#clock').click();
  await tab.keyboard.press(' ');
  await until(tab, '#eye-title', /What viewer \d+ sees/);
  await stepTo(tab, 8);
  await nextHidden(tab);
  await tab.waitForTimeout(500);
  await tab.screenshot({ path: `${pictures}/page-3d.png` });
  await tab.close();
}

/// `gridcull view` serves a trace, which the page plays by itself.
async function checkView() {
  const [scene, frames] = files('town'), viewing = await start('view', scene, '--frames', frames);
  const tab = await openTab('view', viewing.address);
  await until(tab, '#clock', /^frame \d+ of 60/);
  await tab.close();
  viewing.stop();
}

async function checkRefusals() {
  const tab = await openTab('refusals');
  await tab.setInputFiles('#files', [{ name: 'frames.jsonl', mimeType: 'text/plain', buffer: Buffer.from('{"format": "gridcull.frames/1"}\n') }]);
  await until(tab, '#notice', /The scene is missing/);
  await tab.setInputFiles('#files', [{ name: 'scene.json', mimeType: 'text/plain', buffer: Buffer.from('{"format": "gridcull.scene/1", "dimension": 2, "objects": [{"id": 0}]}') }]);
  await until(tab, '#notice', /\/objects\/0/);
  await tab.close();
}

let status = 0;
try {
  const front = await (await fetch(`${server.address}/`)).text();
  if (!front.includes('id="work"')) {
    console.log('skipped: the program was built without the page');
    status = 77;
  } else {
    await checkRefusals();
    await check2d();
    await check3d();
    await checkView();
    assert.deepEqual(faults, []);
    console.log('the page: lists, watches, steps, chooses, explains; no fault in the console, no request elsewhere');
  }
} catch (fault) {
  console.error(fault);
  for (const line of faults) console.error(line);
  status = 1;
} finally {
  await browser.close();
  server.stop();
}
process.exitCode = status;
