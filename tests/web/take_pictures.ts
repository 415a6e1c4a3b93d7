// node take_pictures.mjs FOLDER/index.html OUT: pictures of the page for the documents.
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';
import {chromium, type Browser, type BrowserContextOptions, type Page} from 'playwright-core';
import {frames} from './frames.js';

const [index, out] = process.argv.slice(2);
if (!index || !out) throw new Error('take_pictures INDEX.html FOLDER');

async function open(browser: Browser, options: BrowserContextOptions): Promise<Page> {
  const page = await (await browser.newContext({offline: true, ...options})).newPage();
  await page.goto(pathToFileURL(resolve(index ?? '')).href);
  await page.waitForFunction(() => !document.querySelector('#loupe')?.textContent.includes('loading'));
  return page;
}

async function choose(page: Page, left: string, right: string, kind: string): Promise<void> {
  await page.locator('#pick-left').selectOption(left);
  await page.locator('#pick-right').selectOption(right);
  await page.getByText(kind, {exact: true}).first().click();
  await page.evaluate(() => Promise.all([...document.images].filter(i => !i.hidden).map(i => i.decode())));
  await frames(page);
}

/** A part of the page with some of its ground round it. */
async function take(page: Page, part: string, name: string): Promise<void> {
  const box = await page.locator(part).first().boundingBox();
  if (!box) throw new Error(`${part} is not on the page`);
  const room = 16;
  await page.screenshot({
    path: join(out ?? '', name), fullPage: true,
    clip: {x: box.x - room, y: box.y - room, width: box.width + 2 * room, height: box.height + 2 * room},
  });
}

const browser = await chromium.launch({
  executablePath: process.env['PENUMBRA_CHROMIUM'] ?? '/usr/bin/chromium', args: ['--no-sandbox', '--force-color-profile=srgb'],
});
const wide = {viewport: {width: 1044, height: 900}};

const pictures = await open(browser, wide);
await choose(pictures, 'parker', 'reference', 'Picture');
await take(pictures, '.bench', 'compare-pictures.png');

const errors = await open(browser, {...wide, colorScheme: 'dark'});
await choose(errors, 'hard', 'sdf-inner', 'Error');
await take(errors, '.stage', 'compare-errors.png');

const numbers = await open(browser, wide);
await take(numbers, '.plots figure', 'compare-plot.png');

const phone = await open(browser, {viewport: {width: 360, height: 540}});
await phone.locator('#pictures').evaluate(heading => { heading.scrollIntoView({behavior: 'instant'}); });
await phone.screenshot({path: join(out, 'compare-phone.png')});
await browser.close();
