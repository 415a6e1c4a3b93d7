// node make_fixture.mjs PAGE.html FOLDER: a page to look at while the program is not at hand.
import {makeFixture, writePage} from './fixture.js';

const [bundle, folder] = process.argv.slice(2);
if (!bundle || !folder) throw new Error('make_fixture PAGE.html FOLDER');
console.log(writePage(folder, bundle, makeFixture(folder)));
