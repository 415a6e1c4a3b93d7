// Reads the folder's data on its own, so that the page is compared with the files.
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {inflateSync} from 'node:zlib';

export interface Data {
  width: number;
  height: number;
  lights: number;
  at: (x: number, y: number, light: number) => number | null;
  mean: (x: number, y: number) => number | null;
}

export function dataOf(folder: string, name: string): Data {
  const text = readFileSync(join(folder, 'data', `${name}.js`), 'utf8');
  const packed = JSON.parse(text.slice(text.indexOf('{'), text.lastIndexOf('}') + 1)) as
    {width: number; height: number; lights: number; values: string; encoding?: string};
  const stored = Buffer.from(packed.values, 'base64'), {width, height, lights} = packed;
  const bytes = packed.encoding === 'deflate' ? inflateSync(stored) : stored;
  const at = (x: number, y: number, light: number): number | null => {
    const byte = bytes.readUInt8(light * width * height + y * width + x);
    return byte === 255 ? null : byte / 254;
  };
  const mean = (x: number, y: number): number | null => {
    const values = Array.from({length: lights}, (_, i) => at(x, y, i)).filter(v => v !== null);
    return values.length === 0 ? null : values.reduce((a, b) => a + b) / values.length;
  };
  return {width, height, lights, at, mean};
}
