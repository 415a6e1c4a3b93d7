// What a person does on the page, by pointer, finger and keys.
import assert from 'node:assert/strict';
import {after, test} from 'node:test';
import type {Page} from 'playwright-core';
import type {Method} from '../../web/compare/src/results.js';
import {closeBrowser, colourAt, done, makeFolder, open, placeOf} from './browser.js';
import {frames} from './frames.js';
import {dataOf} from './truth.js';

after(closeBrowser);
const {folder, results} = makeFolder();
const shown = ['reference', ...results.methods.filter(m => m.status === 'ok').map(m => m.name)];

const valueNow = async (page: Page): Promise<number> =>
  Number(await page.getByRole('slider').getAttribute('aria-valuenow'));

async function cell(page: Page, method: string, value: string): Promise<string> {
  return page.locator(`#loupe tr[data-method="${method}"] td[data-value="${value}"]`).innerText();
}

/** Scale and place of every picture, in units of its own frame. */
async function placements(page: Page): Promise<number[][]> {
  return page.locator('.frame').evaluateAll(all => all.map(frame => {
    const box = frame.getBoundingClientRect(), image = frame.querySelector('img')?.getBoundingClientRect() ?? box;
    return [image.width / box.width, (image.left - box.left) / box.width, (image.top - box.top) / box.height];
  }));
}

async function locked(page: Page): Promise<number[]> {
  await frames(page);
  const [first = [], ...others] = await placements(page);
  assert.equal(others.length, shown.length);
  for (const other of others)
    other.forEach((value, i) => { assert.ok(Math.abs(value - (first[i] ?? NaN)) < 0.02, `${first.join()} and ${other.join()}`); });
  return first;
}

test('the divider moves by pointer and shows either picture on its side', async () => {
  const opened = await open(folder), {page} = opened;
  await page.getByLabel('Left', {exact: true}).selectOption('hard');
  await page.getByLabel('Right', {exact: true}).selectOption('parker');
  await page.getByText('Visible fraction', {exact: true}).first().click();
  const hard = dataOf(folder, 'hard'), parker = dataOf(folder, 'parker');
  let pixel = {x: 0, y: 0};
  for (let y = 20; y < hard.height - 20; ++y)
    for (let x = 60; x < hard.width - 60; ++x)
      if (hard.mean(x, y) === 1 && Math.abs((parker.mean(x, y) ?? 0) - 0.5) < 0.1 && Math.abs(x - 160) > 30) pixel = {x, y};
  assert.notEqual(pixel.x, 0);
  const stage = await page.locator('#stage').boundingBox(), at = await placeOf(page, pixel.x, pixel.y);
  assert.ok(stage);
  for (const [share, data] of [[0.95, hard], [0.05, parker]] as const) {
    const grip = await page.locator('.grip').boundingBox();
    assert.ok(grip);
    await page.mouse.move(grip.x + grip.width / 2, grip.y + grip.height / 2);
    await page.mouse.down();
    await page.mouse.move(stage.x + share * stage.width, stage.y + 40, {steps: 4});
    await page.mouse.up();
    await page.mouse.move(stage.x + 2, stage.y + stage.height - 2);
    await frames(page);
    assert.ok(Math.abs(await valueNow(page) - 100 * share) <= 1);
    const grey = 255 * (data.mean(pixel.x, pixel.y) ?? NaN);
    for (const channel of await colourAt(page, at.x, at.y))
      assert.ok(Math.abs(channel - grey) < 2, `${channel} and ${grey}`);
  }
  await done(opened);
});

test('the divider moves by keys', async () => {
  const opened = await open(folder), {page} = opened;
  const slider = page.getByRole('slider');
  await slider.focus();
  for (const [key, value] of [['ArrowRight', 51], ['ArrowLeft', 50], ['ArrowUp', 51], ['ArrowDown', 50], ['Shift+ArrowLeft', 40],
    ['PageUp', 50], ['PageDown', 40], ['Home', 0], ['ArrowLeft', 0], ['End', 100], ['ArrowRight', 100]] as const) {
    await slider.press(key);
    await frames(page);
    assert.equal(await valueNow(page), value, key);
  }
  assert.match(await slider.getAttribute('aria-valuetext') ?? '', /100 %: sdf-inner on the left, reference on the right/);
  await done(opened);
});

test('the divider and the pictures follow fingers', async () => {
  const opened = await open(folder, {hasTouch: true, isMobile: true, viewport: {width: 360, height: 740}}), {page} = opened;
  const client = await page.context().newCDPSession(page);
  const touch = async (type: 'touchStart' | 'touchMove' | 'touchEnd', ...points: [number, number][]): Promise<void> => {
    await client.send('Input.dispatchTouchEvent', {type, touchPoints: points.map(([x, y], id) => ({x, y, id}))});
  };
  await page.locator('#stage').scrollIntoViewIfNeeded();
  const stage = await page.locator('#stage').boundingBox(), grip = await page.locator('.grip').boundingBox();
  assert.ok(stage && grip);
  await touch('touchStart', [grip.x + 14, grip.y + 14]);
  await touch('touchMove', [stage.x + 0.6 * stage.width, grip.y + 14]);
  await touch('touchMove', [stage.x + 0.8 * stage.width, grip.y + 14]);
  await touch('touchEnd');
  await frames(page);
  assert.ok(Math.abs(await valueNow(page) - 80) <= 1);

  const middle: [number, number] = [stage.x + stage.width / 4, stage.y + stage.height / 2];
  await touch('touchStart', [middle[0] - 20, middle[1]], [middle[0] + 20, middle[1]]);
  for (const reach of [30, 40, 60]) await touch('touchMove', [middle[0] - reach, middle[1]], [middle[0] + reach, middle[1]]);
  await touch('touchEnd');
  const [scale] = await locked(page);
  assert.ok(Math.abs((scale ?? 0) - 3) < 0.3, `pinched to ${scale ?? 0}`);

  const before = await locked(page);
  await touch('touchStart', middle);
  await touch('touchMove', [middle[0] + 20, middle[1] + 10]);
  await touch('touchMove', [middle[0] + 40, middle[1] + 20]);
  await touch('touchEnd');
  assert.ok(((await locked(page))[1] ?? 0) - (before[1] ?? 0) > 0.05);
  await done(opened);
});

test('the loupe shows the visible fractions of the files', async () => {
  const opened = await open(folder), {page} = opened;
  const truth = dataOf(folder, 'reference');
  let surfaces = 0, without = 0;
  for (const [x, y] of [[0, 0], [319, 199], [10, 120], [100, 110], [210, 105], [270, 130], [165, 40]] as const) {
    const at = await placeOf(page, x, y);
    await page.mouse.move(at.x, at.y);
    await frames(page);
    assert.equal(await page.locator('#loupe .place').innerText(), `x ${x}, y ${y}${truth.mean(x, y) === null ? ': no surface' : ''}`);
    for (const name of shown) {
      const data = dataOf(folder, name), seen = data.mean(x, y), expected = truth.mean(x, y);
      const shownMean = await cell(page, name, 'mean');
      if (seen === null || expected === null) {
        assert.equal(shownMean, '–');
        ++without;
        continue;
      }
      ++surfaces;
      assert.equal(shownMean, seen.toFixed(3), `${name} at ${x}, ${y}`);
      for (let i = 0; i < data.lights; ++i) assert.equal(await cell(page, name, `light-${i}`), data.at(x, y, i)?.toFixed(3));
      const error = (await cell(page, name, 'error')).replace('−', '-');
      if (name !== 'reference') assert.ok(Math.abs(Number(error) - (seen - expected)) < 0.00051, `${name}: ${error}`);
    }
  }
  assert.ok(surfaces > 20 && without > 0);
  await done(opened);
});

test('the loupe moves by keys and stays when pinned', async () => {
  const opened = await open(folder), {page} = opened;
  const place = page.locator('#loupe .place'), stage = page.locator('#stage');
  const at = await placeOf(page, 50, 120);
  await page.mouse.click(at.x, at.y);
  await frames(page);
  assert.equal(await page.getByRole('button', {name: 'Pinned'}).getAttribute('aria-pressed'), 'true');
  await page.mouse.move(at.x + 100, at.y + 50);
  await frames(page);
  assert.equal(await place.innerText(), 'x 50, y 120');
  await stage.focus();
  for (const [key, text] of [['ArrowRight', 'x 51, y 120'], ['ArrowDown', 'x 51, y 121'], ['Shift+ArrowLeft', 'x 41, y 121'], ['Shift+ArrowUp', 'x 41, y 111']] as const) {
    await stage.press(key);
    await frames(page);
    assert.equal(await place.innerText(), text);
  }
  const told = dataOf(folder, 'sdf-inner').mean(41, 111)?.toFixed(3);
  assert.match(await page.locator('#loupe output').innerText(), new RegExp(`Pixel 41, 111: sdf-inner ${told ?? ''}, reference`));
  await stage.press('Escape');
  await page.mouse.move(at.x, at.y + 1);
  await frames(page);
  assert.equal(await place.innerText(), 'x 50, y 120');
  await done(opened);
});

test('all pictures zoom and pan together', async () => {
  const opened = await open(folder), {page} = opened;
  assert.deepEqual((await locked(page)).map(v => Number(v.toFixed(2))), [1, 0, 0]);
  const at = await placeOf(page, 80, 50);
  await page.mouse.move(at.x, at.y);
  await page.mouse.wheel(0, -400);
  const [wheeled = 0] = await locked(page);
  assert.ok(wheeled > 1.5);
  const kept = await placeOf(page, 80, 50);
  assert.ok(Math.hypot(kept.x - at.x, kept.y - at.y) < 3, 'the wheel zooms about the pointer');
  await page.mouse.down();
  await page.mouse.move(at.x + 50, at.y + 30, {steps: 3});
  await page.mouse.up();
  await frames(page);
  const dragged = await placeOf(page, 80, 50);
  assert.ok(Math.abs(dragged.x - kept.x - 50) < 5 && Math.abs(dragged.y - kept.y - 30) < 5);
  await locked(page);
  assert.equal(await page.getByRole('button', {name: 'Pinned'}).count(), 0, 'a drag does not pin');
  await page.getByRole('button', {name: 'Zoom in'}).click();
  const [closer = 0] = await locked(page);
  assert.ok(Math.abs(closer / wheeled - 1.5) < 0.01);
  assert.equal(await page.locator('#stage img').first().evaluate(i => getComputedStyle(i).imageRendering), 'pixelated');
  await page.getByRole('button', {name: 'Fit'}).click();
  assert.equal((await locked(page))[0]?.toFixed(3), '1.000');
  const stage = page.locator('#stage');
  await stage.focus();
  await stage.press('+');
  assert.equal((await locked(page))[0]?.toFixed(3), '1.500');
  for (let i = 0; i < 40; ++i) await stage.press('Shift+ArrowRight');
  const [scale = 0, left = 0] = await locked(page);
  assert.ok(Math.abs(left - (1 - scale)) < 0.01, 'the picture follows the loupe to its edge');
  await stage.press('0');
  assert.equal((await locked(page))[0]?.toFixed(3), '1.000');
  await done(opened);
});

test('any method comes to either side, and failed ones to none', async () => {
  const opened = await open(folder), {page} = opened;
  await page.getByRole('button', {name: 'Show hard on the left'}).click();
  await page.getByLabel('Right', {exact: true}).selectOption('area');
  await frames(page);
  assert.deepEqual(await page.locator('#stage .name').allInnerTexts(), ['hard', 'area']);
  await page.getByRole('button', {name: 'Swap'}).click();
  await frames(page);
  assert.deepEqual(await page.locator('#stage .name').allInnerTexts(), ['area', 'hard']);
  const options = page.locator('#pick-left option');
  assert.deepEqual(await options.evaluateAll(all => all.filter(o => !(o as HTMLOptionElement).disabled).map(o => o.textContent)), shown);
  assert.deepEqual(await options.evaluateAll(all => all.filter(o => (o as HTMLOptionElement).disabled).map(o => o.textContent)),
    ['heckbert-herf (failed)']);
  for (const [kind, part] of [['Error', 'errors/hard.png'], ['Visible fraction', 'visibility/hard.png'], ['Picture', 'pictures/hard.png']] as const) {
    await page.getByText(kind, {exact: true}).first().click();
    await frames(page);
    assert.equal(await page.locator('#stage .layer.right img').getAttribute('src'), part);
  }
  await done(opened);
});

test('visible fractions and errors of one light', async () => {
  const opened = await open(folder), {page} = opened, data = dataOf(folder, 'parker'), truth = dataOf(folder, 'reference');
  await page.getByRole('button', {name: 'Show parker on the left'}).click();
  assert.equal(await page.locator('#pick-light').isVisible(), false);
  let pixel = {x: 0, y: 0}, value = 0, error = 0;
  for (let y = 20; y < data.height - 20; ++y)
    for (let x = 20; x < 130; ++x) {
      const seen = data.at(x, y, 1), expected = truth.at(x, y, 1);
      if (seen === null || expected === null || seen - expected > -0.5) continue;
      pixel = {x, y};
      value = seen;
      error = seen - expected;
    }
  assert.ok(error < -0.5);
  await page.getByText('Visible fraction', {exact: true}).first().click();
  await page.locator('#pick-light').selectOption('fill');
  const shows = async (colour: number[]): Promise<void> => {
    await page.waitForFunction(() => [...document.querySelectorAll('#stage img')].every(i => i.closest('.right') ?? (i.getAttribute('src')?.startsWith('blob:') && (i as HTMLImageElement).complete)));
    await frames(page);
    const at = await placeOf(page, pixel.x, pixel.y), seen = await colourAt(page, at.x, at.y);
    seen.forEach((channel, i) => { assert.ok(Math.abs(channel - (colour[i] ?? NaN)) < 2, `${seen.join()} for ${colour.join()}`); });
  };
  await shows([255 * value, 255 * value, 255 * value]);
  await page.getByText('Error', {exact: true}).first().click();
  await page.waitForFunction(old => document.querySelector('#stage .left img')?.getAttribute('src') !== old,
    await page.locator('#stage .left img').getAttribute('src'));
  await shows([5, 48, 97]);
  await done(opened);
});

type Key = (m: Method) => number | string | null | undefined;
const keys: [string, Key][] = [
  ['method', m => m.name],
  ['RMSE', m => m.error?.penumbra.rmse], ['bias', m => m.error?.penumbra.bias],
  ['time, s', m => m.cost?.seconds?.median], ['× hard', m => m.cost?.relative_to_hard],
  ['points', m => m.equal_area?.points], ['time, s', m => m.equal_area?.seconds],
  ['RMSE', m => m.error?.all.rmse], ['bias', m => m.error?.all.bias], ['largest', m => m.error?.largest],
  ['> 0.1, %', m => m.error?.share_beyond_tenth], ['FLIP', m => m.error?.flip], ['SSIM', m => m.error?.ssim],
  ['leaked', m => m.error?.leaked], ['lost', m => m.error?.lost],
  ['spread, s', m => m.cost?.seconds ? (m.cost.seconds.most ?? 0) - (m.cost.seconds.least ?? 0) : null],
  ['rays', m => m.cost?.rays], ['distances', m => m.cost?.distance_evaluations], ['texels', m => m.cost?.texel_samples],
  ['memory, MB', m => m.cost?.peak_bytes], ['device', m => m.status === 'ok' ? m.device : 'cpu'],
];

async function inOrder(page: Page, key: Key, sign: 1 | -1, what: string): Promise<void> {
  const names = await page.locator('#methods tbody tr').evaluateAll(rows => rows.map(row => row.getAttribute('data-method')));
  assert.deepEqual([...names].sort(), results.methods.map(m => m.name).sort(), what);
  const values = names.map(name => key(results.methods.find(m => m.name === name) ?? results.methods[0] as Method) ?? null);
  for (let i = 1; i < values.length; ++i) {
    const a = values[i - 1] ?? null, b = values[i] ?? null;
    if (b === null) continue;
    assert.ok(a !== null, `${what}: a row without value stands before one that has it`);
    assert.ok(sign * (a < b ? -1 : a > b ? 1 : 0) <= 0, `${what}: ${a} before ${b}`);
  }
}

test('the table sorts by each column, by pointer and by keys', async () => {
  const opened = await open(folder), {page} = opened;
  const heads = page.locator('#methods thead tr:last-child th');
  assert.deepEqual((await heads.allInnerTexts()).map(t => t.trim()), keys.map(([name]) => name));
  for (const [i, [name, key]] of keys.entries()) {
    const press = heads.nth(i).getByRole('button');
    if (i === 1) await heads.nth(0).getByRole('button').click();
    await press.click();
    await inOrder(page, key, 1, `${name} ascending`);
    assert.equal(await heads.nth(i).getAttribute('aria-sort'), 'ascending');
    await press.focus();
    await press.press(i % 2 ? 'Enter' : 'Space');
    await inOrder(page, key, -1, `${name} descending`);
    assert.equal(await heads.nth(i).getAttribute('aria-sort'), 'descending');
    assert.equal(await page.locator('#methods [aria-sort]').count(), 1);
  }
  await done(opened);
});

test('the table says what results.json says, and why a method failed', async () => {
  const opened = await open(folder), {page} = opened;
  const parker = results.methods.find(m => m.name === 'parker');
  const cells = await page.locator('#methods tr[data-method=parker] td').allInnerTexts();
  assert.equal(cells[0], parker?.error?.penumbra.rmse?.toFixed(4));
  assert.equal(cells[2], parker?.cost?.seconds?.median?.toFixed(3));
  assert.equal(await page.locator('#methods tr[data-method=heckbert-herf] td').innerText(),
    'failed: no OpenGL driver was found; install libegl1 and libgl1-mesa-dri');
  await done(opened);
});

test('every control is reached by Tab and shows its focus', async () => {
  const opened = await open(folder), {page} = opened;
  const reached = new Set<string>();
  for (let i = 0; i < 120; ++i) {
    await page.keyboard.press('Tab');
    const told = await page.evaluate(() => {
      const e = document.activeElement;
      if (!e || e === document.body) return null;
      const visible = e.closest('.choice') ? e.nextElementSibling ?? e : e, style = getComputedStyle(visible);
      const grip = e.querySelector('.grip');
      const seen = style.outlineStyle !== 'none' || (grip !== null && getComputedStyle(grip).boxShadow.includes('3px'));
      return {name: e.id || e.getAttribute('role') || e.getAttribute('name') || e.tagName, seen};
    });
    if (!told) break;
    assert.ok(told.seen, `${told.name} shows no focus`);
    reached.add(told.name);
  }
  for (const name of ['pick-left', 'pick-right', 'show', 'stage', 'slider', 'region', 'error-over', 'BUTTON', 'A', 'SUMMARY', 'CODE'])
    assert.ok(reached.has(name), `${name} of ${[...reached].join(', ')}`);
  await done(opened);
});
