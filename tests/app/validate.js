// node validate.js FILE.glb: fails, telling them, if the Khronos validator finds errors.
const fs = require('fs');
const validator = require('gltf-validator');

validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then(report => {
  const errors = report.issues.messages.filter(message => message.severity === 0);
  for (const error of errors) console.error(`${error.code} ${error.pointer}: ${error.message}`);
  process.exitCode = errors.length === 0 ? 0 : 1;
});
