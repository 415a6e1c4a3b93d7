// node build.js: bundles src/ into dist/page.html, one file that needs no other.
// node build.js tests: bundles tests/web/*.ts into tests/web/out/.
import {build} from 'esbuild';
import {mkdirSync, readdirSync, readFileSync, writeFileSync} from 'node:fs';

const testFolder = '../../tests/web/';
const placeholder = '@results@';
// What every C++20 compiler takes as one string.
const mostBytes = 65536;

async function bundled(entry) {
  const result = await build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['chrome111', 'firefox113', 'safari16.4'],
    lineLimit: 160,
    legalComments: 'none',
  });
  return result.outputFiles[0].text.trim();
}

async function page() {
  const script = await bundled('src/main.ts');
  const style = await bundled('src/page.css');
  const parts = {'@style@': style, '@script@': script};
  const text = readFileSync('src/page.html', 'utf8').replace(/@style@|@script@/g, name => parts[name]);
  const holds = [
    [text.split(placeholder).length === 2, `${placeholder} must stand in the page once`],
    [!/<\/script/i.test(script), 'the script must not close its element'],
    [!text.includes(')embedded"'), 'the page must fit into a raw string'],
    [Buffer.byteLength(text) < mostBytes, `the page must be smaller than ${mostBytes} bytes`],
  ];
  for (const [fine, what] of holds) if (!fine) throw new Error(what);
  mkdirSync('dist', {recursive: true});
  writeFileSync('dist/page.html', text);
}

async function tests() {
  await build({
    entryPoints: readdirSync(testFolder).filter(name => name.endsWith('.ts')).map(name => testFolder + name),
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node18',
    packages: 'external',
    outdir: testFolder + 'out',
    outExtension: {'.js': '.mjs'},
  });
}

await (process.argv[2] === 'tests' ? tests() : page());
