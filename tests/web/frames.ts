import type {Page} from 'playwright-core';

/** Waits until what was asked for is drawn. */
export async function frames(page: Page): Promise<void> {
  await page.evaluate(() => new Promise(resolve => {
    requestAnimationFrame(() => { requestAnimationFrame(resolve); });
  }));
}
