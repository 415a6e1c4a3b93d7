// Pages in headless Chromium, without a network, for the tests.
import assert from 'node:assert/strict';
import {existsSync, mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {chromium, type Browser, type BrowserContextOptions, type Page} from 'playwright-core';
import type {Results} from '../../web/compare/src/results.js';
import {makeFixture, writePage, type Wish} from './fixture.js';
import {frames} from './frames.js';

const bundle = process.env['PENUMBRA_PAGE'] ?? '';
const program = process.env['PENUMBRA_CHROMIUM'] ?? '/usr/bin/chromium';
if (!existsSync(bundle)) throw new Error('PENUMBRA_PAGE must name the built page');

let browser: Browser | null = null;
const folders: string[] = [];

export async function openBrowser(): Promise<Browser> {
  browser ??= await chromium.launch({executablePath: program, args: ['--no-sandbox', '--force-color-profile=srgb']});
  return browser;
}

export async function closeBrowser(): Promise<void> {
  await browser?.close();
  for (const folder of folders) rmSync(folder, {recursive: true});
}

/** A new folder with a fixture; `change` may spoil what is written into the page. */
export function makeFolder(wish: Partial<Wish> = {}, change: (results: Results) => unknown = r => r): {folder: string; results: Results} {
  const folder = mkdtempSync(join(tmpdir(), 'penumbra-page-'));
  folders.push(folder);
  const results = makeFixture(folder, wish);
  writePage(folder, bundle, change(results));
  return {folder, results};
}

export interface Opened {
  page: Page;
  /** What went wrong on the page, and every address that is not a file. */
  complaints: string[];
}

/** Opens a folder's page and waits until the loupe has its data. */
export async function open(folder: string, options: BrowserContextOptions = {}): Promise<Opened> {
  const context = await (await openBrowser()).newContext({viewport: {width: 1280, height: 900}, offline: true, ...options});
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on('console', message => {
    if (message.type() === 'error' || message.type() === 'warning') complaints.push(message.text());
  });
  page.on('pageerror', error => complaints.push(error.message));
  page.on('request', request => {
    if (!/^(file|data|blob):/.test(request.url())) complaints.push(`asked for ${request.url()}`);
  });
  await page.goto(pathToFileURL(join(folder, 'index.html')).href);
  await page.waitForFunction(() => !document.querySelector('#loupe')?.textContent.includes('loading'));
  await frames(page);
  return {page, complaints};
}

export async function done({page, complaints}: Opened): Promise<void> {
  await page.context().close();
  assert.deepEqual(complaints, []);
}

/** The colour of the screen at a place of the window. */
export async function colourAt(page: Page, x: number, y: number): Promise<number[]> {
  const picture = await page.screenshot({clip: {x, y, width: 1, height: 1}});
  return page.evaluate(async address => {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = new OffscreenCanvas(1, 1).getContext('2d');
    canvas?.drawImage(image, 0, 0);
    return [...(canvas?.getImageData(0, 0, 1, 1).data ?? [])].slice(0, 3);
  }, `data:image/png;base64,${picture.toString('base64')}`);
}

/** Where the middle of a pixel of the picture lies in the window, on the stage. */
export async function placeOf(page: Page, x: number, y: number): Promise<{x: number; y: number}> {
  return page.locator('#stage .layer.left img').evaluate((image, at) => {
    const box = image.getBoundingClientRect();
    const scale = box.width / (image as HTMLImageElement).width;
    return {x: box.left + (at.x + 0.5) * scale, y: box.top + (at.y + 0.5) * scale};
  }, {x, y});
}
