// The page that the program writes, opened as a person opens it.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, test} from 'node:test';
import {errorColour} from '../../web/compare/src/legend.js';
import {readResults} from '../../web/compare/src/results.js';
import {closeBrowser, colourAt, done, open, placeOf} from './browser.js';
import {frames} from './frames.js';
import {dataOf} from './truth.js';

const program = process.env['PENUMBRA_PROGRAM'];
const scene = process.env['PENUMBRA_SCENE'] ?? '';
const folder = mkdtempSync(join(tmpdir(), 'penumbra-compare-'));
after(async () => {
  await closeBrowser();
  rmSync(folder, {recursive: true});
});

test('the page of penumbra compare shows what its files hold', {skip: program ? false : 'PENUMBRA_PROGRAM names no program'}, async () => {
  execFileSync(program ?? '', ['compare', scene, '-o', folder, '--shadows', 'hard,parker,sdf-inner', '--size', '160x100', '--repeats', '1', '--quiet']);
  const results = readResults(readFileSync(join(folder, 'results.json'), 'utf8'));
  const opened = await open(folder), {page} = opened;
  assert.deepEqual(await page.locator('#methods tbody tr').evaluateAll(rows => rows.map(row => row.getAttribute('data-method')).sort()),
    ['hard', 'parker', 'sdf-inner']);
  await page.getByRole('button', {name: 'Show parker on the left'}).click();
  await page.getByText('Error', {exact: true}).first().click();
  await page.getByRole('slider').press('End');
  await page.waitForFunction(() => document.querySelector<HTMLImageElement>('#stage .left img')?.complete);
  await frames(page);

  const truth = dataOf(folder, 'reference'), parker = dataOf(folder, 'parker');
  let squares = 0, count = 0, tried = 0;
  for (let y = 0; y < truth.height; ++y)
    for (let x = 0; x < truth.width; ++x) {
      const seen = parker.mean(x, y), expected = truth.mean(x, y);
      if (seen === null || expected === null) continue;
      squares += (seen - expected) ** 2;
      ++count;
      if (seen - expected > -0.1 || tried >= 5 || (x + y) % 17) continue;
      ++tried;
      const at = await placeOf(page, x, y);
      await page.mouse.move(at.x, at.y);
      await frames(page);
      assert.equal(await page.locator('#loupe tr[data-method=parker] td[data-value=mean]').innerText(), seen.toFixed(3));
      await page.mouse.move(0, 0);
      const colour = errorColour(seen - expected, results.scale.error), shown = await colourAt(page, at.x + 1, at.y + 1);
      shown.forEach((channel, i) => { assert.ok(Math.abs(channel - (colour[i] ?? NaN)) < 8, `${shown.join()} for ${colour.join()}`); });
    }
  assert.equal(tried, 5);
  const rmse = results.methods.find(m => m.name === 'parker')?.error?.all.rmse ?? NaN;
  assert.ok(Math.abs(Math.sqrt(squares / count) - rmse) < 0.003, `${Math.sqrt(squares / count)} and ${rmse}`);
  await done(opened);
});
