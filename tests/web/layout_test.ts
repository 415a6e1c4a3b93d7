// How the page looks: width, contrast, names in plots, and what it makes of strange results.
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, test} from 'node:test';
import {deflateSync} from 'node:zlib';
import type {Page} from 'playwright-core';
import type {Results} from '../../web/compare/src/results.js';
import {closeBrowser, done, makeFolder, open} from './browser.js';
import type {Wish} from './fixture.js';
import {frames} from './frames.js';
import {lamps} from './spheres.js';

after(closeBrowser);
const {folder} = makeFolder();
const small = {width: 60, height: 40};
const manyLamps = Array.from({length: 30}, (_, i) => ({...lamps[i % 2] as (typeof lamps)[number], name: `lamp number ${i + 1}`}));

/** Every number becomes null, but for the picture's size, the version and the scales of axes. */
function withoutNumbers(results: Results): unknown {
  const keep = ['width', 'height', 'version', 'values', 'scale'];
  const emptied: unknown = JSON.parse(JSON.stringify(results), (key, value: unknown) =>
    typeof value === 'number' && !keep.includes(key) ? null : value);
  return {...emptied as Results, scale: results.scale, sweeps: results.sweeps?.map(s => ({...s, methods: s.methods.map(m =>
    ({name: m.name, rmse: null, penumbra_rmse: [null, null], seconds: []}))}))};
}

const variants: [string, Partial<Wish>, ((r: Results) => unknown)?][] = [
  ['the usual', {}],
  ['one method', {...small, methods: ['hard'], failed: []}],
  ['no sweeps and one light', {...small, sweeps: false, lamps: lamps.slice(0, 1)}],
  ['thirty lights', {...small, lamps: manyLamps}],
  ['every method failed', {...small, methods: ['hard', 'parker'], failed: ['hard', 'parker']}],
  ['a picture of one pixel', {width: 1, height: 1}],
  ['a very wide picture', {width: 2000, height: 20, methods: ['hard', 'parker']}],
  ['a very high picture', {width: 20, height: 900, methods: ['hard', 'parker']}],
  ['nothing measured', small, withoutNumbers],
  ['lists that are null', small, r => ({...r, sweeps: null, advice: null, machine: null, versions: null, command: null})],
  ['long words', small, r => ({...r, scene: {...r.scene, file: 'a'.repeat(300)}, command: 'b'.repeat(300)})],
];

for (const [name, wish, change] of variants)
  test(`${name}: no complaint, no sideways scroll on a phone`, async () => {
    const made = makeFolder(wish, change);
    for (const width of [360, 1280]) {
      const opened = await open(made.folder, {viewport: {width, height: 740}}), {page} = opened;
      await page.locator('details').evaluateAll(all => { for (const d of all) d.setAttribute('open', ''); });
      for (const kind of ['Visible fraction', 'Error', 'Picture']) {
        await page.getByText(kind, {exact: true}).first().click();
        await frames(page);
      }
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= width);
      const stage = await page.locator('#stage').boundingBox();
      assert.ok(stage && stage.width > 20 && stage.height >= 60 && stage.height <= 740);
      assert.equal(await page.locator('#methods tbody tr').count(), made.results.methods.length);
      await done(opened);
    }
  });

test('markup in names stays text', async () => {
  const bad = '</script><script>window.hacked = 1</script><img src=x onerror="window.hacked = 1">';
  const made = makeFolder(small, r => ({
    ...r, scene: {...r.scene, file: bad, lights: [{name: bad, kind: bad}, {name: bad, kind: bad}]}, command: bad,
    advice: {method: 'sdf-inner', text: bad},
    methods: r.methods.map(m => ({...m, title: bad, summary: bad, link: 'javascript:window.hacked=1', reason: m.reason && bad})),
  }));
  const opened = await open(made.folder), {page} = opened;
  assert.equal(await page.locator('h1').innerText(), bad);
  assert.equal(await page.evaluate(() => 'hacked' in window), false);
  assert.equal(await page.locator('a[href^="javascript"]').count(), 0);
  assert.equal(await page.locator('article a').count(), 0);
  await done(opened);
});

test('other results are refused in a sentence', async () => {
  const made = makeFolder(small, () => ({format: 'another', version: 1}));
  const {page} = await open(made.folder);
  assert.match(await page.locator('main').innerText(), /not of the format penumbra-compare, version 1/);
  await page.context().close();
});

test('compressed data and missing data', async () => {
  const made = makeFolder(small), file = join(made.folder, 'data', 'hard.js');
  const text = readFileSync(file, 'utf8');
  writeFileSync(file, text.replace(/"values":"([^"]*)"/, (_, base64: string) =>
    `"encoding":"deflate","values":"${deflateSync(Buffer.from(base64, 'base64')).toString('base64')}"`));
  writeFileSync(join(made.folder, 'data', 'area.js'), 'penumbraData("area", {"width":1,"height":1,"lights":1,"bits":8,"values":""});');
  writeFileSync(join(made.folder, 'data', 'parker.js'), '');
  const {page} = await open(made.folder);
  assert.match(await page.locator('#loupe tr[data-method=hard] [data-value=mean]').innerText(), /^[01]\.\d{3}$/);
  assert.match(await page.locator('#loupe tr[data-method=area]').innerText(), /data\/area\.js: its size is not what it says/);
  assert.match(await page.locator('#loupe tr[data-method=parker]').innerText(), /data\/parker\.js does not hold parker/);
  await page.context().close();
});

test('no name in a plot covers another, or is cut off', async () => {
  for (const width of [360, 700, 1280]) {
    const opened = await open(folder, {viewport: {width, height: 800}}), {page} = opened;
    const plots = await page.locator('.plot svg').evaluateAll(all => all.map(svg => {
      const holder = svg.getBoundingClientRect();
      return [...svg.querySelectorAll('text')].map(t => {
        const b = t.getBoundingClientRect();
        return {text: t.textContent, left: b.left - holder.left, right: b.right - holder.left, top: b.top - holder.top,
          bottom: b.bottom - holder.top, inside: b.left >= holder.left - 1 && b.right <= holder.right + 1};
      });
    }));
    assert.equal(plots.length, 3);
    for (const texts of plots) {
      assert.ok(texts.length > 8);
      for (const [i, a] of texts.entries()) {
        assert.ok(a.inside, `${a.text} is cut off at ${width}`);
        for (const b of texts.slice(0, i)) {
          const x = Math.min(a.right, b.right) - Math.max(a.left, b.left), y = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
          assert.ok(x < 1 || y < 3, `${a.text} covers ${b.text} at ${width}`);
        }
      }
    }
    await done(opened);
  }
});

/** Contrast ratios (WCAG 2.2, 1.4.3) of all texts, with what is behind them, that fall below 4.5. */
async function faint(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const rgb = (colour: string): number[] => {
      const parts = colour.match(/[\d.]+/g)?.map(Number) ?? [];
      return colour.startsWith('color(') ? [...parts.slice(0, 3).map(v => 255 * v), parts[3] ?? 1] : [...parts.slice(0, 3), parts[3] ?? 1];
    };
    const luminance = (c: number[]): number => {
      const [r = 0, g = 0, b = 0] = c.map(v => v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const behind = (element: Element): number[] => {
      let rest = 1;
      const sum = [0, 0, 0];
      for (let e: Element | null = element; e; e = e.parentElement) {
        const [r = 0, g = 0, b = 0, a = 1] = rgb(getComputedStyle(e).backgroundColor);
        [r, g, b].forEach((v, i) => { sum[i] = (sum[i] ?? 0) + rest * a * v; });
        rest *= 1 - a;
      }
      return sum.map(v => v + rest * 255);
    };
    const faint: string[] = [];
    let count = 0;
    for (const e of document.querySelectorAll('main *')) {
      if (![...e.childNodes].some(n => n.nodeType === Node.TEXT_NODE && n.textContent?.trim()) || !e.checkVisibility()) continue;
      if (e.matches('option, title, select')) continue;
      const style = getComputedStyle(e), ink = rgb(e instanceof SVGElement ? style.fill : style.color);
      const a = luminance(ink.slice(0, 3)), b = luminance(behind(e)), ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
      ++count;
      if (ratio < 4.5) faint.push(`${ratio.toFixed(2)}: ${e.tagName} ${e.textContent.slice(0, 40)}`);
    }
    if (count < 100) faint.push(`only ${count} texts were found`);
    return faint;
  });
}

test('text stands out in light and in dark', async () => {
  const grounds = [];
  for (const colorScheme of ['light', 'dark'] as const) {
    const opened = await open(folder, {colorScheme}), {page} = opened;
    await page.locator('details').evaluateAll(all => { for (const d of all) d.setAttribute('open', ''); });
    await page.getByText('Error', {exact: true}).first().click();
    await frames(page);
    assert.deepEqual(await faint(page), [], colorScheme);
    grounds.push(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
    await done(opened);
  }
  assert.notEqual(grounds[0], grounds[1]);
});

test('nothing moves by itself where less motion is wanted', async () => {
  const opened = await open(folder, {reducedMotion: 'reduce'}), {page} = opened;
  assert.equal(await page.evaluate(() => getComputedStyle(document.documentElement).scrollBehavior), 'auto');
  assert.deepEqual(await page.locator('*').evaluateAll(all => all.filter(e => {
    const style = getComputedStyle(e);
    return style.animationName !== 'none' || style.transitionDuration.split(',').some(t => parseFloat(t) > 0);
  }).map(e => e.tagName)), []);
  await done(opened);
});

test('a command is copied', async () => {
  const opened = await open(folder), {page} = opened;
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']).catch(() => undefined);
  const copy = page.getByRole('button', {name: 'Copy the command of this page'});
  await copy.click();
  await page.waitForFunction(() => [...document.querySelectorAll('footer .copy')].some(b => /Copied|Selected/.test(b.textContent)));
  await done(opened);
});
