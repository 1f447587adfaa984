// The report in a headless browser: it draws, filters and opens a mark, without an error and without a network.
// Usage: node page_test.mjs SUNDIAL NODE_MODULES CHROMIUM. Exit status 77: skipped.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync, mkdtempSync, rmSync, statSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';

const [sundial, modules, browserPath] = process.argv.slice(2);
if (!existsSync(browserPath) || !existsSync(join(modules, 'playwright-core'))) {
  console.log(`skipped: it needs chromium (${browserPath}) and playwright-core (${modules})`);
  process.exit(77);
}
const {chromium} = createRequire(resolve(modules, 'any.js'))('playwright-core');
const folder = mkdtempSync(join(tmpdir(), 'sundial-chart-'));
const here = dirname(fileURLToPath(import.meta.url)), report = join(folder, 'report.html');
execFileSync(process.execPath, [join(here, 'canned_results.mjs'), folder, '200']);
execFileSync(sundial, ['chart', join(folder, 'results.jsonl'), '-o', report, '--quiet']);
assert(statSync(report).size < 20e6, 'the page is small enough to send');

const browser = await chromium.launch({executablePath: browserPath, args: ['--no-sandbox', '--disable-gpu', '--disable-quic',
  '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync']});
try {
  const page = await browser.newPage({viewport: {width: 1400, height: 900}});
  const complaints = [], requests = [];
  page.on('console', message => complaints.push(message.text()));
  page.on('pageerror', error => complaints.push(error.message));
  page.on('request', request => requests.push(request.url()));

  // The best of three: other programs share the machine.
  const dots = id => page.locator(`#${id} .dots path`);
  let seconds = Infinity;
  for (let attempt = 0; attempt < 3 && seconds > 2; ++attempt) {
    const began = performance.now();
    await page.goto(pathToFileURL(report).href);
    await dots('error-time').first().waitFor();
    seconds = Math.min(seconds, (performance.now() - began) / 1000);
  }
  console.log(`drawn after ${seconds.toFixed(2)} s, ${(statSync(report).size / 1e6).toFixed(1)} MB`);
  assert(seconds < 2, `drawn within 2 s, not ${seconds}`);

  // It draws: one mark a method with its parameters; a front; numbers; the table.
  const labels = 18;
  assert.equal(await dots('error-time').count(), labels);
  assert.equal(await dots('error-bytes').count(), labels);
  assert.match(await page.locator('#count').innerText(), /72 cases; 30 along a path/);
  // Along a path: those that were sent there; what never flips stands in the band of zeros, and the table says so.
  const steady = labels - 3;
  assert.equal(await dots('stability').count(), steady);
  const heightOf = async name => (await page.locator(`#stability .dots path[aria-label^="${name}"]`).boundingBox()).y;
  assert(await heightOf('sm 512') > Math.max(await heightOf('dv 512'), await heightOf('spsm 1024')) + 20, 'zero lies below');
  assert.equal(await page.locator('#flips tbody tr').count(), steady);
  assert.equal(await page.locator('#flips thead th').count(), 3);
  const flips = label => page.locator('#flips tbody tr', {has: page.getByRole('button', {name: label, exact: true})}).innerText();
  assert.match(await flips('sm,texels=512'), /0 %\s*pop 0 %/);
  assert.match(await flips('dv,texels=512'), /0\.\d+ %\s*pop 1\.60 %/);
  assert.equal(await page.locator('#error-time .frontsLine path').count(), 1);
  assert.equal(await page.locator('#cheapest tbody tr').count(), 3);
  assert.equal(await page.locator('#numbers tbody tr').count(), labels);
  assert(await page.locator('#passes .bars path').count() > labels);
  const text = async id => page.locator(id).innerText();
  assert.match(await text('#error-time'), /wrong pixels \[%/);
  assert.match(await text('#error-time'), /sm,texels=2048 \[ratio\]/);

  // It filters, by method, view and scene; views are those of the scene.
  await page.uncheck('#methods input[value=sm]');
  assert.equal(await dots('error-time').count(), labels - 4);
  await page.check('#methods input[value=sm]');
  await page.selectOption('#choose-view', 'nave');
  assert.match(await text('#count'), /36 cases/);
  await page.selectOption('#choose-scene', 'builtin:city');
  assert.equal(await page.inputValue('#choose-view'), '');
  assert.equal(await page.locator('#choose-view option').count(), 4);
  assert(await page.locator('#failed-section').isVisible());
  assert.match(await text('#failed'), /DEADLINE_EXCEEDED[\s\S]*<or>/);
  await page.click('#apart button:text("each case")');
  assert.equal(await dots('error-time').count(), 4 * labels - 1);
  assert.equal(await page.locator('#error-time .frontsLine path').count(), 4);
  await page.click('#apart button:text("means")');
  await page.selectOption('#choose-view', 'along flight');
  assert.equal(await dots('error-time').count(), steady);
  await dots('stability').first().click();
  assert.match(await page.locator('#dialog').innerText(), /along flight[\s\S]*flip rate[\s\S]*texel jump[\s\S]*2000, 24/);
  await page.keyboard.press('Escape');
  await page.selectOption('#choose-view', 'street');
  assert.match(await page.locator('#stability').innerText(), /no case matches/);
  await page.selectOption('#choose-view', '');
  await page.click('#time button:text("ms")');
  assert.match(await text('#error-time'), /\[ms\]/);
  await page.selectOption('#choose-error', 'edge_p95');
  assert.match(await text('#error-time'), /edge error, 95th percentile \[px\]/);
  assert.match(await text('#cheapest'), /≤ 16 px/);

  // A mark tells its numbers and opens, by mouse and by keyboard.
  await dots('error-time').first().hover();
  assert.match(await text('#tip'), /dv,texels=512[\s\S]*brackets/);
  await dots('error-time').first().click();
  const dialog = page.locator('#dialog');
  assert(await dialog.isVisible());
  assert.equal(await dialog.locator('.pictures img').count(), 3);
  for (const picture of await dialog.locator('.pictures img').all())
    assert(await picture.evaluate(async image => { await image.decode(); return image.naturalWidth > 0; }));
  assert.match(await text('#dialog'), /case 1 of 4/);
  await page.keyboard.press('ArrowRight');
  assert.match(await text('#dialog'), /case 2 of 4[\s\S]*512x512/);
  await page.keyboard.press('Escape');
  assert(!await dialog.isVisible());
  await dots('error-time').nth(1).focus();
  await page.keyboard.press('Enter');
  assert(await dialog.isVisible());
  assert.match(await text('#dialog h2'), /dv,texels=1024/);
  await page.click('#dialog form button');
  await page.locator('#numbers button').last().click();
  assert.match(await text('#dialog h2'), /spsm,texels=1024/);
  await page.keyboard.press('Escape');

  // Nothing is left to draw, and everything again.
  for (const box of await page.locator('#methods input').all()) await box.uncheck();
  assert.match(await text('#error-time'), /no case matches/);
  for (const box of await page.locator('#methods input').all()) await box.check();
  await page.setViewportSize({width: 420, height: 800});
  await page.waitForTimeout(300);
  assert(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling when narrow');

  assert.deepEqual(complaints, []);
  assert.deepEqual(requests.filter(url => !url.startsWith('file:') && !url.startsWith('data:')), []);
} finally {
  await browser.close();
  rmSync(folder, {recursive: true});
}
